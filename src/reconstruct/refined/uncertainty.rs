//! Standard deviations, correlations and intervals of what is reported.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, StudentsT};

use super::noise::{KnownNoise, is_known};
use super::optimum::{Optimum, information};
use crate::reconstruct::Uncertainty;

/// The deviations of all reported numbers, by linear propagation.
pub(super) struct Deviations<'a> {
    optimum: &'a Optimum,
    noise: KnownNoise,
    derivatives: DMatrix<f64>,
    pub(super) std: Vec<Option<f64>>,
}

impl<'a> Deviations<'a> {
    /// `derivatives`: a row for each number, a column for each unknown.
    pub(super) fn new(optimum: &'a Optimum, noise: KnownNoise, derivatives: DMatrix<f64>) -> Self {
        let std =
            derivatives.row_iter().map(|row| optimum.covariance.std(&row.transpose())).collect();
        Deviations { optimum, noise, derivatives, std }
    }

    /// The covariance of the `count` numbers from `first` on; `None` where one isn't determined.
    pub(super) fn covariance(&self, first: usize, count: usize) -> Option<DMatrix<f64>> {
        self.std[first..first + count].iter().copied().collect::<Option<Vec<f64>>>()?;
        let rows = self.derivatives.rows(first, count);
        Some(rows * &self.optimum.covariance.matrix * rows.transpose())
    }

    /// Number `index`'s derivatives by the unknowns.
    pub(super) fn gradient(&self, index: usize) -> DVector<f64> {
        self.derivatives.row(index).transpose()
    }

    /// The deviation of one of the unknowns themselves; `None` where the data leave it open.
    pub(super) fn of_unknown(&self, column: usize) -> Option<f64> {
        let mut gradient = DVector::zeros(self.optimum.solution.size);
        gradient[column] = 1.0;
        self.optimum.covariance.std(&gradient)
    }

    /// Student's factor for a 95 % interval of number `index`. Where noise is estimated its degrees
    /// of freedom are Welch and Satterthwaite's: those of each channel, by its share in the
    /// variance.
    pub(super) fn factor_95(&self, index: usize) -> f64 {
        let dof = self.dof(&self.gradient(index));
        match StudentsT::new(0.0, 1.0, dof) {
            Ok(student) if dof < 1e6 => student.inverse_cdf(0.975),
            _ => 1.959_963_984_540_054,
        }
    }

    /// Whether the deviation of number `index` rests on noises that are known; a hundredth of its
    /// variance may rest on others.
    pub(super) fn noise_is_known(&self, index: usize) -> bool {
        let shares = self.shares(&self.gradient(index));
        shares.iter().all(|(dof, share)| is_known(*dof) || *share < 0.01)
    }

    /// The degrees of freedom of the noise in the number with this gradient; infinite where the
    /// noise is stated.
    fn dof(&self, gradient: &DVector<f64>) -> f64 {
        let shares = self.shares(gradient);
        let estimated = shares.iter().filter_map(|(dof, share)| Some((dof.as_ref()?, share)));
        let uncertainty: f64 =
            estimated.filter(|(_, share)| **share > 0.0).map(|(dof, s)| s * s / dof.max(1.0)).sum();
        1.0 / uncertainty
    }

    /// Of each channel the degrees of freedom of its noise, and its share in the variance of the
    /// number with this gradient.
    fn shares(&self, gradient: &DVector<f64>) -> [(Option<f64>, f64); 2] {
        let solution = &self.optimum.solution;
        let along = &self.optimum.covariance.matrix * gradient;
        let variance = gradient.dot(&along);
        [
            (self.noise.position_dof, &solution.position_information),
            (self.noise.orientation_dof, &solution.orientation_information),
        ]
        .map(|(dof, channel)| {
            let share = along.dot(&(information(solution, channel) * &along)) / variance;
            (dof, if share.is_finite() { share } else { 0.0 })
        })
    }

    /// As it stands in the result.
    pub(super) fn table(&self, quantities: Vec<String>) -> Uncertainty {
        // What can't vary, or doesn't exist, has a derivative of exactly zero.
        let std: Vec<Option<f64>> = self.std.iter().map(|std| std.filter(|s| *s > 0.0)).collect();
        let all =
            &self.derivatives * &self.optimum.covariance.matrix * self.derivatives.transpose();
        let correlation = (0..std.len())
            .map(|row| {
                (0..=row)
                    .map(|column| {
                        let product = std[row]? * std[column]?;
                        let value = all[(row, column)] / product;
                        value.is_finite().then(|| value.clamp(-1.0, 1.0))
                    })
                    .collect()
            })
            .collect();
        Uncertainty { quantities, std, correlation }
    }
}
