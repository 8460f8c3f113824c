//! How well a model predicts poses that it hasn't seen.
//!
//! Blocks of neighbouring poses are left out, one after the other. Where the model is as good as
//! linear, what the others predict follows from the hat matrix H of the whole fit: the residuals of
//! block B become (1 − H_BB)⁻¹ r_B (Cook & Weisberg, *Residuals and Influence in Regression*, 1982).

use nalgebra::{DMatrix, DVector};

use crate::reconstruct::refined::{Fitted, Linearised, linearised};
use crate::scene::Noise;

/// Blocks that a flight is cut into.
const BLOCKS: usize = 3;
/// What the others predict to no better than a thousand times the noise, they don't predict.
const UNPREDICTED: f64 = 1e-6;

/// A fitted model as its tangent.
struct Tangent {
    linearised: Linearised,
    inverse: DMatrix<f64>,
    /// Rows of each block.
    blocks: Vec<Vec<Row>>,
}

struct Row {
    index: usize,
    is_position: bool,
    /// m, or rad of an orientation.
    std: f64,
}

/// How well poses are predicted from those outside their block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HeldOut {
    /// Root mean square of the positions, m.
    pub(crate) position_rmse_m: f64,
    /// Root mean square of the orientations' components, rad; 0 without any.
    orientation_rmse_rad: f64,
    positions: f64,
    turns: f64,
}

impl HeldOut {
    /// Root mean square of all, in deviations of this noise.
    pub(crate) fn in_sigma(&self, noise: Noise) -> f64 {
        let squares = self.positions * (self.position_rmse_m / noise.position).powi(2)
            + self.turns * (self.orientation_rmse_rad / noise.orientation).powi(2);
        (squares / (self.positions + self.turns)).sqrt()
    }
}

/// The prediction of a fitted model.
pub(crate) fn held_out(fitted: &Fitted) -> Option<HeldOut> {
    Tangent::of(fitted).map(|tangent| tangent.held_out())
}

impl Tangent {
    fn of(fitted: &Fitted) -> Option<Tangent> {
        let best = fitted.best();
        let linearised = linearised(&fitted.refined, &best.solution.unknowns, best.gap).ok()?;
        let inverse = best.covariance.matrix.clone();
        Some(Tangent { linearised, inverse, blocks: blocks(fitted) })
    }

    fn held_out(&self) -> HeldOut {
        // Count and sum of squares.
        let (mut positions, mut turns) = ((0.0, 0.0), (0.0, 0.0));
        for block in &self.blocks {
            let rows: Vec<usize> = block.iter().map(|row| row.index).collect();
            let jacobian = self.linearised.jacobian.select_rows(&rows);
            let residuals = DVector::from_iterator(
                rows.len(),
                rows.iter().map(|&row| self.linearised.residuals[row]),
            );
            let predicted = predicted(&jacobian, &self.inverse, &residuals);
            for (row, residual) in block.iter().zip(predicted.iter()) {
                let channel = if row.is_position { &mut positions } else { &mut turns };
                channel.0 += 1.0;
                channel.1 += (row.std * residual).powi(2);
            }
        }
        let rmse = |(count, squares): (f64, f64)| (squares / f64::max(count, 1.0)).sqrt();
        HeldOut {
            position_rmse_m: rmse(positions),
            orientation_rmse_rad: rmse(turns),
            positions: positions.0,
            turns: turns.0,
        }
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
                        let is_position = row < 3;
                        let std = if is_position {
                            pose.position_std_m
                        } else {
                            pose.orientation_std_rad
                        };
                        rows.push(Row { index: index + row, is_position, std });
                    }
                    index += if oriented { 6 } else { 3 };
                }
                blocks.push(rows);
            }
        }
    }
    blocks
}
