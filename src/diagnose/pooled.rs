//! Several throws of the same objects: each is fitted alone, and what they say of an effect that they
//! share is put together.
//!
//! Near its optimum a throw's −2 ln L is (θ − θ̂)ᵀ I (θ − θ̂), with the estimate θ̂ and the information
//! I after all its other unknowns. The sum over the throws has its optimum at θ̄ = (Σ I)⁻¹ Σ I θ̂, and
//! what is left there, Q, tells whether they agree. Where they scatter more than their errors say,
//! errors grow by Birge's ratio; where that is more than chance, the scatter itself decides what is
//! significant.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::FALSE_ALARM;
use crate::reconstruct::refined::{Fitted, Instance, information_of_last};
use crate::{Result, Scene};

/// A throw, and the model as it is so far.
#[derive(Clone)]
pub(crate) struct Throw<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) fitted: Fitted,
}

/// An effect on all throws.
#[derive(Debug, Clone)]
pub(crate) struct PooledCandidate {
    pub(crate) label: String,
    /// As each throw has it; `None` where a throw can't show it.
    pub(crate) own: Vec<Option<Own>>,
    /// Whether all throws have the same parameters; an impulse of a third party is each one's own.
    pub(crate) is_shared: bool,
    /// θ̄; empty where each throw has its own.
    pub(crate) values: Vec<f64>,
    /// Of θ̄, with the scatter; `None` where no throw tells it.
    pub(crate) stds: Vec<Option<f64>>,
    /// By how much −2 ln L of all throws falls with θ̄ in each; over Birge's ratio squared, where they
    /// disagree.
    pub(crate) delta: f64,
    pub(crate) parameters: usize,
    pub(crate) p_value: f64,
    pub(crate) bic: f64,
    /// Q's; `None` of a single throw.
    pub(crate) agreement: Option<f64>,
    /// Birge's ratio, at least 1.
    pub(crate) scatter: f64,
    /// Whether throws are met better with what the others say of the effect.
    pub(crate) predicts: bool,
    /// Whether θ̄ is one that the effect can have, within its errors.
    pub(crate) is_possible: bool,
}

/// What one throw says of an effect.
#[derive(Debug, Clone)]
pub(crate) struct Own {
    pub(crate) instance: Instance,
    pub(crate) values: DVector<f64>,
    pub(crate) information: DMatrix<f64>,
    /// By how much its own −2 ln L falls at its own values.
    gain: f64,
    spare: f64,
}

impl PooledCandidate {
    pub(crate) fn stands_out(&self) -> bool {
        self.p_value < FALSE_ALARM && self.bic < 0.0 && self.predicts && self.is_possible
    }

    /// The effect as a throw has it: with the values of all throws, or free where each has its own.
    pub(crate) fn held(&self, throw: usize) -> Option<Instance> {
        let mut instance = self.own[throw].as_ref()?.instance.clone();
        if !self.is_shared {
            return Some(instance);
        }
        let mut rest = self.values.as_slice();
        for parameter in &instance.effect.parameters {
            if instance.fixed.contains_key(&parameter.name) {
                continue;
            }
            let (own, others) = rest.split_at(parameter.null.len());
            instance.fixed.insert(parameter.name.clone(), own.to_vec());
            rest = others;
        }
        Some(instance)
    }
}

/// What all `throws` say of each effect, the best explanation first.
pub(crate) fn pooled(throws: &[Throw], instances: &[Vec<Instance>]) -> Vec<PooledCandidate> {
    let mut labels: Vec<String> = Vec::new();
    for (throw, own) in throws.iter().zip(instances) {
        for instance in own.iter().filter(|instance| !instance.is_of_a_moment()) {
            let label = instance.label(throw.scene);
            if !labels.contains(&label) {
                labels.push(label);
            }
        }
    }
    let tried = labels.len();
    let mut all: Vec<PooledCandidate> = labels
        .into_par_iter()
        .filter_map(|label| {
            let own = throws.iter().zip(instances).map(|(throw, instances)| {
                let instance = instances.iter().find(|i| i.label(throw.scene) == label)?;
                own(throw, instance).ok().flatten()
            });
            let own: Vec<Option<Own>> = own.collect();
            candidate(throws, label, own, tried)
        })
        .collect();
    all.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    all
}

