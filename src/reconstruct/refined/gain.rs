//! Score tests: how much χ² would fall by an effect, told from the slopes at its null alone.

use nalgebra::{DMatrix, DVector};

use super::acting::Instance;
use super::fitted::Fitted;
use super::optimum::{evaluated, information};
use crate::Result;
use crate::bridge::refined::ffi::{
    JacobianBy, RefinedBody, RefinedPose, RefinedScene, RefinedUnknowns,
};
use crate::effect::Scan;
use crate::scene::Gap;

/// Of the largest eigenvalue: the square of a column's share of a millionth.
const ROUNDING: f64 = 1e-12;

/// A model as its tangent: residuals over their deviations, and their derivatives by the unknowns;
/// the tilt's prior is two more rows.
pub(crate) struct Linearised {
    pub(crate) residuals: DVector<f64>,
    pub(crate) jacobian: DMatrix<f64>,
}

/// The tangent of a model at `unknowns`.
pub(crate) fn linearised(
    refined: &RefinedScene,
    unknowns: &RefinedUnknowns,
    gap: Gap,
) -> Result<Linearised> {
    tangent(refined, unknowns, gap, JacobianBy::Everything)
}

fn tangent(
    refined: &RefinedScene,
    unknowns: &RefinedUnknowns,
    gap: Gap,
    by: JacobianBy,
) -> Result<Linearised> {
    let solution = evaluated(refined, unknowns, gap, by)?;
    let mut residuals = Vec::new();
    let poses =
        refined.bodies.iter().flat_map(|body| body.poses.iter().map(|p| (body.has_spin, p)));
    for ((has_spin, pose), residual) in poses.zip(&solution.residuals) {
        residuals.extend(residual.position_m.map(|r| r / pose.position_std_m));
        if has_spin && pose.has_orientation {
            residuals.extend(residual.turn_rad.map(|r| r / pose.orientation_std_rad));
        }
    }
    let data = residuals.len();
    let mut jacobian = DMatrix::from_row_slice(data, solution.size, &solution.jacobian)
        .resize_vertically(data + 2, 0.0);
    let prior = information(&solution, &solution.prior_information);
    let tilted = (0..solution.size).filter(|&i| prior[(i, i)] > 0.0);
    for ((row, column), tilt) in (data..).zip(tilted).zip(unknowns.tilt) {
        jacobian[(row, column)] = prior[(column, column)].sqrt();
        residuals.push(tilt * prior[(column, column)].sqrt());
    }
    residuals.resize(data + 2, 0.0);
    Ok(Linearised { residuals: DVector::from_vec(residuals), jacobian })
}

/// By how much χ² would fall without each single pose, by body, with its stamp: what the others say
/// of it by the hat matrix H, r (1 − H)⁻¹ r.
pub(super) fn gains_without(fitted: &Fitted) -> Result<Vec<Vec<(f64, f64)>>> {
    let best = fitted.best();
    let tangent = linearised(&fitted.refined, &best.solution.unknowns, best.gap)?;
    let mut row = 0;
    let mut gain = |body: &RefinedBody, pose: &RefinedPose| {
        let count = if body.has_spin && pose.has_orientation { 6 } else { 3 };
        let jacobian = tangent.jacobian.rows(row, count);
        let residuals = tangent.residuals.rows(row, count);
        row += count;
        let rest = DMatrix::identity(count, count)
            - jacobian * &best.covariance.matrix * jacobian.transpose();
        let predicted = rest.lu().solve(&residuals);
        (pose.time_s, predicted.map_or(0.0, |predicted| residuals.dot(&predicted).max(0.0)))
    };
    let bodies = fitted.refined.bodies.iter();
    Ok(bodies.map(|body| body.poses.iter().map(|pose| gain(body, pose)).collect()).collect())
}

/// What a model would gain by an effect; exact where it is linear.
pub(crate) struct Gain {
    /// By how much χ² would fall, all else refitted.
    pub(crate) chi2: f64,
    /// Directions of the effect's free scalars that the data depend on.
    pub(crate) directions: usize,
    /// How far the free scalars would move.
    pub(crate) step: Vec<f64>,
}

