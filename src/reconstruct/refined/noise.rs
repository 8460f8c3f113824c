//! The noise of each channel, from what the fit leaves over.

use super::model::set_noise;
use super::optimum::{Optimum, sort, warm};
use super::parabolas::Parabolas;
use crate::Result;
use crate::bridge::refined::ffi::{RefinedScene, RefinedSolution};
use crate::scene::Noise;

/// Rounds of estimating the noise; it settles to a per mille in three or four.
pub(super) const MOST_NOISE_ROUNDS: usize = 8;
/// From fewer spare numbers the estimate would be off by a factor of two as often as not.
const LEAST_SPARE: f64 = 1.5;
/// Below, the noise is that of rounding and of the integrator.
pub(super) const LEAST_NOISE: Noise = Noise { position: 1e-9, orientation: 1e-9 };

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
pub(super) fn settle_noise(
    scene: &mut RefinedScene,
    optima: &mut Vec<Optimum>,
    guess: Noise,
    most_rounds: usize,
) -> Result<KnownNoise> {
    let mut noise = KnownNoise::stated(guess);
    // Only the best is refitted on the way: the others follow once.
    let mut best = optima[..1].to_vec();
    for _ in 0..most_rounds {
        let next = estimated_noise(scene, &best[0], noise.value);
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

/// To a thousandth: far finer than any number of poses tells it.
fn close(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-3
}

fn estimated_noise(scene: &RefinedScene, optimum: &Optimum, noise: Noise) -> KnownNoise {
    let solution = &optimum.solution;
    let used = |channel: &[f64]| optimum.used(channel);
    let (position, position_dof) = channel_noise(
        positions(scene, solution),
        used(&solution.position_information),
        noise.position,
        LEAST_NOISE.position,
    );
    let (orientation, orientation_dof) = channel_noise(
        turns(scene, solution),
        used(&solution.orientation_information),
        noise.orientation,
        LEAST_NOISE.orientation,
    );
    KnownNoise { value: Noise { position, orientation }, position_dof, orientation_dof }
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
fn channel_noise(
    (count, squares): (f64, f64),
    used: f64,
    before: f64,
    least: f64,
) -> (f64, Option<f64>) {
    let spare = count - used;
    match spare > LEAST_SPARE {
        true => ((squares / spare).sqrt().max(least), Some(spare)),
        false => (before, Some(spare.max(0.0))),
    }
}