fn own(throw: &Throw, instance: &Instance) -> Result<Option<Own>> {
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
    Ok(Some(Own {
        instance: instance.clone(),
        values: DVector::from_vec(values),
        information,
        gain: throw.fitted.fall_to(&with).max(0.0),
        spare: with.numbers() - with.used(),
    }))
}

fn candidate(
    throws: &[Throw],
    label: String,
    own: Vec<Option<Own>>,
    tried: usize,
) -> Option<PooledCandidate> {
    let known: Vec<&Own> = own.iter().flatten().collect();
    let first = known.first()?;
    if !first.instance.is_of_all_throws() {
        return Some(each_its_own(throws, label, own, tried));
    }
    let null = DVector::from_vec(free_null(&first.instance));
    let mean = mean(&known, None)?;
    let total = information(&known, None);
    let parameters = rank(&total);
    let square = |own: &Own, at: &DVector<f64>| {
        let off = &own.values - at;
        off.dot(&(&own.information * &off))
    };
    let q: f64 = known.iter().map(|own| square(own, &mean)).sum();
    let spread = (parameters * (known.len() - 1)) as f64;
    let scatter2 = if spread > 0.0 { (q / spread).max(1.0) } else { 1.0 };
    let gain: f64 = known.iter().map(|own| own.gain).sum();
    let agreement = ChiSquared::new(spread).ok().map(|chi| chi.sf(q));
    let disagree = agreement.is_some_and(|p| p < FALSE_ALARM);
    // What chance lets scatter counts in full.
    let delta = ((gain - q) / if disagree { scatter2 } else { 1.0 }).max(0.0);
    let foretold: f64 = (0..known.len()).filter_map(|index| foretold(&known, index, &null)).sum();
    let count = parameters as f64;
    let wald = {
        let off = &mean - &null;
        off.dot(&(&total * &off))
    };
    let single = significance(throws, &known, delta, count);
    // Throws that contradict each other must agree at least on there being an effect.
    let by_scatter = match FisherSnedecor::new(count, spread) {
        Ok(fisher) if disagree => fisher.sf(wald / count / scatter2),
        _ => 0.0,
    };
    let numbers: f64 = throws.iter().map(|throw| throw.fitted.numbers()).sum();
    let inverse = total.clone().pseudo_inverse(1e-12 * total.norm()).ok()?;
    let std = |i: usize| {
        let told = total[(i, i)] > 0.0;
        told.then(|| (scatter2 * inverse[(i, i)]).sqrt())
    };
    let stds: Vec<Option<f64>> = (0..null.len()).map(std).collect();
    Some(PooledCandidate {
        label,
        values: mean.iter().copied().collect(),
        is_possible: is_possible(&first.instance, &mean, &stds),
        stds,
        delta,
        parameters,
        p_value: (tried as f64 * single.max(by_scatter)).min(1.0),
        bic: -delta + count * numbers.ln(),
        agreement,
        scatter: scatter2.sqrt(),
        predicts: known.len() < 2 || foretold > 0.0,
        is_shared: true,
        own,
    })
}

/// An effect that every throw has with parameters of its own.
fn each_its_own(
    throws: &[Throw],
    label: String,
    own: Vec<Option<Own>>,
    tried: usize,
) -> PooledCandidate {
    let known: Vec<&Own> = own.iter().flatten().collect();
    let delta: f64 = known.iter().map(|own| own.gain).sum();
    let parameters: usize = known.iter().map(|own| rank(&own.information)).sum();
    let count = parameters as f64;
    let numbers: f64 = throws.iter().map(|throw| throw.fitted.numbers()).sum();
    PooledCandidate {
        label,
        is_shared: false,
        values: Vec::new(),
        stds: Vec::new(),
        delta,
        parameters,
        p_value: (tried as f64 * significance(throws, &known, delta, count)).min(1.0),
        bic: -delta + count * numbers.ln(),
        agreement: None,
        scatter: 1.0,
        predicts: true,
        is_possible: true,
        own,
    }
}

