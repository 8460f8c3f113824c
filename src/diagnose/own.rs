//! What one throw says of an effect, and what several say of it together: near its optimum a throw's
//! −2 ln L is (θ − θ̂)ᵀ I (θ − θ̂), with its estimate θ̂ and the information I after all its other
//! unknowns. Where it leaves more than noise, that counts for less (quasi-likelihood). Of factors θ holds
//! the logarithms: so a common factor of three, which a lone body may not tell, is the same direction in
//! every throw, wherever its estimate lies.

use nalgebra::{DMatrix, DVector};

use super::misses::Misses;
use super::pooled::Throw;
use crate::Result;
use crate::reconstruct::refined::{Instance, information_of_last};

/// What one throw says of an effect.
#[derive(Debug, Clone)]
pub(crate) struct Own {
    pub(crate) instance: Instance,
    /// θ̂.
    pub(super) values: DVector<f64>,
    /// I, of the noise alone.
    information: DMatrix<f64>,
    /// By how much its own −2 ln L falls at its own values.
    pub(super) gain: f64,
    pub(super) spare: f64,
    /// With its own values.
    pub(super) misses: Misses,
    /// The factor by which what it says counts for less, at least 1.
    pub(super) dispersion: f64,
}

impl Own {
    /// Of a throw with the effect fitted to it alone; `None` where it can't show it.
    pub(super) fn of(throw: &Throw, instance: &Instance) -> Result<Option<Own>> {
        let free =
            if instance.is_of_all_throws() { instance.clone().freely() } else { instance.clone() };
        let with = throw.fitted.with_quickly(throw.scene, &free)?;
        let information = information_of_last(&with)?;
        let Some(acting) = with.acting.last() else { return Ok(None) };
        let range = acting.first..acting.first + acting.count;
        let unknowns = &with.best().solution.unknowns.parameters[range.clone()];
        let rules = &with.refined.parameters[range];
        let free = unknowns.iter().zip(rules).filter(|(_, rule)| !rule.held);
        let values: Vec<f64> = free.map(|(value, _)| *value).collect();
        if values.is_empty() || information.trace() <= 0.0 {
            return Ok(None);
        }
        // dθ of a logarithm is the value's own share.
        let slopes = slopes(instance, &values);
        let information = DMatrix::from_fn(slopes.len(), slopes.len(), |i, j| {
            slopes[i] * information[(i, j)] * slopes[j]
        });
        Ok(Some(Own {
            instance: instance.clone(),
            values: DVector::from_vec(in_logarithms(instance, &values)),
            information,
            gain: throw.fitted.fall_to(&with).max(0.0),
            spare: with.numbers() - with.used(),
            misses: Misses::of(&with),
            dispersion: 1.0,
        }))
    }

    /// The same, where it counts for less by `dispersion`.
    pub(super) fn dispersed(self, dispersion: f64) -> Own {
        Own { dispersion, ..self }
    }

    /// What its information counts for.
    pub(super) fn weight(&self) -> DMatrix<f64> {
        &self.information / self.dispersion
    }

    /// By how much its −2 ln L falls from the null to `at`.
    pub(super) fn gain_at(&self, at: &DVector<f64>) -> f64 {
        self.gain - off(&self.values, at, &self.information)
    }

    /// The effect's own numbers, and one standard deviation of each.
    pub(super) fn estimates(&self) -> (Vec<f64>, Vec<Option<f64>>) {
        in_numbers(&self.instance, &self.values, deviations(&self.weight()))
    }

    /// How many directions of the values the throw tells.
    pub(super) fn rank(&self) -> usize {
        rank(&self.information)
    }
}

/// Whether each free scalar is a factor.
fn are_factors(instance: &Instance) -> impl Iterator<Item = bool> {
    let free = instance.free_parameters();
    free.flat_map(|parameter| parameter.null.iter().map(|_| parameter.is_factor()))
}

/// θ of the effect's free numbers.
pub(super) fn in_logarithms(instance: &Instance, numbers: &[f64]) -> Vec<f64> {
    let theta = |(number, is_factor): (&f64, bool)| if is_factor { number.ln() } else { *number };
    numbers.iter().zip(are_factors(instance)).map(theta).collect()
}

