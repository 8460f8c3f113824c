//! How well a model predicts poses that it hasn't seen.
//!
//! Blocks of neighbouring poses are left out, one after the other. Where the model is as good as
//! linear, what the others predict follows from the hat matrix H of the whole fit: the residuals of
//! block B become (1 − H_BB)⁻¹ r_B (Cook & Weisberg, *Residuals and Influence in Regression*, 1982).

use nalgebra::{DMatrix, DVector};

use crate::reconstruct::refined::{Fitted, Linearised, linearised};

/// Blocks that a flight is cut into.
const BLOCKS: usize = 3;
/// What the others predict to no better than a thousand times the noise, they don't predict.
const UNPREDICTED: f64 = 1e-6;

/// A fitted model as its tangent.
pub(crate) struct Tangent {
    linearised: Linearised,
    inverse: DMatrix<f64>,
    /// Rows of each block, with σ of those that are positions.
    blocks: Vec<Vec<Row>>,
}

struct Row {
    index: usize,
    /// m; `None` of an orientation.
    position_std_m: Option<f64>,
}

/// Root mean square in m of the positions, each predicted from the poses outside its block.
pub(crate) fn held_out_rmse_m(fitted: &Fitted) -> Option<f64> {
    Tangent::of(fitted)?.held_out_rmse_m()
}

impl Tangent {
    pub(crate) fn of(fitted: &Fitted) -> Option<Tangent> {
        let best = fitted.best();
        let linearised = linearised(&fitted.refined, &best.solution.unknowns, best.gap).ok()?;
        let inverse = best.covariance.matrix.clone();
        Some(Tangent { linearised, inverse, blocks: blocks(fitted) })
    }

    pub(crate) fn held_out_rmse_m(&self) -> Option<f64> {
        let (mut count, mut squares) = (0.0, 0.0);
        for block in &self.blocks {
            let rows: Vec<usize> = block.iter().map(|row| row.index).collect();
            let jacobian = self.linearised.jacobian.select_rows(&rows);
            let residuals = DVector::from_iterator(
                rows.len(),
                rows.iter().map(|&i| self.linearised.residuals[i]),
            );
            let predicted = predicted(&jacobian, &self.inverse, &residuals);
            for (row, residual) in block.iter().zip(predicted.iter()) {
                if let Some(std_m) = row.position_std_m {
                    count += 1.0;
                    squares += (std_m * residual).powi(2);
                }
            }
        }
        (count > 0.0).then(|| f64::sqrt(squares / count))
    }
}

/// (1 − H)⁻¹ r; along what only the block itself tells there is no prediction, and no error.
fn predicted(jacobian: &DMatrix<f64>, inverse: &DMatrix<f64>, r: &DVector<f64>) -> DVector<f64> {
    let hat = jacobian * inverse * jacobian.transpose();
    let rest = DMatrix::identity(r.len(), r.len()) - 0.5 * (&hat + hat.transpose());
    let eigen = rest.symmetric_eigen();
    let mut predicted = DVector::zeros(r.len());
    for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
        if *value > UNPREDICTED {
            predicted += vector * (vector.dot(r) / value);
        }
    }
    predicted
}

/// Each flight of each body, cut into blocks of neighbours.
fn blocks(fitted: &Fitted) -> Vec<Vec<Row>> {
    let time_s = fitted.best().solution.unknowns.collision_time_s;
    let mut blocks = Vec::new();
    let mut index = 0;
    for body in &fitted.refined.bodies {
        let split = body.poses.partition_point(|pose| pose.time_s < time_s);
        for flight in [&body.poses[..split], &body.poses[split..]] {
            let size = flight.len().div_ceil(BLOCKS).max(1);
            for poses in flight.chunks(size) {
                let mut rows = Vec::new();
                for pose in poses {
                    let oriented = body.has_spin && pose.has_orientation;
                    for row in 0..if oriented { 6 } else { 3 } {
                        let position_std_m = (row < 3).then_some(pose.position_std_m);
                        rows.push(Row { index: index + row, position_std_m });
                    }
                    index += if oriented { 6 } else { 3 };
                }
                blocks.push(rows);
            }
        }
    }
    blocks
}