/// How often noise alone lets −2 ln L of all throws fall by `delta`.
fn significance(throws: &[Throw], known: &[&Own], delta: f64, count: f64) -> f64 {
    if throws.iter().all(|throw| throw.fitted.has_stated_noise()) {
        return ChiSquared::new(count).map_or(1.0, |chi| chi.sf(delta));
    }
    let spare: f64 = known.iter().map(|own| own.spare).sum();
    let f = (delta / spare).exp_m1() * spare / count;
    FisherSnedecor::new(count, spare.max(1.0)).map_or(1.0, |fisher| fisher.sf(f))
}

/// Whether `values` are within the effect's bounds, or beyond them by no more than their errors.
fn is_possible(instance: &Instance, values: &DVector<f64>, stds: &[Option<f64>]) -> bool {
    /// Deviations.
    const BEYOND: f64 = 3.0;
    let free = instance.effect.parameters.iter();
    let free = free.filter(|parameter| !instance.fixed.contains_key(&parameter.name));
    let bounds = free.flat_map(|parameter| parameter.null.iter().map(|_| parameter.bounds));
    bounds.zip(values.iter().zip(stds)).all(|([low, high], (value, std))| {
        let beyond = BEYOND * std.unwrap_or(f64::INFINITY);
        value + beyond >= low && value - beyond <= high
    })
}

fn free_null(instance: &Instance) -> Vec<f64> {
    let free = instance.effect.parameters.iter();
    let free = free.filter(|parameter| !instance.fixed.contains_key(&parameter.name));
    free.flat_map(|parameter| parameter.null.iter().copied()).collect()
}

/// Σ I, without the throw `left_out`.
fn information(known: &[&Own], left_out: Option<usize>) -> DMatrix<f64> {
    let size = known[0].values.len();
    let rest = known.iter().enumerate().filter(|(index, _)| Some(*index) != left_out);
    rest.fold(DMatrix::zeros(size, size), |sum, (_, own)| sum + &own.information)
}

/// θ̄, without the throw `left_out`.
fn mean(known: &[&Own], left_out: Option<usize>) -> Option<DVector<f64>> {
    let total = information(known, left_out);
    let rest = known.iter().enumerate().filter(|(index, _)| Some(*index) != left_out);
    let weighted = rest
        .fold(DVector::zeros(total.nrows()), |sum, (_, own)| sum + &own.information * &own.values);
    let tolerance = 1e-12 * total.norm();
    (tolerance > 0.0)
        .then(|| total.pseudo_inverse(tolerance).ok().map(|inverse| inverse * weighted))?
}

/// By how much better the estimate of throw `index` is met by what the others say than by the `null`, in
/// units of how surely either throws or others know: as the parallel sum A (A + B)⁻¹ B of their
/// informations.
fn foretold(known: &[&Own], index: usize, null: &DVector<f64>) -> Option<f64> {
    let own = known[index];
    let mean = mean(known, Some(index))?;
    let others = information(known, Some(index));
    let both = &own.information + &others;
    let tolerance = 1e-12 * both.norm();
    let weight = &own.information * both.pseudo_inverse(tolerance).ok()? * others;
    let square = |at: &DVector<f64>| {
        let off = &own.values - at;
        off.dot(&(&weight * &off))
    };
    Some(square(null) - square(&mean))
}

fn rank(information: &DMatrix<f64>) -> usize {
    let scale = information.diagonal().map(|d| if d > 0.0 { 1.0 / d.sqrt() } else { 0.0 });
    let scaled = DMatrix::from_fn(information.nrows(), information.ncols(), |i, j| {
        information[(i, j)] * scale[i] * scale[j]
    });
    scaled.symmetric_eigenvalues().iter().filter(|value| **value > 1e-9).count().max(1)
}