/// The effect's free numbers of θ, and their deviations of its.
pub(super) fn in_numbers(
    instance: &Instance,
    theta: &DVector<f64>,
    stds: Vec<Option<f64>>,
) -> (Vec<f64>, Vec<Option<f64>>) {
    let number = |(theta, is_factor): (&f64, bool)| if is_factor { theta.exp() } else { *theta };
    let numbers: Vec<f64> = theta.iter().zip(are_factors(instance)).map(number).collect();
    let slopes = slopes(instance, &numbers);
    let stds = stds.into_iter().zip(slopes).map(|(std, slope)| Some(slope * std?));
    (numbers, stds.collect())
}

/// d number / dθ.
fn slopes(instance: &Instance, numbers: &[f64]) -> Vec<f64> {
    let slope = |(number, is_factor): (&f64, bool)| if is_factor { *number } else { 1.0 };
    numbers.iter().zip(are_factors(instance)).map(slope).collect()
}

/// (θ − `at`)ᵀ I (θ − `at`).
pub(super) fn off(values: &DVector<f64>, at: &DVector<f64>, information: &DMatrix<f64>) -> f64 {
    let off = values - at;
    off.dot(&(information * &off))
}

/// One standard deviation of each number of which an information tells.
pub(super) fn deviations(information: &DMatrix<f64>) -> Vec<Option<f64>> {
    /// A number of which so much isn't told isn't told: it has no part in the inverse.
    const UNTOLD: f64 = 1e-6;
    let size = information.nrows();
    let Ok(inverse) = information.clone().pseudo_inverse(1e-12 * information.norm()) else {
        return vec![None; size];
    };
    let told = &inverse * information;
    let std = |i: usize| (told[(i, i)] > 1.0 - UNTOLD).then(|| inverse[(i, i)].max(0.0).sqrt());
    (0..size).map(std).collect()
}

/// Σ I, without the throw `left_out`.
pub(super) fn information(known: &[&Own], left_out: Option<usize>) -> DMatrix<f64> {
    let size = known[0].values.len();
    let rest = known.iter().enumerate().filter(|(index, _)| Some(*index) != left_out);
    rest.fold(DMatrix::zeros(size, size), |sum, (_, own)| sum + own.weight())
}

/// θ̄ = (Σ I)⁻¹ Σ I θ̂, without the throw `left_out`.
pub(super) fn mean(known: &[&Own], left_out: Option<usize>) -> Option<DVector<f64>> {
    let total = information(known, left_out);
    let rest = known.iter().enumerate().filter(|(index, _)| Some(*index) != left_out);
    let weighted =
        rest.fold(DVector::zeros(total.nrows()), |sum, (_, own)| sum + own.weight() * &own.values);
    let tolerance = 1e-12 * total.norm();
    (tolerance > 0.0)
        .then(|| total.pseudo_inverse(tolerance).ok().map(|inverse| inverse * weighted))?
}

/// By how much better the estimate of throw `index` is met by what the others say than by the `null`, in
/// units of how surely either throws or others know: as the parallel sum A (A + B)⁻¹ B of their
/// informations.
pub(super) fn foretold(known: &[&Own], index: usize, null: &DVector<f64>) -> Option<f64> {
    let own = known[index];
    let mean = mean(known, Some(index))?;
    let others = information(known, Some(index));
    let both = own.weight() + &others;
    let tolerance = 1e-12 * both.norm();
    let weight = own.weight() * both.pseudo_inverse(tolerance).ok()? * others;
    Some(off(&own.values, null, &weight) - off(&own.values, &mean, &weight))
}

/// How many directions an information tells.
pub(super) fn rank(information: &DMatrix<f64>) -> usize {
    let scale = information.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
    let scaled = DMatrix::from_fn(information.nrows(), information.ncols(), |i, j| {
        information[(i, j)] * scale[i] * scale[j]
    });
    scaled.symmetric_eigenvalues().iter().filter(|value| **value > 1e-9).count().max(1)
}
