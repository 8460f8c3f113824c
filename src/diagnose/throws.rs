//! The diagnosis of several throws together.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::dependence::{inflation, quasi_bic};
use super::diagnosis::{
    Agreement, CandidateReport, DIAGNOSIS_SCHEMA, Diagnosis, ThrowEstimate, Verdict,
};
use super::pooled::{Own, PooledCandidate, Throw, pooled};
use super::ranking::TELLS_APART;
use super::together::together;
use super::verdict::EXPLAINS;
use super::words::{explanation_of_throws, listed};
use super::{Goodness, all_candidates, held_out_rmse_m, reported};
use crate::compare::{ChannelTest, channels};
use crate::effect::EffectRequest;
use crate::reconstruct::active_effect::{GIVEN, NO_DATA};
use crate::reconstruct::refined::{self, Instance};
use crate::reconstruct::{Number, ParameterEstimate, RefinedOptions};
use crate::words::quoted;
use crate::{Error, ErrorKind, Result, Scene};

/// Candidates that are told even if they don't stand out.
const FEWEST_TOLD: usize = 5;
/// Of so many throws one may fail by chance, or by a fault of its own.
const MANY: usize = 4;

/// Finds which effect is missing from the models of several throws of the same objects: as
/// [`super::diagnose`], with the parameters of an effect the same in all; but for impulses of third
/// parties at the collision, which are each throw's own. What happens to single poses or at other
/// moments isn't looked for.
///
/// # Errors
/// A scene can't be reconstructed, or an effect doesn't fit it; the message names the scene.
pub fn diagnose_throws(
    scenes: &[Scene],
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<Diagnosis> {
    let throws = throws(scenes, options)?;
    let instances = instances(&throws, further)?;
    let mut candidates = pooled(&throws, &instances);
    let (channels, is_structured) = looks(&throws)?;
    let best = put_best_first(&throws, &mut candidates)?;
    let stays_structured = best.as_ref().is_some_and(|best| best.is_structured);
    let inflation = best.as_ref().map_or(1.0, |best| best.inflation);
    let explains = |best: &Best| misses_m2(&best.throws) < EXPLAINS * misses_m2(&throws);
    let verdict = match &best {
        Some(best) if !stays_structured || explains(best) => Verdict::Missing,
        Some(_) => Verdict::UnknownEffect,
        None if is_structured => Verdict::UnknownEffect,
        None => Verdict::NothingMissing,
    };
    let least = candidates.iter().map(|c| quasi(c, inflation)).fold(0.0, f64::min);
    let weight = |bic: f64| (-0.5 * (bic - least)).exp();
    let total: f64 =
        weight(0.0) + candidates.iter().map(|c| weight(quasi(c, inflation))).sum::<f64>();
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by_key(|&index| (best.is_none() || index > 0, !candidates[index].stands_out()));
    let told = candidates.iter().filter(|c| c.stands_out()).count().max(FEWEST_TOLD);
    let reports = order
        .iter()
        .take(told)
        .filter_map(|&index| {
            let probability = weight(quasi(&candidates[index], inflation)) / total;
            report(&throws, &candidates, index, (probability, inflation))
        })
        .collect();
    let names: Vec<String> = scenes.iter().map(|scene| scene.name().to_string()).collect();
    let mut diagnosis = Diagnosis {
        schema: DIAGNOSIS_SCHEMA.to_string(),
        scene: names.join(", "),
        verdict,
        model: Vec::new(),
        channels,
        reduced_chi2: reduced_chi2(&throws),
        candidates: reports,
        probability_of_nothing: weight(0.0) / total,
        stays_structured,
        unexplained: Vec::new(),
        other_laws: Vec::new(),
        together: match verdict {
            Verdict::Missing => match with_own(&throws, &candidates[0]) {
                Some(own) => together(&own)?,
                None => Vec::new(),
            },
            _ => together(&throws)?,
        },
        explanation: String::new(),
        advice: Vec::new(),
    };
    diagnosis.explanation = explanation_of_throws(&diagnosis, scenes.len());
    diagnosis.advice = advice(&diagnosis);
    Ok(diagnosis)
}

/// Each scene fitted by the model of `options`.
pub(crate) fn throws<'a>(scenes: &'a [Scene], options: &RefinedOptions) -> Result<Vec<Throw<'a>>> {
    if scenes.is_empty() {
        return Err(Error::new(ErrorKind::Invalid, "there is no scene").mend("give one or more"));
    }
    refuse_copies(scenes)?;
    scenes
        .par_iter()
        .map(|scene| {
            let fitted = refined::fit(scene, options)
                .map_err(|error| error.in_file(scene.name().to_string()))?;
            Ok(Throw { scene, fitted })
        })
        .collect()
}