/// The gain of `fitted` by each of `candidates`, with scalars at which it does nothing.
pub(crate) fn gains(fitted: &Fitted, candidates: &[(Instance, Vec<f64>)]) -> Result<Vec<Gain>> {
    let best = fitted.best();
    let tangent = linearised(&fitted.refined, &best.solution.unknowns, best.gap)?;
    let known = orthonormal(tangent.jacobian);
    let apart = |m: &DMatrix<f64>| m - &known * (known.tr_mul(m));
    let residuals = &tangent.residuals - &known * known.tr_mul(&tangent.residuals);
    let gain = |added: DMatrix<f64>| {
        let mut rest = apart(&added);
        for (mut rest, column) in rest.column_iter_mut().zip(added.column_iter()) {
            if rest.norm() < ROUNDING.sqrt() * column.norm() {
                rest.fill(0.0);
            }
        }
        let basis = orthonormal(rest.clone());
        let along = basis.tr_mul(&residuals);
        let inverse = match basis.is_empty() {
            true => None,
            false => basis.tr_mul(&rest).pseudo_inverse(ROUNDING.sqrt()).ok(),
        };
        let step =
            inverse.map_or(vec![0.0; rest.ncols()], |inverse| (-inverse * &along).data.into());
        Gain { chi2: along.norm_squared(), directions: basis.ncols(), step }
    };
    let mut gains = Vec::new();
    for some in in_passes(fitted, candidates) {
        gains.extend(columns(fitted, some)?.into_iter().map(gain));
    }
    Ok(gains)
}

/// `candidates` in turn, so many at once that the solver takes each body's derivatives in one pass:
/// in every pass all laws are followed.
fn in_passes<'a>(
    fitted: &Fitted,
    candidates: &'a [(Instance, Vec<f64>)],
) -> Vec<&'a [(Instance, Vec<f64>)]> {
    /// Derivatives that a pass takes, as in `cpp/refined_problem.cc`.
    const MOST: usize = 28;
    let mut passes = Vec::new();
    let mut first = 0;
    let mut counts = vec![0; fitted.refined.bodies.len()];
    for (index, (instance, values)) in candidates.iter().enumerate() {
        let bodies = instance.bodies(&fitted.refined);
        if index > first && bodies.iter().any(|body| counts[*body] + values.len() > MOST) {
            passes.push(&candidates[first..index]);
            first = index;
            counts.fill(0);
        }
        bodies.into_iter().for_each(|body| counts[body] += values.len());
    }
    passes.push(&candidates[first..]);
    passes
}

/// What the residuals of `fitted` change by with the free scalars of each of `candidates`.
fn columns(fitted: &Fitted, candidates: &[(Instance, Vec<f64>)]) -> Result<Vec<DMatrix<f64>>> {
    let mut refined = fitted.refined.clone();
    let best = fitted.best();
    let mut unknowns = best.solution.unknowns.clone();
    let mut columns = Vec::new();
    let mut next = best.solution.size;
    for (instance, values) in candidates {
        let acting = instance.act_on(&mut refined);
        // Which moment or pose it is, is held while a scan goes through them.
        if let Some((Scan::GapTimes | Scan::ObservationTimes, place)) = instance.scan() {
            refined.parameters[acting.first + place].held = true;
        }
        unknowns.parameters.extend(values);
        let free = refined.parameters[acting.first..].iter().filter(|rule| !rule.held).count();
        columns.push((next, free));
        next += free;
    }
    let tangent = tangent(&refined, &unknowns, best.gap, JacobianBy::Parameters)?;
    let of = |(first, count)| tangent.jacobian.columns(first, count).into_owned();
    Ok(columns.into_iter().map(of).collect())
}

/// What the data say of the free parameters of the last effect, all else refitted: the inverse of
/// their covariance, zero along what they don't tell.
pub(crate) fn information_of_last(fitted: &Fitted) -> Result<DMatrix<f64>> {
    let best = fitted.best();
    let tangent = linearised(&fitted.refined, &best.solution.unknowns, best.gap)?;
    let Some(acting) = fitted.acting.last() else { return Ok(DMatrix::zeros(0, 0)) };
    let own = fitted.columns(acting);
    let others: Vec<usize> =
        (0..tangent.jacobian.ncols()).filter(|column| !own.contains(column)).collect();
    let basis = orthonormal(tangent.jacobian.select_columns(&others));
    let columns = tangent.jacobian.columns(own.start, own.len()).into_owned();
    let apart = &columns - &basis * basis.tr_mul(&columns);
    Ok(apart.tr_mul(&apart))
}

/// An orthonormal basis of the columns' span; directions that are rounding are left out. By the
/// eigenvectors of the Gram matrix, twice: the second time makes up for the rounding of the first.
pub(super) fn orthonormal(mut columns: DMatrix<f64>) -> DMatrix<f64> {
    for mut column in columns.column_iter_mut() {
        let length = column.norm();
        if length > 0.0 {
            column /= length;
        }
    }
    for _ in 0..2 {
        if columns.is_empty() {
            break;
        }
        let eigen = columns.tr_mul(&columns).symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let kept: Vec<usize> = (0..eigen.eigenvalues.len())
            .filter(|&i| eigen.eigenvalues[i] > ROUNDING * largest)
            .collect();
        let mut turned = eigen.eigenvectors.select_columns(&kept);
        for (mut column, &i) in turned.column_iter_mut().zip(&kept) {
            column /= eigen.eigenvalues[i].sqrt();
        }
        columns *= turned;
    }
    columns
}
