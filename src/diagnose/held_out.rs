//! How well a model predicts poses that it wasn't fitted to.
//!
//! Blocks of neighbouring poses are left out, one after the other. Where the model is as good as
//! linear, what the others predict follows from the hat matrix H of the whole fit: the residuals of
//! block B become (1 − H_BB)⁻¹ r_B, with the covariance (1 − H_BB)⁻¹ (Cook & Weisberg, *Residuals and
//! Influence in Regression*, 1982).

use nalgebra::{DMatrix, DVector};

use crate::reconstruct::refined::{Fitted, linearised};

/// Blocks that a flight is cut into.
const BLOCKS: usize = 3;
/// Of long films more poses make no block: what lies far from all others is foretold by nobody, and the
/// time that a block takes grows with its size.
const LARGEST_BLOCK: usize = 60;
/// The least precision, 1/σ², of a prediction: what is foretold to no better than some four times the
/// noise is judged by the rounding of the fit and the bend of the model, not by the effect.
const PREDICTED: f64 = 0.05;

/// What a fitted model predicts of each block from the poses outside it.
#[derive(Debug, Clone)]
pub(crate) struct HeldOut {
    blocks: Vec<Block>,
}

#[derive(Debug, Clone)]
struct Block {
    rows: Vec<Row>,
    /// The directions that the block has a part in fitting, with the precision that it is predicted
    /// with along each, 1/σ²; 0 along what isn't predicted. Along all others it is 1: the noise's.
    fitted: Vec<(f64, DVector<f64>)>,
    /// By how much each number is missed, over its noise.
    missed: DVector<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Row {
    index: usize,
    is_position: bool,
    /// m, or rad of an orientation.
    std: f64,
    /// Of the pose's noise over that of the others.
    noise_scale: f64,
}

/// [`HeldOut::position_rmse_m`] of a fitted model by itself.
pub(crate) fn held_out_rmse_m(fitted: &Fitted) -> Option<f64> {
    HeldOut::of(fitted, fitted.collision_time_s()).map(|held_out| held_out.position_rmse_m())
}

impl HeldOut {
    /// The predictions of `fitted` for blocks of flights that meet at `collision_time_s`; `None` where
    /// it can't be linearised.
    pub(crate) fn of(fitted: &Fitted, collision_time_s: f64) -> Option<HeldOut> {
        let best = fitted.best();
        let tangent = linearised(&fitted.refined, &best.solution.unknowns, best.gap).ok()?;
        let root = square_root(&best.covariance.matrix);
        let predicted = |rows: Vec<Row>| {
            let indices: Vec<usize> = rows.iter().map(|row| row.index).collect();
            let fitted = fitted_directions(&(tangent.jacobian.select_rows(&indices) * &root));
            let mut missed = tangent.residuals.select_rows(&indices);
            for (precision, direction) in &fitted {
                let along = direction.dot(&missed);
                let foretold = if *precision > 0.0 { along / precision } else { 0.0 };
                missed.axpy(foretold - along, direction, 1.0);
            }
            Block { rows, fitted, missed }
        };
        let blocks = blocks(fitted, collision_time_s).into_iter().map(predicted).collect();
        Some(HeldOut { blocks })
    }

    /// Root mean square of the positions' misses in m, weighted by how surely each is predicted and by how
    /// noisy it is.
    pub(crate) fn position_rmse_m(&self) -> f64 {
        let (mut weights, mut squares_m2) = (0.0, 0.0);
        for block in &self.blocks {
            for (place, row) in block.rows.iter().enumerate().filter(|(_, row)| row.is_position) {
                let part = |(precision, direction): &(f64, DVector<f64>)| {
                    (precision - 1.0) * direction[place].powi(2)
                };
                let sure = 1.0 + block.fitted.iter().map(part).sum::<f64>();
                let weight = sure / row.noise_scale.powi(2);
                weights += weight;
                squares_m2 += weight * (row.std * block.missed[place]).powi(2);
            }
        }
        (squares_m2 / f64::max(weights, f64::MIN_POSITIVE)).sqrt()
    }

    /// By how much the square of what it misses is less than that of a `smaller` model, along the
    /// directions that it predicts, in units of how surely: what a model can't know of a block it
    /// isn't blamed for.
    pub(crate) fn gain_on(&self, smaller: &HeldOut) -> f64 {
        let pairs = self.blocks.iter().zip(&smaller.blocks);
        let gain = |(own, other): (&Block, &Block)| {
            let scales = own.rows.iter().zip(&other.rows).map(|(own, other)| other.std / own.std);
            let scales = DVector::from_iterator(own.rows.len(), scales);
            let missed = other.missed.component_mul(&scales);
            own.square(&missed) - own.square(&own.missed)
        };
        pairs.map(gain).sum()
    }
}

impl Block {
    /// The square of what is `missed`, in units of how surely it is predicted.
    fn square(&self, missed: &DVector<f64>) -> f64 {
        let along = |(precision, direction): &(f64, DVector<f64>)| {
            (precision - 1.0) * direction.dot(missed).powi(2)
        };
        missed.norm_squared() + self.fitted.iter().map(along).sum::<f64>()
    }
}

/// A matrix whose square, times its transpose, is `covariance`.
fn square_root(covariance: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = covariance.clone().symmetric_eigen();
    let lengths = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
    eigen.eigenvectors * DMatrix::from_diagonal(&lengths)
}

/// The eigenvectors of H_BB = `root` · `root`ᵀ but for those of no leverage h, and with each 1 − h, or
/// 0 where that is too little.
fn fitted_directions(root: &DMatrix<f64>) -> Vec<(f64, DVector<f64>)> {
    /// Less is rounding.
    const LEAST_LEVERAGE: f64 = 1e-12;
    let eigen = root.tr_mul(root).symmetric_eigen();
    let all = eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter());
    let all = all.filter(|(leverage, _)| **leverage > LEAST_LEVERAGE);
    all.map(|(leverage, direction)| {
        let precision = 1.0 - leverage;
        let known = if precision > PREDICTED { precision } else { 0.0 };
        (known, root * direction / leverage.sqrt())
    })
    .collect()
}

/// Each flight of each body, cut into blocks of neighbours.
fn blocks(fitted: &Fitted, collision_time_s: f64) -> Vec<Vec<Row>> {
    let mut blocks = Vec::new();
    let mut index = 0;
    for body in &fitted.refined.bodies {
        let split = body.poses.partition_point(|pose| pose.time_s < collision_time_s);
        for flight in [&body.poses[..split], &body.poses[split..]] {
            let size = flight.len().div_ceil(BLOCKS).clamp(1, LARGEST_BLOCK);
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
                        rows.push(Row {
                            index: index + row,
                            is_position,
                            std,
                            noise_scale: pose.noise_scale,
                        });
                    }
                    index += if oriented { 6 } else { 3 };
                }
                blocks.push(rows);
            }
        }
    }
    blocks
}