/// The same poses twice would count as two throws that agree.
fn refuse_copies(scenes: &[Scene]) -> Result<()> {
    let mut known: Vec<(String, &str)> = Vec::new();
    for scene in scenes {
        let fingerprint = scene.fingerprint();
        if let Some((_, other)) = known.iter().find(|(known, _)| *known == fingerprint) {
            let problem =
                format!("{} and {} hold the same poses", quoted(other), quoted(scene.name()));
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("give each throw once: a copy would count as further evidence"));
        }
        known.push((fingerprint, scene.name()));
    }
    Ok(())
}

/// The best of the candidates, and what it makes of the throws.
pub(crate) struct Best<'a> {
    /// With it.
    pub(crate) throws: Vec<Throw<'a>>,
    /// Whether more than noise is left over.
    pub(crate) is_structured: bool,
    /// By how much less differences count because of that.
    pub(crate) inflation: f64,
}

/// Puts the most probable of the candidates that stand out, and that every throw can be flown with,
/// first; `None` where there is none.
pub(crate) fn put_best_first<'a>(
    throws: &[Throw<'a>],
    candidates: &mut [PooledCandidate],
) -> Result<Option<Best<'a>>> {
    let best = |candidates: &mut [PooledCandidate]| {
        let mut good = (0..candidates.len()).filter(|&index| candidates[index].stands_out());
        let found =
            good.find_map(|index| Some((index, with_effect(throws, &candidates[index]).ok()?)));
        let (index, with) = found?;
        candidates[..=index].rotate_right(1);
        Some(with)
    };
    let Some(with) = best(candidates) else { return Ok(None) };
    if !looks(&with)?.1 {
        return Ok(Some(Best { throws: with, is_structured: false, inflation: 1.0 }));
    }
    let inflation = mean_inflation(&with);
    candidates.sort_by(|a, b| quasi(a, inflation).total_cmp(&quasi(b, inflation)));
    let Some(throws) = best(candidates) else { return Ok(None) };
    Ok(Some(Best { is_structured: looks(&throws)?.1, throws, inflation }))
}

/// The throws with an effect more, with what all of them say of it.
fn with_effect<'a>(throws: &[Throw<'a>], effect: &PooledCandidate) -> Result<Vec<Throw<'a>>> {
    let with = |(index, throw): (usize, &Throw<'a>)| {
        let fitted = match effect.held(index) {
            Some(held) => throw.fitted.with(throw.scene, &held)?,
            None => throw.fitted.clone(),
        };
        Ok(Throw { scene: throw.scene, fitted })
    };
    throws.iter().enumerate().map(with).collect()
}

/// The throws with an effect more, each as it says itself: what it says of other quantities then is as
/// sure as it knows the effect. `None` where one can't be flown with it.
pub(crate) fn with_own<'a>(
    throws: &[Throw<'a>],
    effect: &PooledCandidate,
) -> Option<Vec<Throw<'a>>> {
    let with = |(throw, own): (&Throw<'a>, &Option<Own>)| {
        let fitted = match own {
            Some(own) => throw.fitted.with(throw.scene, &own.instance).ok()?,
            None => throw.fitted.clone(),
        };
        Some(Throw { scene: throw.scene, fitted })
    };
    throws.iter().zip(&effect.own).map(with).collect()
}

/// How much less differences count where something is left in the residuals.
fn mean_inflation(throws: &[Throw]) -> f64 {
    throws.iter().map(|throw| inflation(&throw.fitted)).sum::<f64>() / throws.len() as f64
}

/// The sum of the mean squares by which unseen positions are missed, m².
fn misses_m2(throws: &[Throw]) -> f64 {
    throws.iter().filter_map(|throw| held_out_rmse_m(&throw.fitted)).map(|rmse| rmse * rmse).sum()
}

/// The candidates of each throw.
pub(crate) fn instances(throws: &[Throw], further: &[EffectRequest]) -> Result<Vec<Vec<Instance>>> {
    throws.iter().map(|throw| all_candidates(throw.scene, &throw.fitted, further)).collect()
}

/// How the residuals of all throws look, and whether they are more than noise.
pub(crate) fn looks(throws: &[Throw]) -> Result<(Vec<ChannelTest>, bool)> {
    let mut all = Vec::new();
    let mut structured = 0;
    for throw in throws {
        let own = channels(throw.scene, &reported(throw.scene, &throw.fitted)?)?;
        structured += usize::from(Goodness::by(&throw.fitted, &own).is_structured);
        all.extend(own);
    }
    Ok((all, structured * MANY > throws.len()))
}

pub(crate) fn reduced_chi2(throws: &[Throw]) -> Option<f64> {
    let stated = throws.iter().all(|throw| throw.fitted.has_stated_noise());
    let chi2: f64 = throws.iter().map(|throw| throw.fitted.chi2()).sum();
    let spare: f64 = throws.iter().map(|throw| throw.fitted.numbers() - throw.fitted.used()).sum();
    (stated && spare > 0.0).then(|| chi2 / spare)
}

