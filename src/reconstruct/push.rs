//! Did the bodies push each other, or is the jump in velocity only noise?

use nalgebra::{Matrix3, Vector3};

use super::internal::InternalScene;
use super::phases::Solved;
use crate::bridge::ffi::PaperObservation;

/// A three-dimensional normal deviate exceeds this many σ of a coordinate once in twenty
/// (χ² with 3 degrees of freedom: 7.81).
const VISIBLE_SIGMAS: f64 = 2.8;

/// Whether at least one body's jump in velocity, in m/s, stands out of the noise.
pub(super) fn is_visible(
    internal: &InternalScene,
    solved: &Solved,
    jumps_m_s: &[f64],
    position_rmse: f64,
) -> bool {
    jumps_m_s.iter().zip(&internal.paper.bodies).any(|(jump_m_s, body)| {
        let fps = internal.paper.frames_per_second;
        match jump_std_per_noise(&body.observations, solved.collision_frames, fps) {
            Some(std) => {
                let noise = position_rmse * spare_correction(body.observations.len());
                *jump_m_s > VISIBLE_SIGMAS * std * noise
            }
            // Too few poses to tell: the jump is what the fit says it is.
            None => *jump_m_s > 0.0,
        }
    })
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
