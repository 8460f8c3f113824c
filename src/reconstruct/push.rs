//! Did the bodies push each other, or is the jump in velocity only noise?

use nalgebra::{Matrix3, Vector3};

use super::internal::InternalScene;
use super::phases::Solved;
use crate::bridge::ffi::PaperObservation;

/// Which bodies' jumps stand out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Push {
    /// At least one body was pushed: there was an impulse.
    pub(super) any: bool,
    /// Every body was pushed: their masses can be compared.
    pub(super) all: bool,
}

/// Compares each body's jump in velocity, in m/s, with its standard error.
pub(super) fn visible(
    internal: &InternalScene,
    solved: &Solved,
    jumps_m_s: &[f64],
    position_rmse: f64,
) -> Push {
    let fps = internal.paper.frames_per_second;
    let mut visible = jumps_m_s.iter().zip(&internal.paper.bodies).map(|(jump_m_s, body)| {
        let noise = position_rmse * spare_correction(body.observations.len());
        let std = jump_std_per_noise(&body.observations, solved.collision_frames, fps);
        // Too few poses to tell: the jump is what the fit says it is.
        *jump_m_s > std.map_or(0.0, |std| visible_sigmas(solved.segments) * std * noise)
    });
    let first = visible.next().unwrap_or(false);
    let rest: Vec<bool> = visible.collect();
    Push { any: first || rest.contains(&true), all: first && !rest.contains(&false) }
}

/// How many σ of a coordinate the largest of `segments` jumps of pure noise exceeds less than once
/// in twenty searches: √ of the quantile of χ² with three degrees of freedom at 1 − 0.05/segments,
/// 7.81 for one segment and at most 2.4 more each time their number grows by e.
fn visible_sigmas(segments: usize) -> f64 {
    (7.81 + 2.4 * (segments.max(1) as f64).ln()).sqrt()
}

/// √(n / (n − 3)): a flight of n poses uses up three of each coordinate's residuals.
fn spare_correction(poses: usize) -> f64 {
    (poses as f64 / (poses as f64 - 3.0).max(1.0)).sqrt()
}

/// The standard deviation of a coordinate of v⁺ − v⁻ in m/s per m of noise, from the linear fit of
/// p = b₄ + v± t on both sides: √(cᵀ N⁻¹ c) (the Gauss-Markov theorem).
fn jump_std_per_noise(
    observations: &[PaperObservation],
    collision_frames: f64,
    frames_per_second: f64,
) -> Option<f64> {
    let normal_matrix = observations.iter().fold(Matrix3::zeros(), |sum, observation| {
        let time_s = (observation.time_frames - collision_frames) / frames_per_second;
        let row = Vector3::new(1.0, time_s.min(0.0), time_s.max(0.0));
        sum + row * row.transpose()
    });
    let contrast = Vector3::new(0.0, -1.0, 1.0);
    let variance = contrast.dot(&(normal_matrix.try_inverse()? * contrast));
    (variance > 0.0).then(|| variance.sqrt())
}