fn report(
    throws: &[Throw],
    candidates: &[PooledCandidate],
    index: usize,
    (probability, inflation): (f64, f64),
) -> Option<CandidateReport> {
    let candidate = &candidates[index];
    let (throw, own) =
        throws.iter().zip(&candidate.own).find_map(|(t, own)| Some((t, own.as_ref()?)))?;
    let instance = &own.instance;
    let alike = alike(candidates, candidate, inflation);
    let each = throws.iter().zip(&candidate.own).filter_map(|(throw, own)| {
        let own = own.as_ref()?;
        let stds = own_stds(own);
        let parameters = parameters(&own.instance, own.values.as_slice(), &stds);
        Some(ThrowEstimate { scene: throw.scene.name().to_string(), parameters })
    });
    Some(CandidateReport {
        effect: instance.effect.name.clone(),
        body: instance.body.map(|body| throw.scene.bodies()[body].name.clone()),
        delta_chi2: candidate.delta,
        parameters_added: candidate.parameters,
        p_value: candidate.p_value,
        probability,
        stands_out: candidate.stands_out(),
        heldout_rmse_before: None,
        heldout_rmse_after: None,
        reduced_chi2: None,
        parameters: match candidate.is_shared {
            true => parameters(instance, &candidate.values, &candidate.stds),
            false => BTreeMap::new(),
        },
        indistinguishable_from: alike.map(|one| one.label.clone()).collect(),
        shifts: Vec::new(),
        throws: Some(Agreement {
            p_value: candidate.agreement,
            scatter: candidate.scatter,
            each: each.collect(),
        }),
    })
}

fn quasi(candidate: &PooledCandidate, inflation: f64) -> f64 {
    quasi_bic(candidate.bic, candidate.delta, inflation)
}

/// The candidates that the throws can't tell from `candidate`, where differences count for less by
/// `inflation`.
pub(crate) fn alike<'a>(
    candidates: &'a [PooledCandidate],
    candidate: &'a PooledCandidate,
    inflation: f64,
) -> impl Iterator<Item = &'a PooledCandidate> {
    candidates.iter().filter(move |other| {
        other.label != candidate.label
            && other.stands_out() == candidate.stands_out()
            && (quasi(other, inflation) - quasi(candidate, inflation)).abs() < TELLS_APART
    })
}

fn own_stds(own: &Own) -> Vec<Option<f64>> {
    let size = own.values.len();
    let Some(inverse) = own.information.clone().try_inverse() else { return vec![None; size] };
    (0..size).map(|i| Some(inverse[(i, i)]).filter(|v| *v > 0.0).map(f64::sqrt)).collect()
}

fn parameters(
    instance: &Instance,
    values: &[f64],
    stds: &[Option<f64>],
) -> BTreeMap<String, ParameterEstimate> {
    let mut place = 0;
    let mut all = BTreeMap::new();
    for parameter in &instance.effect.parameters {
        let unit = parameter.unit.to_string();
        let estimate = match instance.fixed.get(&parameter.name) {
            Some(known) => ParameterEstimate {
                value: Some(Number::from(known.clone())),
                std: None,
                unit,
                reason: Some(GIVEN.to_string()),
            },
            None => {
                let range = place..place + parameter.null.len();
                place = range.end;
                let std: Option<Vec<f64>> = stds[range.clone()].iter().copied().collect();
                ParameterEstimate {
                    value: Some(Number::from(values[range].to_vec())),
                    reason: std.is_none().then(|| NO_DATA.to_string()),
                    std: std.map(Number::from),
                    unit,
                }
            }
        };
        all.insert(parameter.name.clone(), estimate);
    }
    all
}

fn advice(diagnosis: &Diagnosis) -> Vec<String> {
    let mut advice = Vec::new();
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::Missing, Some(best)) => {
            let alike = &best.indistinguishable_from;
            if !alike.is_empty() {
                advice.push(format!(
                    "tell it from {} by other throws: faster, slower, with and without spin",
                    listed(alike)
                ));
            }
            advice.push(format!(
                "add it to each throw: smash reconstruct SCENE --with {} -o RESULT",
                best.label()
            ));
            if diagnosis.stays_structured {
                advice.push(
                    "see what is left over in each: diagnose the throws one by one".to_string(),
                );
            }
            advice.push("look for more: smash improve SCENE SCENE …".to_string());
        }
        (Verdict::UnknownEffect, best) => {
            advice.push(
                "diagnose the throws one by one: what is wrong may not be the same in all"
                    .to_string(),
            );
            if best.is_some_and(|best| best.stands_out) {
                advice.push("look for several effects: smash improve SCENE SCENE …".to_string());
            }
        }
        _ => {}
    }
    advice
}
