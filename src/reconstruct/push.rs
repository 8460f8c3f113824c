//! Did the bodies push each other, or is the jump in velocity only noise?

use nalgebra::{DMatrix, DVector};

use super::internal::InternalScene;
use super::phases::Solved;

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
    let stds = jump_stds_per_noise(internal, solved.collision_frames);
    let sigmas = visible_sigmas(solved.segments);
    let mut visible = jumps_m_s.iter().enumerate().map(|(index, jump_m_s)| {
        let noise = position_rmse * spare_correction(internal);
        // Too few poses to tell: the jump is what the fit says it is.
        *jump_m_s > stds.as_ref().map_or(0.0, |stds| sigmas * stds[index] * noise)
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

/// √(n / (n − p)): each coordinate's p parameters use up as many of its n residuals.
fn spare_correction(internal: &InternalScene) -> f64 {
    let poses: usize = internal.paper.bodies.iter().map(|body| body.observations.len()).sum();
    let spare = poses as f64 - parameters(internal) as f64;
    (poses as f64 / spare.max(1.0)).sqrt()
}

/// Of a coordinate: b₄, v⁻ and v⁺ of each body, and the tilt of gravity that all share.
fn parameters(internal: &InternalScene) -> usize {
    3 * internal.paper.bodies.len() + usize::from(internal.paper.gravity_m_s2 > 0.0)
}

/// The standard deviation of a coordinate of each body's v⁺ − v⁻ in m/s per m of noise, from the
/// linear fit of p = b₄ + v± t + tilt · t²: √(cᵀ N⁻¹ c) (the Gauss-Markov theorem). A free tilt of
/// gravity bends a path much as a jump does, and costs certainty.
fn jump_stds_per_noise(internal: &InternalScene, collision_frames: f64) -> Option<Vec<f64>> {
    let size = parameters(internal);
    let mut normal = DMatrix::<f64>::zeros(size, size);
    for (index, body) in internal.paper.bodies.iter().enumerate() {
        for observation in &body.observations {
            let time_s = internal.seconds(observation.time_frames - collision_frames);
            let mut row = DVector::<f64>::zeros(size);
            row[3 * index] = 1.0;
            row[3 * index + 1] = time_s.min(0.0);
            row[3 * index + 2] = time_s.max(0.0);
            if internal.paper.gravity_m_s2 > 0.0 {
                row[size - 1] = time_s * time_s;
            }
            normal += &row * row.transpose();
        }
    }
    let inverse = normal.cholesky()?.inverse();
    let variance = |index: usize| {
        let (before, after) = (3 * index + 1, 3 * index + 2);
        inverse[(before, before)] + inverse[(after, after)] - 2.0 * inverse[(before, after)]
    };
    Some((0..internal.paper.bodies.len()).map(|index| variance(index).max(0.0).sqrt()).collect())
}
