//! A fit that a few wrong annotations don't spoil: Student's t instead of Gauss.
//!
//! Each pose's position and orientation is weighted anew by w = (ν + 3)/(ν + r²), where r² is its
//! squared residual over the noise, until nothing changes: maximum likelihood of a t-distribution in
//! three dimensions (Lange, Little & Taylor, *Robust statistical modeling using the t distribution*,
//! 1989).

use super::noise::{KnownNoise, square};
use super::optimum::{Optimum, warm};
use crate::bridge::refined::ffi::{RefinedPose, RefinedResidual, RefinedScene, RefinedSolution};
use crate::reconstruct::{Loss, Outlier};
use crate::scene::Noise;
use crate::{Error, Result, Scene};

/// Degrees of freedom: heavy enough tails for annotations, at little cost where noise is Gaussian.
const NU: f64 = 4.0;
const MOST_ROUNDS: usize = 30;
/// A deviation that changes by less is settled.
const SETTLED: f64 = 1e-2;
/// Squared residuals beyond happen to one in a thousand: χ² with three degrees of freedom.
const OUTLIER: f64 = 16.27;
/// The median of χ² with three degrees of freedom.
const MEDIAN_CHI2: f64 = 2.366;

/// Reweights and refits until both agree; the noise is stated, or taken from the median residual.
pub(super) fn settle_robustly(
    scene: &mut RefinedScene,
    optima: &mut Vec<Optimum>,
    guess: Noise,
    stated: Option<Noise>,
) -> Result<KnownNoise> {
    check_spare(scene, &optima[0])?;
    let mut noise = KnownNoise::stated(stated.unwrap_or(guess));
    for _ in 0..MOST_ROUNDS {
        if stated.is_none() {
            noise = median_noise(scene, &optima[0], noise.value);
        }
        let change = weigh(scene, &optima[0].solution, noise.value);
        *optima = warm(scene, optima)?;
        if change < SETTLED {
            break;
        }
    }
    inflate(scene, &optima[0], noise.value);
    *optima = warm(scene, optima)?;
    Ok(noise)
}

/// Makes the covariance that of the robust estimate (Huber, *Robust Statistics*, 1981, ch. 7): the
/// weights alone would leave out that heavy tails make it less sure. With ψ = w r, each channel's
/// variance grows by mean(w) mean(|ψ|²/3) / mean(ψ')², and by what the fit used up.
fn inflate(scene: &mut RefinedScene, optimum: &Optimum, noise: Noise) {
    let solution = &optimum.solution;
    let factor = |residuals: Vec<f64>, channel: &[f64]| {
        let count = residuals.len() as f64;
        let spare = 3.0 * count - optimum.used(channel);
        let mean = |f: &dyn Fn(f64) -> f64| residuals.iter().map(|s| f(*s)).sum::<f64>() / count;
        let weight = |s: f64| (NU + 3.0) / (NU + s);
        let slope = mean(&|s| weight(s) * (1.0 - 2.0 / 3.0 * s / (NU + s)));
        let variance = mean(&|s| weight(s).powi(2) * s / 3.0);
        let factor = mean(&weight) * variance / (slope * slope) * 3.0 * count / spare;
        if spare >= 3.0 && factor.is_finite() { factor.sqrt() } else { 1.0 }
    };
    let (positions, turns) = squares(scene, solution);
    let over = |squares: Vec<f64>, noise: f64| squares.iter().map(|s| s / noise.powi(2)).collect();
    let position = factor(over(positions, noise.position), &solution.position_information);
    let turn = factor(over(turns, noise.orientation), &solution.orientation_information);
    for pose in scene.bodies.iter_mut().flat_map(|body| &mut body.poses) {
        pose.position_std_m *= position;
        pose.orientation_std_rad *= turn;
    }
}

/// The squared residuals of all positions, and of all orientations that were annotated; each as if its
/// pose were as noisy as the others.
fn squares(scene: &RefinedScene, solution: &RefinedSolution) -> (Vec<f64>, Vec<f64>) {
    let poses = scene.bodies.iter().flat_map(|body| body.poses.iter().map(|p| (body.has_spin, p)));
    let (mut positions, mut turns) = (Vec::new(), Vec::new());
    for ((has_spin, pose), residual) in poses.zip(&solution.residuals) {
        let scale = pose.noise_scale.powi(2);
        positions.push(square(&residual.position_m) / scale);
        if has_spin && pose.has_orientation {
            turns.push(square(&residual.turn_rad) / scale);
        }
    }
    (positions, turns)
}

