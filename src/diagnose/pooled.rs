//! Several throws of the same objects: each is fitted alone, and what they say of an effect that they
//! share is put together.
//!
//! The sum of what all say has its optimum at their weighted mean θ̄, and what is left there, Q, tells
//! whether they agree. Where they scatter more than their errors say, errors grow by Birge's ratio; where
//! that is more than chance, the scatter itself decides what is significant.

use nalgebra::DVector;
use rayon::prelude::*;
use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::FALSE_ALARM;
use super::candidates::of_a_body;
use super::misses::{Misses, most_counted};
use super::own::{
    Own, deviations, foretold, in_logarithms, in_numbers, information, mean, off, rank,
};
use crate::Scene;
use crate::reconstruct::refined::{Fitted, Instance};

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
    /// Whether all throws have the same parameters; an impulse of a third party is each one's own, and
    /// what throws disagree on may be.
    pub(crate) is_shared: bool,
    /// Those of θ̄; empty of what is each throw's own by its nature.
    pub(crate) values: Vec<f64>,
    /// Of θ̄, with the scatter; `None` where no throw tells it.
    pub(crate) stds: Vec<Option<f64>>,
    /// By how much −2 ln L of all throws falls with θ̄ in each, or with its own.
    pub(crate) delta: f64,
    /// What counts of it.
    counted: f64,
    pub(crate) parameters: usize,
    /// How many effects were tried.
    tried: usize,
    pub(crate) p_value: f64,
    /// Schwarz's criterion, by what counts; below 0 where the effect helps.
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

impl PooledCandidate {
    pub(crate) fn stands_out(&self) -> bool {
        self.p_value < FALSE_ALARM && self.bic < 0.0 && self.predicts && self.is_possible
    }

    /// The same, but with each throw's own parameters where the throws contradict each other, and that is
    /// worth so many.
    fn or_each_its_own(self, throws: &[Throw]) -> PooledCandidate {
        if !self.is_shared || !self.disagree() {
            return self;
        }
        let apart = each_its_own(throws, self.label.clone(), self.own.clone(), self.tried);
        match apart.bic < self.bic && apart.is_possible {
            true => PooledCandidate {
                values: self.values,
                stds: self.stds,
                agreement: self.agreement,
                scatter: self.scatter,
                // The better of two ways.
                p_value: (2.0 * apart.p_value).min(1.0),
                ..apart
            },
            false => self,
        }
    }

    /// Whether each throw has its own values of what all should share: beside that anything may be.
    pub(crate) fn is_apart(&self) -> bool {
        !self.is_shared && self.disagree()
    }

    fn disagree(&self) -> bool {
        contradict(self.agreement)
    }

