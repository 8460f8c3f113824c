//! How surely one of two wrong models misses less than another: the difference of what they miss, pose by
//! pose, over the deviation of its sum (Vuong, *Likelihood ratio tests for model selection and non-nested
//! hypotheses*, 1989; for series Rivers & Vuong, *Model selection tests for nonlinear dynamic models*,
//! 2002). A few poses that no model meets may decide between two; then their number says little.

use super::dependence::correlation_length;
use super::ranking::TELLS_APART;
use crate::reconstruct::refined::Fitted;

/// What a fit misses, by body and pose.
#[derive(Debug, Clone)]
pub(crate) struct Misses {
    /// Of position and orientation, over the mean of all; 0 where it isn't annotated.
    shares: Vec<Vec<[f64; 2]>>,
    /// The mean square of each channel, m² and rad²; 0 where there is none.
    means: [f64; 2],
}

impl Misses {
    pub(crate) fn of(fitted: &Fitted) -> Misses {
        let mut residuals = fitted.best().solution.residuals.iter();
        let square = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        let squares = fitted.refined.bodies.iter().map(|body| {
            let of_pose = body.poses.iter().zip(residuals.by_ref()).map(|(pose, residual)| {
                let scale = pose.noise_scale.powi(-2);
                let turn = if pose.has_orientation { square(&residual.turn_rad) } else { 0.0 };
                [square(&residual.position_m) * scale, turn * scale]
            });
            of_pose.collect()
        });
        Misses::new(squares.collect())
    }

    fn new(mut squares: Vec<Vec<[f64; 2]>>) -> Misses {
        let means = [0, 1].map(|channel| {
            let all = squares.iter().flatten().map(|pose| pose[channel]);
            let seen = all.clone().filter(|square| *square > 0.0).count();
            all.sum::<f64>() / seen.max(1) as f64
        });
        for pose in squares.iter_mut().flatten() {
            for (square, mean) in pose.iter_mut().zip(means) {
                *square = if mean > 0.0 { *square / mean } else { 0.0 };
            }
        }
        Misses { shares: squares, means }
    }

    /// By how much more −2 ln L each pose has in `other`, each at its own most likely noise.
    fn less_than(&self, other: &Misses) -> Vec<Vec<f64>> {
        let ratio = [0, 1].map(|channel| match self.means[channel] * other.means[channel] > 0.0 {
            true => (other.means[channel] / self.means[channel]).ln(),
            false => 0.0,
        });
        let of_pose = |(own, other): (&[f64; 2], &[f64; 2])| -> f64 {
            let seen = (0..2).filter(|&channel| own[channel] > 0.0);
            3.0 * seen.map(|channel| ratio[channel] + other[channel] - own[channel]).sum::<f64>()
        };
        let of_body = |(own, other): (&Vec<[f64; 2]>, &Vec<[f64; 2]>)| {
            own.iter().zip(other).map(of_pose).collect()
        };
        self.shares.iter().zip(&other.shares).map(of_body).collect()
    }
}

/// What a difference of −2 ln L between two models may count at most, from what they miss in each
/// throw: as much as tells them apart, where it is as sure as 99 %.
pub(crate) fn most_counted(one: &[&Misses], other: &[&Misses]) -> f64 {
    /// Of a deviate of Gauss, on both sides.
    const SURE: f64 = 2.576;
    let differences = one.iter().zip(other).flat_map(|(one, other)| one.less_than(other));
    let (sum, variance) = differences.fold((0.0, 0.0), |(sum, variance), series| {
        let (own, its_variance) = of_series(series);
        (sum + own, variance + its_variance)
    });
    if variance > 0.0 { TELLS_APART * (sum / SURE).powi(2) / variance } else { f64::INFINITY }
}

/// The sum of a series, and the variance of such a sum.
fn of_series(mut series: Vec<f64>) -> (f64, f64) {
    let sum: f64 = series.iter().sum();
    let mean = sum / series.len().max(1) as f64;
    series.iter_mut().for_each(|one| *one -= mean);
    let squares: f64 = series.iter().map(|one| one * one).sum();
    let length = if squares > 0.0 { correlation_length(&series).max(1.0) } else { 1.0 };
    (sum, squares * length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions that are missed by these squares, m².
    fn misses(squares: impl Iterator<Item = f64>) -> Misses {
        Misses::new(vec![squares.map(|square| [square, 0.0]).collect()])
    }

    /// All squares together are twice those of the best in both.
    #[test]
    fn few_poses_decide_less_surely_than_all() {
        let best = misses([1.0; 100].into_iter());
        let everywhere = misses((0..100).map(|i| 1.9 + 0.2 * f64::from(i % 2)));
        let at_once = misses((0..100).map(|i| if i == 50 { 101.0 } else { 1.0 }));
        assert!(most_counted(&[&best], &[&everywhere]) > 100.0 * TELLS_APART);
        let one_way = most_counted(&[&best], &[&at_once]);
        let back = most_counted(&[&at_once], &[&best]);
        assert!(one_way < TELLS_APART && (one_way / back - 1.0).abs() < 1e-9, "{one_way}, {back}");
    }

    #[test]
    fn throws_that_agree_decide_more_surely() {
        let best = misses([1.0; 40].into_iter());
        let worse = misses((0..40).map(|i| if i % 20 == 10 { 9.0 } else { 1.0 }));
        let one = most_counted(&[&best], &[&worse]);
        let four = most_counted(&[&best; 4], &[&worse; 4]);
        assert!((four / one - 4.0).abs() < 1e-9, "{four} of four throws, {one} of one");
    }
}