/// Where the fit uses up most of the numbers, wrong ones can't be told from right ones.
fn check_spare(scene: &RefinedScene, optimum: &Optimum) -> Result<()> {
    let solution = &optimum.solution;
    let (positions, turns) = squares(scene, solution);
    let channels = [
        ("positions", positions.len(), &solution.position_information),
        ("orientations", turns.len(), &solution.orientation_information),
    ];
    for (name, count, channel) in channels {
        let used = optimum.used(channel);
        if used > 1.5 * count as f64 {
            let problem = format!(
                "too few poses for a robust fit: {used:.0} of {} numbers of {name} are used up by \
                 the unknowns, and half must be left to tell wrong ones by",
                3 * count
            );
            return Err(Error::invalid("bodies", problem)
                .mend("annotate more poses, or leave the robust loss out"));
        }
    }
    Ok(())
}

/// The poses that the fit holds for wrong, the worst first.
pub(super) fn outliers(
    scene: &Scene,
    refined: &RefinedScene,
    solution: &RefinedSolution,
    noise: Noise,
) -> Vec<Outlier> {
    let mut residuals = solution.residuals.iter();
    let mut found = Vec::new();
    for (body, refined) in scene.bodies().iter().zip(&refined.bodies) {
        for pose in &refined.poses {
            let Some(residual) = residuals.next() else { break };
            let channels = [
                ("position", over(&residual.position_m, pose, noise.position)),
                ("orientation", over(&residual.turn_rad, pose, noise.orientation)),
            ];
            for (channel, square) in channels {
                if square > OUTLIER {
                    found.push(Outlier {
                        body: body.name.clone(),
                        time: pose.time_s,
                        channel: channel.to_string(),
                        deviations: square.sqrt(),
                    });
                }
            }
        }
    }
    found.sort_by(|a, b| b.deviations.total_cmp(&a.deviations));
    found
}

/// Whether a residual of `pose` is beyond what one in a thousand is by the noise.
pub(super) fn is_outlier(residual: &[f64; 3], pose: &RefinedPose, noise: f64) -> bool {
    over(residual, pose, noise) > OUTLIER
}

/// What a pose's residuals cost: ½ r² of each channel, or Student's ½ (ν + 3) ln(1 + r²/ν).
pub(super) fn residual_cost(
    pose: &RefinedPose,
    residual: &RefinedResidual,
    noise: Noise,
    loss: Loss,
) -> f64 {
    let squares = [
        over(&residual.position_m, pose, noise.position),
        over(&residual.turn_rad, pose, noise.orientation),
    ];
    let cost = |square: f64| match loss {
        Loss::Squares => 0.5 * square,
        Loss::Robust => 0.5 * (NU + 3.0) * (1.0 + square / NU).ln(),
    };
    squares.map(cost).iter().sum()
}

/// A squared residual over the noise of its pose.
fn over(residual: &[f64; 3], pose: &RefinedPose, noise: f64) -> f64 {
    square(residual) / (noise * pose.noise_scale).powi(2)
}

/// Gives each pose the deviation σ/√w; returns the largest relative change of one.
fn weigh(scene: &mut RefinedScene, solution: &RefinedSolution, noise: Noise) -> f64 {
    let poses = scene.bodies.iter_mut().flat_map(|body| &mut body.poses);
    let mut largest = 0.0_f64;
    for (pose, residual) in poses.zip(&solution.residuals) {
        let mut put = |std: &mut f64, residual: &[f64; 3], noise: f64| {
            let weight = (NU + 3.0) / (NU + square(residual) / (noise * noise));
            let new = noise / weight.sqrt();
            largest = largest.max((new / *std - 1.0).abs());
            *std = new;
        };
        let scale = pose.noise_scale;
        put(&mut pose.position_std_m, &residual.position_m, scale * noise.position);
        put(&mut pose.orientation_std_rad, &residual.turn_rad, scale * noise.orientation);
    }
    largest
}

/// The noise of each channel by its median residual, which outliers can't move far; more by what the
/// fit used up.
fn median_noise(scene: &RefinedScene, optimum: &Optimum, before: Noise) -> KnownNoise {
    let solution = &optimum.solution;
    let (mut positions, mut turns) = squares(scene, solution);
    let deviation = |squares: &mut Vec<f64>, channel: &[f64], before: f64| {
        let count = 3.0 * squares.len() as f64;
        let spare = count - optimum.used(channel);
        if spare < 3.0 {
            return (before, Some(spare.max(0.0)));
        }
        squares.sort_by(f64::total_cmp);
        let median = squares[squares.len() / 2];
        ((median / MEDIAN_CHI2 * count / spare).sqrt(), Some(spare))
    };
    let position = deviation(&mut positions, &solution.position_information, before.position);
    let orientation = deviation(&mut turns, &solution.orientation_information, before.orientation);
    KnownNoise::estimated(scene, position, orientation)
}