    /// By how much its criterion is worse than that of `other`; where something is left that none explains,
    /// what they miss counts for no more than it is sure to.
    pub(super) fn behind(&self, other: &PooledCandidate) -> f64 {
        let pairs = self.own.iter().zip(&other.own);
        let both: Vec<(&Own, &Own)> =
            pairs.filter_map(|(own, other)| Some((own.as_ref()?, other.as_ref()?))).collect();
        // With values that the throws don't share they miss less than with those that they do.
        let agree = [self, other].iter().all(|one| !one.is_shared || !one.disagree());
        if !agree || both.iter().all(|(own, _)| own.dispersion == 1.0) {
            return self.bic - other.bic;
        }
        let own: Vec<&Misses> = both.iter().map(|(own, _)| &own.misses).collect();
        let others: Vec<&Misses> = both.iter().map(|(_, other)| &other.misses).collect();
        let most = most_counted(&others, &own);
        let missed = other.counted - self.counted;
        self.bic - other.bic - missed + missed.clamp(-most, most)
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
            // Beyond its bounds by errors or by rounding it can't be given.
            let [low, high] = parameter.bounds;
            let own = own.iter().map(|value| value.clamp(low, high)).collect();
            instance.fixed.insert(parameter.name.clone(), own);
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
    let each = |label: String| {
        let own = throws.par_iter().zip(instances).map(|(throw, instances)| {
            let instance = instances.iter().find(|i| i.label(throw.scene) == label)?;
            Own::of(throw, instance).ok().flatten()
        });
        let own: Vec<Option<Own>> = own.collect();
        (label, own)
    };
    let tried = labels.len();
    in_order(throws, labels.into_par_iter().map(each).collect(), tried)
}

/// The same candidates where what a throw says counts for less by its own of `dispersions`.
pub(super) fn dispersed(
    throws: &[Throw],
    candidates: &[PooledCandidate],
    dispersions: &[f64],
) -> Vec<PooledCandidate> {
    let each = |candidate: &PooledCandidate| {
        let own =
            candidate.own.iter().zip(dispersions).map(|(own, &dispersion)| {
                own.as_ref().map(|own| own.clone().dispersed(dispersion))
            });
        (candidate.label.clone(), own.collect())
    };
    let tried = candidates.first().map_or(0, |candidate| candidate.tried);
    in_order(throws, candidates.iter().map(each).collect(), tried)
}

fn in_order(
    throws: &[Throw],
    all: Vec<(String, Vec<Option<Own>>)>,
    tried: usize,
) -> Vec<PooledCandidate> {
    let all = all.into_iter().filter_map(|(label, own)| candidate(throws, label, own, tried));
    let mut all: Vec<PooledCandidate> = all.collect();
    // What is the same in all explains more than what may be anything in each.
    if !all.iter().any(|candidate| candidate.is_shared && candidate.stands_out()) {
        all = all.into_iter().map(|candidate| candidate.or_each_its_own(throws)).collect();
    }
    all.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    all
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
    let null = DVector::from_vec(in_logarithms(&first.instance, &free_null(&first.instance)));
    let mean = mean(&known, None)?;
    let total = information(&known, None);
    let parameters = rank(&total);
    let q: f64 = known.iter().map(|own| off(&own.values, &mean, &own.weight())).sum();
    let spread = (parameters * (known.len() - 1)) as f64;
    let scatter2 = if spread > 0.0 { (q / spread).max(1.0) } else { 1.0 };
    let agreement = ChiSquared::new(spread).ok().map(|chi| chi.sf(q));
    let disagree = contradict(agreement);
    let gains = known.iter().map(|own| own.gain_at(&mean) / own.dispersion);
    // What chance lets scatter counts in full.
    let counted = (gains.sum::<f64>() / if disagree { scatter2 } else { 1.0 }).max(0.0);
    let foretold: f64 = (0..known.len()).filter_map(|index| foretold(&known, index, &null)).sum();
    let count = parameters as f64;
    let single = significance(throws, &known, counted, count);
    // Throws that contradict each other must agree at least on there being an effect.
    let by_scatter = match FisherSnedecor::new(count, spread) {
        Ok(fisher) if disagree => fisher.sf(off(&mean, &null, &total) / count / scatter2),
        _ => 0.0,
    };
    let (values, stds) = in_numbers(&first.instance, &mean, deviations(&(&total / scatter2)));
    Some(PooledCandidate {
        label,
        is_possible: is_possible(&first.instance, &values, &stds),
        values,
        stds,
        delta: known.iter().map(|own| own.gain_at(&mean)).sum::<f64>().max(0.0),
        counted,
        parameters,
        tried,
        p_value: (tried as f64 * single.max(by_scatter)).min(1.0),
        bic: bic(throws, counted, count) + of_a_body(&first.instance),
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
    let counted: f64 = known.iter().map(|own| own.gain / own.dispersion).sum();
    let parameters: usize = known.iter().map(|own| own.rank()).sum();
    let count = parameters as f64;
    PooledCandidate {
        label,
        is_shared: false,
        values: Vec::new(),
        stds: Vec::new(),
        delta: known.iter().map(|own| own.gain).sum(),
        counted,
        parameters,
        tried,
        p_value: (tried as f64 * significance(throws, &known, counted, count)).min(1.0),
        bic: bic(throws, counted, count)
            + known.first().map_or(0.0, |own| of_a_body(&own.instance)),
        agreement: None,
        scatter: 1.0,
        predicts: true,
        is_possible: known.iter().all(|own| {
            let (values, stds) = own.estimates();
            is_possible(&own.instance, &values, &stds)
        }),
        own,
    }
}

/// Schwarz's criterion of `count` parameters more that let −2 ln L fall by `counted`.
fn bic(throws: &[Throw], counted: f64, count: f64) -> f64 {
    let numbers: f64 = throws.iter().map(|throw| throw.fitted.numbers()).sum();
    count * numbers.ln() - counted
}

/// How often noise alone lets −2 ln L of all throws fall by `fall`.
fn significance(throws: &[Throw], known: &[&Own], fall: f64, count: f64) -> f64 {
    if throws.iter().all(|throw| throw.fitted.has_stated_noise()) {
        return ChiSquared::new(count).map_or(1.0, |chi| chi.sf(fall));
    }
    let spare: f64 = known.iter().map(|own| own.spare).sum();
    let f = (fall / spare).exp_m1() * spare / count;
    FisherSnedecor::new(count, spare.max(1.0)).map_or(1.0, |fisher| fisher.sf(f))
}

/// Whether throws that differ as improbably as this contradict each other.
fn contradict(agreement: Option<f64>) -> bool {
    agreement.is_some_and(|p_value| p_value < FALSE_ALARM)
}

/// Whether `values` are within the effect's bounds, or beyond them by no more than their errors.
fn is_possible(instance: &Instance, values: &[f64], stds: &[Option<f64>]) -> bool {
    /// Deviations.
    const BEYOND: f64 = 3.0;
    let free = instance.free_parameters();
    let bounds = free.flat_map(|parameter| parameter.null.iter().map(|_| parameter.bounds));
    bounds.zip(values.iter().zip(stds)).all(|([low, high], (value, std))| {
        let beyond = BEYOND * std.unwrap_or(f64::INFINITY);
        value + beyond >= low && value - beyond <= high
    })
}

fn free_null(instance: &Instance) -> Vec<f64> {
    instance.free_parameters().flat_map(|parameter| parameter.null.iter().copied()).collect()
}
