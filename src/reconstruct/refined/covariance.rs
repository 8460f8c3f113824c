//! What the data determine, and how well: the inverse of the information matrix.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Below this pivot of the information, scaled to a unit diagonal, a direction of the unknowns is
/// looked at more closely; the rounding of its sums is some 1e-14.
const SMALL_PIVOT: f64 = 1e-9;
/// Eigenvalues below are rounding: nothing in the data depends on that direction.
const NULL_EIGENVALUE: f64 = 1e-12;
/// The share of a gradient's square that may lie in directions that no datum depends on.
const TOLERATED_SHARE: f64 = 1e-8;

/// The covariance of the unknowns, with the directions that the data say nothing of.
#[derive(Debug, Clone)]
pub(crate) struct Covariance {
    pub(crate) matrix: DMatrix<f64>,
    /// Unit vectors in the scaled unknowns, column by column.
    undetermined: DMatrix<f64>,
    scale: DVector<f64>,
}

impl Covariance {
    /// The inverse of `information`, or its pseudo-inverse where it has none.
    pub(super) fn new(information: &DMatrix<f64>) -> Self {
        let size = information.nrows();
        let known = information.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
        // What no datum depends on at all weighs as much as what is known worst: it must stand out in
        // a gradient, however small the noise.
        let worst = known.max();
        let scale = known.map(|scale| if scale > 0.0 { scale } else { worst });
        let scaled = DMatrix::from_fn(size, size, |i, j| information[(i, j)] * scale[i] * scale[j]);
        let (inverse, undetermined) = invert(scaled);
        let matrix = DMatrix::from_fn(size, size, |i, j| inverse[(i, j)] * scale[i] * scale[j]);
        Covariance { matrix, undetermined, scale }
    }

    /// The standard deviation of a quantity with this `gradient`; `None` where the data leave it
    /// open.
    pub(super) fn std(&self, gradient: &DVector<f64>) -> Option<f64> {
        let scaled = gradient.component_mul(&self.scale);
        let open = self.undetermined.tr_mul(&scaled).norm_squared();
        if open > TOLERATED_SHARE * scaled.norm_squared() {
            return None;
        }
        let variance = gradient.dot(&(&self.matrix * gradient));
        (variance >= 0.0).then(|| variance.sqrt())
    }
}

fn invert(scaled: DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let size = scaled.nrows();
    if let Some(cholesky) = scaled.clone().cholesky() {
        let pivots = cholesky.l_dirty().diagonal();
        if pivots.iter().all(|pivot| pivot * pivot > SMALL_PIVOT) {
            return (cholesky.inverse(), DMatrix::zeros(size, 0));
        }
    }
    let eigen = SymmetricEigen::new(scaled);
    let mut inverse = DMatrix::zeros(size, size);
    let mut open = Vec::new();
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > NULL_EIGENVALUE {
            inverse.ger(1.0 / value, &vector, &vector, 1.0);
        } else {
            open.push(vector.into_owned());
        }
    }
    let undetermined = match open.is_empty() {
        true => DMatrix::zeros(size, 0),
        false => DMatrix::from_columns(&open),
    };
    (inverse, undetermined)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two unknowns of which only the sum is measured: the sum has a deviation, neither alone has.
    #[test]
    fn what_nothing_depends_on_has_no_deviation() {
        let covariance = Covariance::new(&DMatrix::from_row_slice(2, 2, &[4.0, 4.0, 4.0, 4.0]));
        let sum = covariance.std(&DVector::from_vec(vec![1.0, 1.0]));
        assert!((sum.unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(covariance.std(&DVector::from_vec(vec![1.0, 0.0])), None);
    }

    /// The same where the two are of very different size.
    #[test]
    fn a_sum_of_different_units_has_a_deviation() {
        let covariance = Covariance::new(&DMatrix::from_row_slice(2, 2, &[1.0, 1e-3, 1e-3, 1e-6]));
        let sum = covariance.std(&DVector::from_vec(vec![1.0, 1e-3]));
        assert!((sum.unwrap() - 1.0).abs() < 1e-12, "{sum:?}");
        for alone in [vec![1.0, 0.0], vec![0.0, 1.0]] {
            assert_eq!(covariance.std(&DVector::from_vec(alone)), None);
        }
    }

    /// The same when the other unknown is known to a thousand-millionth, and the noise so small.
    #[test]
    fn what_nothing_depends_on_is_not_drowned_by_what_is_known_well() {
        let covariance =
            Covariance::new(&DMatrix::from_diagonal(&DVector::from_vec(vec![1e18, 0.0])));
        assert!(covariance.std(&DVector::from_vec(vec![1.0, 0.0])).is_some());
        assert_eq!(covariance.std(&DVector::from_vec(vec![1.0, 0.1])), None);
    }

    /// Units of very different size are no lack of information.
    #[test]
    fn scales_of_unknowns_do_not_matter() {
        let covariance =
            Covariance::new(&DMatrix::from_diagonal(&DVector::from_vec(vec![1e20, 1e-20])));
        let small = covariance.std(&DVector::from_vec(vec![1.0, 0.0])).unwrap();
        let large = covariance.std(&DVector::from_vec(vec![0.0, 1.0])).unwrap();
        assert!((small / 1e-10 - 1.0).abs() < 1e-12 && (large / 1e10 - 1.0).abs() < 1e-12);
    }
}
