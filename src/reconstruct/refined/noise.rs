//! The noise of each channel, from what the fit leaves over.

use super::model::set_noise;
use super::optimum::{Optimum, sort, warm};
use super::parabolas::Parabolas;
use crate::Result;
use crate::bridge::refined::ffi::{RefinedScene, RefinedSolution};
use crate::scene::{Noise, smallest_m};

/// Rounds of estimating the noise; it settles to a per mille in three or four, where the model misses
/// something and now doesn't in twice as many.
const MOST_NOISE_ROUNDS: usize = 8;
/// A thousandth: far finer than any number of poses tells it.
pub(super) const SETTLED: f64 = 1e-3;
/// Near enough to judge an effect by: what explains the poses makes the noise fall by orders, and weights
/// that were chosen for what was missed before stay in its way.
pub(super) const ROUGHLY_SETTLED: f64 = 2.0;
/// From fewer spare numbers the estimate would be off by a factor of two as often as not.
const LEAST_SPARE: f64 = 1.5;
/// Of one channel's noise the other's is at least so much, a turn as what it moves at the end of a body.
/// What is missing from a model may touch one alone, and leave the other nothing: the fit would hold to
/// that to the last digit, and no step lead on from there.
const LEAST_RATIO: f64 = 1e-2;

/// The noise, and how it is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct KnownNoise {
    pub(crate) value: Noise,
    /// Spare numbers of each channel that it is estimated from; `None` where it is stated.
    pub(super) position_dof: Option<f64>,
    pub(super) orientation_dof: Option<f64>,
}

/// Whether a channel's noise is stated, or estimated from enough spare numbers.
pub(super) fn is_known(dof: Option<f64>) -> bool {
    dof.is_none_or(|dof| dof > LEAST_SPARE)
}

impl KnownNoise {
    pub(super) fn stated(value: Noise) -> Self {
        KnownNoise { value, position_dof: None, orientation_dof: None }
    }

    /// One σ of positions and of orientations, where their residuals tell it.
    pub(crate) fn estimates(&self) -> [Option<f64>; 2] {
        let told = |dof: Option<f64>, value| dof.filter(|dof| *dof > LEAST_SPARE).map(|_| value);
        [
            told(self.position_dof, self.value.position),
            told(self.orientation_dof, self.value.orientation),
        ]
    }

    /// From what each channel's residuals say, with the spare numbers that they say it by.
    pub(super) fn estimated(
        scene: &RefinedScene,
        (position, position_dof): (f64, Option<f64>),
        (orientation, orientation_dof): (f64, Option<f64>),
    ) -> Self {
        let told = |noise: f64, dof| if is_known(dof) { noise } else { 0.0 };
        let left = Noise {
            position: told(position, position_dof),
            orientation: told(orientation, orientation_dof),
        };
        let value = Noise { position, orientation }.at_least(least_beside(scene, left));
        KnownNoise { value, position_dof, orientation_dof }
    }
}

/// A noise to start from where none is stated: of positions, what two lines that meet leave over;
/// of orientations, an annotator's.
pub(super) fn first_guess(parabolas: &Parabolas, squares_m2: f64) -> Noise {
    const ANNOTATOR: Noise = Noise { position: 0.002, orientation: 0.01 };
    let position = match parabolas.spare() {
        0 => ANNOTATOR.position,
        spare => (squares_m2 / spare as f64).sqrt(),
    };
    Noise { position: position.max(1e-7), ..ANNOTATOR }
}

/// Estimates the noise of each channel from its residuals and refits until both agree: σ² = RSS over
/// the channel's numbers minus those that the fit used up (Förstner's variance components).
/// `tolerance`: the factor, less 1, by which it may still change.
pub(super) fn settle_noise(
    scene: &mut RefinedScene,
    optima: &mut Vec<Optimum>,
    guess: Noise,
    tolerance: f64,
) -> Result<KnownNoise> {
    let mut noise = KnownNoise::stated(guess);
    // Only the best is refitted on the way: the others follow once.
    let mut best = optima[..1].to_vec();
    for _ in 0..MOST_NOISE_ROUNDS {
        let next = estimated_noise(scene, &best[0], noise.value);
        let close = |a: f64, b: f64| (a / b).max(b / a) < 1.0 + tolerance;
        let settled = close(next.value.position, noise.value.position)
            && close(next.value.orientation, noise.value.orientation);
        noise = next;
        set_noise(scene, noise.value);
        best = warm(scene, &best)?;
        if settled {
            break;
        }
    }
    if optima.len() > 1 {
        best.extend(warm(scene, &optima[1..]).unwrap_or_default());
        sort(&mut best);
    }
    *optima = best;
    Ok(noise)
}

fn estimated_noise(scene: &RefinedScene, optimum: &Optimum, noise: Noise) -> KnownNoise {
    let solution = &optimum.solution;
    let used = |channel: &[f64]| optimum.used(channel);
    let position = channel_noise(
        positions(scene, solution),
        used(&solution.position_information),
        noise.position,
    );
    let orientation = channel_noise(
        turns(scene, solution),
        used(&solution.orientation_information),
        noise.orientation,
    );
    KnownNoise::estimated(scene, position, orientation)
}

/// The least noise of each channel where residuals are as large as `left`, zero of a channel that says
/// nothing.
pub(super) fn least_beside(scene: &RefinedScene, left: Noise) -> Noise {
    let edges_m = || scene.bodies.iter().map(|body| body.size);
    let size_m = smallest_m(edges_m());
    let beside = Noise {
        position: LEAST_RATIO * left.orientation * size_m,
        orientation: LEAST_RATIO * left.position / size_m,
    };
    beside.at_least(Noise::least(edges_m()))
}

/// How many position coordinates there are, and the sum of their squared residuals, m²: each as if its
/// pose were as noisy as the others.
pub(super) fn positions(scene: &RefinedScene, solution: &RefinedSolution) -> (f64, f64) {
    let poses = scene.bodies.iter().flat_map(|body| &body.poses);
    let squares = poses
        .zip(&solution.residuals)
        .map(|(pose, residual)| square(&residual.position_m) / pose.noise_scale.powi(2));
    (3.0 * solution.residuals.len() as f64, squares.sum())
}

/// The same of orientations, rad²; the residual of what isn't annotated is zero.
pub(super) fn turns(scene: &RefinedScene, solution: &RefinedSolution) -> (f64, f64) {
    let poses = scene.bodies.iter().flat_map(|body| &body.poses);
    let squares = poses
        .zip(&solution.residuals)
        .map(|(pose, residual)| square(&residual.turn_rad) / pose.noise_scale.powi(2));
    let spinning = scene.bodies.iter().filter(|body| body.has_spin);
    let oriented = spinning.flat_map(|body| &body.poses).filter(|pose| pose.has_orientation);
    (3.0 * oriented.count() as f64, squares.sum())
}

/// |v|².
pub(super) fn square(v: &[f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum()
}

/// The deviation of a channel with `count` numbers of which the fit used up `used`, and what is
/// spare; as it was where too little is.
fn channel_noise((count, squares): (f64, f64), used: f64, before: f64) -> (f64, Option<f64>) {
    let spare = count - used;
    match spare > LEAST_SPARE {
        true => ((squares / spare).sqrt(), Some(spare)),
        false => (before, Some(spare.max(0.0))),
    }
}
