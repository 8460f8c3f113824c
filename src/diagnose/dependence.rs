//! How much less residuals tell than their number says, where something is left in them: they come in
//! waves, and are larger than the noise. Differences of χ² shrink by as much (quasi-likelihood:
//! Burnham & Anderson, *Model Selection and Multimodel Inference*, 2002, section 2.5).

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::Leftover;
use crate::bridge::refined::ffi::RefinedPose;
use crate::reconstruct::refined::Fitted;

/// Coefficients of a smooth curve: a force bends a path by t², and the fit takes what it can of that.
pub(super) const CURVE: usize = 5;
/// Shorter series show no waves.
const SHORTEST: usize = 8;

/// Schwarz's criterion of a model with a gain of `delta_chi2` and the usual `bic`, where the gain counts
/// for less by `inflation`; the penalty for its parameters stays.
pub(crate) fn quasi_bic(bic: f64, delta_chi2: f64, inflation: f64) -> f64 {
    bic + delta_chi2 * (1.0 - 1.0 / inflation)
}

/// The factor by which differences count for less beside a fit that leaves `rest`.
pub(crate) fn inflation_of(fitted: &Fitted, rest: &Leftover) -> f64 {
    if rest.is_structured() { inflation(fitted) } else { 1.0 }
}

/// The factor by which χ² exceeds that of as much independent noise, at least 1: the reduced χ², where
/// the noise is stated, times the number of neighbours that say the same.
pub(super) fn inflation(fitted: &Fitted) -> f64 {
    let spare = (fitted.numbers() - fitted.used()).max(1.0);
    let size = match fitted.has_stated_noise() {
        true => (fitted.chi2() / spare).max(1.0),
        false => 1.0,
    };
    size * waves(fitted)
}

/// The mean of all flights' and coordinates' correlation lengths, by their squares.
pub(super) fn waves(fitted: &Fitted) -> f64 {
    mean_length(fitted, |series| series)
}

/// The same with a smooth curve taken out of each series, as a force that is missing leaves it: what errors
/// share with their neighbours alone stays.
pub(super) fn waves_beside_curves(fitted: &Fitted) -> f64 {
    mean_length(fitted, beside_a_curve)
}

pub(super) fn beside_a_curve(series: Vec<f64>) -> Vec<f64> {
    let middle = 0.5 * (series.len() as f64 - 1.0);
    let powers = DMatrix::from_fn(series.len(), CURVE, |row, degree| {
        (row as f64 / middle - 1.0).powi(degree as i32)
    });
    let basis = powers.qr().q();
    let series = DVector::from_vec(series);
    let curve = &basis * basis.tr_mul(&series);
    (series - curve).as_slice().to_vec()
}

fn mean_length(fitted: &Fitted, rest: impl Fn(Vec<f64>) -> Vec<f64>) -> f64 {
    let residuals = &fitted.best().solution.residuals;
    let poses: Vec<&RefinedPose> =
        fitted.refined.bodies.iter().flat_map(|body| &body.poses).collect();
    let (mut lengths, mut squares) = (0.0, 0.0);
    for flight in flights(fitted) {
        for axis in 0..6 {
            // In units of each pose's noise, so that positions and turns count alike.
            let series = flight.clone().map(|index| match axis {
                0..3 => residuals[index].position_m[axis] / poses[index].position_std_m,
                _ => residuals[index].turn_rad[axis - 3] / poses[index].orientation_std_rad,
            });
            let series: Vec<f64> = series.collect();
            if series.len() < SHORTEST {
                continue;
            }
            let series = rest(series);
            let square: f64 = series.iter().map(|x| x * x).sum();
            if square > 0.0 {
                lengths += square * correlation_length(&series);
                squares += square;
            }
        }
    }
    if squares > 0.0 { (lengths / squares).max(1.0) } else { 1.0 }
}

/// Each flight's residuals.
pub(super) fn flights(fitted: &Fitted) -> Vec<Range<usize>> {
    let mut flights = Vec::new();
    let mut first = 0;
    for body in &fitted.refined.bodies {
        let split = body.poses.partition_point(|pose| pose.time_s < fitted.collision_time_s());
        let end = first + body.poses.len();
        flights.extend([first..first + split, first + split..end]);
        first = end;
    }
    flights
}

/// 1 + 2 Σ ρ, summed as long as pairs of neighbouring correlations, from the first lag on, stay positive
/// (after Geyer, *Practical Markov Chain Monte Carlo*, 1992, who pairs from lag 0).
pub(super) fn correlation_length(series: &[f64]) -> f64 {
    let at = |lag: usize| -> f64 { series.iter().zip(&series[lag..]).map(|(a, b)| a * b).sum() };
    let own = at(0);
    let pairs = (1..series.len() / 2).step_by(2).map(|lag| (at(lag) + at(lag + 1)) / own);
    1.0 + 2.0 * pairs.take_while(|pair| *pair > 0.0).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_count_for_less_and_parameters_for_as_much() {
        let (gain, penalty) = (100.0, 12.0);
        assert_eq!(quasi_bic(penalty - gain, gain, 1.0), penalty - gain);
        assert_eq!(quasi_bic(penalty - gain, gain, 10.0), penalty - gain / 10.0);
    }

    #[test]
    fn what_comes_in_waves_says_less_than_what_does_not() {
        let wave: Vec<f64> = (0..64).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let turns: Vec<f64> = (0..64).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        // A quarter of a wave of 63 says the same; signs that alternate say no less than they are.
        assert!((10.0..30.0).contains(&correlation_length(&wave)), "{}", correlation_length(&wave));
        assert!(correlation_length(&turns) <= 1.0);
    }

    /// Beside a smooth curve independent errors make no waves, and those that neighbours share do.
    #[test]
    fn only_shared_errors_make_waves_beside_a_curve() {
        use crate::diagnose::shared_errors::WAVES;
        use rand::SeedableRng;
        use rand_distr::{Distribution, StandardNormal};

        let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        // Four flights of six coordinates, 30 poses each.
        let mut mean_length = |shared: f64| -> f64 {
            let lengths = (0..24).map(|_| {
                let mut drawn = || -> f64 { StandardNormal.sample(&mut random) };
                let mut error = drawn();
                let series = (0..30).map(|i| {
                    error = shared * error + (1.0 - shared * shared).sqrt() * drawn();
                    error + 0.1 * f64::from(i * i)
                });
                correlation_length(&beside_a_curve(series.collect()))
            });
            lengths.sum::<f64>() / 24.0
        };
        for _ in 0..20 {
            let (own, shared) = (mean_length(0.0), mean_length(0.8));
            assert!(own < 1.1 && 1.1 < WAVES, "{own}");
            assert!(shared > WAVES, "{shared}");
        }
    }
}
