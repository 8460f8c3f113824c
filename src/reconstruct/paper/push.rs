//! Did the bodies push each other, or is the jump in velocity only noise?

use nalgebra::{DMatrix, DVector};

use super::super::flags::Push;
use super::internal::InternalScene;
use super::phases::Solved;

/// Compares each body's jump in velocity, in m/s, with its standard error: with the stated noise of
/// positions, or the fit's.
pub(super) fn visible(
    internal: &InternalScene,
    solved: &Solved,
    jumps_m_s: &[f64],
    stated_noise_m: Option<f64>,
    position_rmse: f64,
) -> Push {
    let noise_m = stated_noise_m.or_else(|| noise_of_fit_m(internal, position_rmse));
    let stds = noise_m.and_then(|noise| jump_stds_m_s(internal, solved.collision_frames, noise));
    // With too few poses to tell the noise, the jump is what the fit says it is.
    let Some(stds) = stds else { return Push { any: true, all: true } };
    let squares: Vec<f64> =
        jumps_m_s.iter().zip(&stds).map(|(jump, std)| (jump / std).powi(2)).collect();
    let single = largest_of(solved.segments, 7.81);
    let any = match squares.len() {
        1 => squares[0] > single,
        _ => squares.iter().sum::<f64>() > largest_of(solved.segments, 12.59),
    };
    Push { any, all: squares.iter().all(|square| *square > single) }
}

/// What the largest of `segments` χ² of pure noise exceeds less than once in twenty searches. One
/// exceeds `quantile` that often: 7.81 with the three degrees of freedom of a jump, 12.59 with the
/// six of two; each time their number grows by e this grows by at most 2.6.
fn largest_of(segments: usize, quantile: f64) -> f64 {
    quantile + 2.6 * (segments.max(1) as f64).ln()
}

/// The noise behind a root mean square of residuals: each coordinate's p parameters use up as many
/// of its n residuals, hence √(n / (n − p)). `None` where too few are left to tell.
fn noise_of_fit_m(internal: &InternalScene, position_rmse: f64) -> Option<f64> {
    /// Three coordinates have three times as many: an estimate to within a quarter.
    const LEAST_SPARE: usize = 4;
    let poses: usize = internal.paper.bodies.iter().map(|body| body.observations.len()).sum();
    let spare = poses.saturating_sub(parameters(internal));
    (spare >= LEAST_SPARE).then(|| position_rmse * (poses as f64 / spare as f64).sqrt())
}

/// Of a coordinate: b₄, v⁻ and v⁺ of each body, and the tilt of gravity that all share.
fn parameters(internal: &InternalScene) -> usize {
    3 * internal.paper.bodies.len() + usize::from(internal.paper.gravity_m_s2 > 0.0)
}

/// The standard deviation of a coordinate of each body's v⁺ − v⁻ in m/s, from the linear fit of
/// p = b₄ + v± t + ½ g β t²: √(cᵀ N⁻¹ c) (the Gauss-Markov theorem). A tilt β of gravity bends a
/// path much as a jump does, and costs certainty.
fn jump_stds_m_s(
    internal: &InternalScene,
    collision_frames: f64,
    noise_m: f64,
) -> Option<Vec<f64>> {
    let size = parameters(internal);
    let gravity = internal.paper.gravity_m_s2;
    let mut normal = DMatrix::<f64>::zeros(size, size);
    for (index, body) in internal.paper.bodies.iter().enumerate() {
        for observation in &body.observations {
            let time_s = internal.seconds(observation.time_frames - collision_frames);
            let mut row = DVector::<f64>::zeros(size);
            row[3 * index] = 1.0;
            row[3 * index + 1] = time_s.min(0.0);
            row[3 * index + 2] = time_s.max(0.0);
            if gravity > 0.0 {
                row[size - 1] = 0.5 * gravity * time_s * time_s;
            }
            normal += &row * row.transpose();
        }
    }
    if gravity > 0.0 {
        // The gravity term (eq. 17) holds the tilt: ½ (g β²/2)² is the energy of a position that is
        // one σ off, ½ · 4 σ², at β² = 4 σ/g.
        normal[(size - 1, size - 1)] += noise_m.powi(2) / (4.0 * noise_m / gravity);
    }
    let inverse = normal.cholesky()?.inverse();
    let variance = |index: usize| {
        let (before, after) = (3 * index + 1, 3 * index + 2);
        inverse[(before, before)] + inverse[(after, after)] - 2.0 * inverse[(before, after)]
    };
    let bodies = 0..internal.paper.bodies.len();
    Some(bodies.map(|index| noise_m * variance(index).max(0.0).sqrt()).collect())
}
