//! Did the bodies push each other, or is the jump in velocity only noise?

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::noise::KnownNoise;
use super::quantities::{Collision, IMPULSE, body_place};
use super::uncertainty::Deviations;
use crate::reconstruct::flags::Push;

/// How often pure noise may seem an impulse.
const FALSE_ALARM: f64 = 0.05;

/// Tests the impulse, and each body's jump in velocity, against none. `segments`: how many the
/// largest was searched in.
pub(super) fn push(
    collision: &Collision,
    deviations: &Deviations,
    noise: KnownNoise,
    segments: usize,
) -> Push {
    let limit = |size: usize| limit(size, noise.position_dof, segments);
    let any = stands_out(collision.impulse.as_slice(), deviations.covariance(IMPULSE, 3), &limit);
    let all = collision.states.iter().enumerate().all(|(index, states)| {
        let jump = states.after.velocity_in_world - states.before.velocity_in_world;
        let covariance = jump_covariance(deviations, index);
        stands_out(jump.as_slice(), covariance, &limit)
    });
    Push { any, all: any && all }
}

/// Of v⁺ − v⁻ of body number `index`.
fn jump_covariance(deviations: &Deviations, index: usize) -> Option<DMatrix<f64>> {
    let first = body_place(index, "velocity_before");
    let six = deviations.covariance(first, 6)?;
    let block = |row, column| six.view((row, column), (3, 3)).into_owned();
    Some(block(0, 0) + block(3, 3) - block(0, 3) - block(3, 0))
}

/// vᵀ C⁻¹ v over the directions in which v can vary (a plane's impulse has one).
fn stands_out(
    vector: &[f64],
    covariance: Option<DMatrix<f64>>,
    limit: &dyn Fn(usize) -> f64,
) -> bool {
    // Where the data leave it open nothing can be said against it.
    let Some(covariance) = covariance else { return true };
    let eigen = covariance.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let vector = DVector::from_column_slice(vector);
    let mut square = 0.0;
    let mut size = 0;
    for (value, axis) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > 1e-9 * largest {
            square += axis.dot(&vector).powi(2) / value;
            size += 1;
        }
    }
    size > 0 && (square.is_nan() || square > limit(size))
}

/// What the largest of `segments` squares of noise with `size` degrees of freedom exceeds once in
/// twenty scenes (Bonferroni): of χ², or of Fisher's F where the noise is estimated.
fn limit(size: usize, dof: Option<f64>, segments: usize) -> f64 {
    let quantile = 1.0 - FALSE_ALARM / segments.max(1) as f64;
    let fisher = dof.map(|dof| FisherSnedecor::new(size as f64, dof.max(1.0)));
    match (fisher, ChiSquared::new(size as f64)) {
        (Some(Ok(fisher)), _) => size as f64 * fisher.inverse_cdf(quantile),
        (None, Ok(chi)) => chi.inverse_cdf(quantile),
        _ => f64::INFINITY,
    }
}
