//! From the evidence to an answer.

use super::advice::advice;
use super::diagnosis::{CandidateReport, DIAGNOSIS_SCHEMA, Diagnosis, Shift, Verdict};
use super::ranking::{look_alikes, probabilities};
use super::unexplained::unexplained;
use super::words::explanation;
use super::{Candidate, Goodness, reported, tried};
use crate::compare::channels;
use crate::reconstruct::refined::{Fitted, Instance};
use crate::reconstruct::{Estimate, Reconstruction};
use crate::{Result, Scene};

/// Candidates that are told even if they don't stand out.
const FEWEST_TOLD: usize = 5;
/// Firsts of a pair that are tried where one effect isn't enough.
const FIRSTS: usize = 3;
/// An effect that leaves more than this share of what the model misses doesn't explain it.
const EXPLAINS: f64 = 0.5;

/// The answer for `scene`, fitted, with its candidates in order.
pub(super) fn diagnosis(
    scene: &Scene,
    fitted: &Fitted,
    instances: Vec<Instance>,
    candidates: Vec<Candidate>,
) -> Result<Diagnosis> {
    let result = reported(scene, fitted)?;
    let channels = channels(scene, &result)?;
    let goodness = Goodness::of(fitted, &channels);
    let first = candidates.iter().position(Candidate::stands_out);
    let rest = first.map(|first| rest(scene, &candidates[first])).transpose()?;
    let second = match (first, &rest) {
        // Where the noise isn't known, what is left says little of a second.
        (Some(_), Some(rest)) if rest.is_structured && fitted.has_stated_noise() => {
            second(scene, &candidates, &instances)
        }
        _ => None,
    };
    let verdict = match (first, &rest) {
        (None, _) if goodness.is_structured => Verdict::UnknownEffect,
        (None, _) => Verdict::NothingMissing,
        (Some(first), Some(rest))
            if !explains(&candidates[first], &goodness, rest) && second.is_none() =>
        {
            Verdict::UnknownEffect
        }
        _ => Verdict::Missing,
    };
    // A force that is left on top of the best says more than χ² of all poses together.
    let unexplained = match (verdict, first) {
        (Verdict::NothingMissing, _) => Vec::new(),
        (Verdict::UnknownEffect, _) | (_, None) => unexplained(scene, fitted)?,
        (Verdict::Missing, Some(first)) => unexplained(scene, &candidates[first].fitted)?,
    };
    let leaves_more = rest.is_some_and(|rest| rest.is_structured) || !unexplained.is_empty();
    let stays_structured = first.is_some() && leaves_more && second.is_none();
    let (odds, none) = probabilities(&candidates);
    // What doesn't predict better never comes first.
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by_key(|&index| !candidates[index].stands_out());
    let told = candidates.iter().filter(|c| c.stands_out()).count().max(FEWEST_TOLD);
    let reports = order
        .iter()
        .take(told)
        .map(|&index| report(scene, &result, &candidates, index, odds[index]))
        .collect::<Result<Vec<_>>>()?;
    let mut diagnosis = Diagnosis {
        schema: DIAGNOSIS_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        verdict,
        model: result.effects.clone(),
        channels,
        reduced_chi2: result.fit.reduced_chi2,
        candidates: reports,
        probability_of_nothing: none,
        stays_structured,
        unexplained,
        explanation: String::new(),
        advice: Vec::new(),
    };
    diagnosis.explanation = explanation(&diagnosis, second.as_deref(), stays_structured);
    diagnosis.advice = advice(scene, fitted, &diagnosis);
    Ok(diagnosis)
}

/// How good the fit is with a candidate.
fn rest(scene: &Scene, candidate: &Candidate) -> Result<Goodness> {
    let channels = match candidate.fitted.has_stated_noise() {
        true => Vec::new(),
        false => channels(scene, &reported(scene, &candidate.fitted)?)?,
    };
    Ok(Goodness::of(&candidate.fitted, &channels))
}

/// Whether a candidate explains most of what is missed; where the noise isn't stated, most of what
/// unseen poses are missed by.
fn explains(candidate: &Candidate, before: &Goodness, after: &Goodness) -> bool {
    match (before.excess, after.excess, candidate.held_out) {
        _ if !after.is_structured => true,
        (Some(before), Some(after), _) => after < EXPLAINS * before,
        (_, _, Some([before, after])) => {
            after.position_rmse_m.powi(2) < EXPLAINS * before.position_rmse_m.powi(2)
        }
        _ => false,
    }
}

/// The label of an effect that, with one of the best candidates, explains what that leaves.
fn second(scene: &Scene, candidates: &[Candidate], instances: &[Instance]) -> Option<String> {
    let firsts = candidates.iter().filter(|candidate| candidate.stands_out()).take(FIRSTS);
    let mut pairs: Vec<(f64, String, bool)> = Vec::new();
    for first in firsts {
        let seconds = tried(scene, &first.fitted, instances);
        let Some(second) = seconds.iter().find(|second| second.stands_out()) else { continue };
        let explains = rest(scene, second).is_ok_and(|rest| !rest.is_structured);
        let label =
            format!("{} and {}", first.instance().label(scene), second.instance().label(scene));
        pairs.push((first.bic + second.bic, label, explains));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs.into_iter().find(|(_, _, explains)| *explains).map(|(_, label, _)| label)
}

fn report(
    scene: &Scene,
    before: &Reconstruction,
    candidates: &[Candidate],
    index: usize,
    probability: f64,
) -> Result<CandidateReport> {
    let candidate = &candidates[index];
    let after = reported(scene, &candidate.fitted)?;
    let shifts = shifts(before, &after);
    let effect = after.effects.into_iter().next_back();
    let instance = candidate.instance();
    let alike = look_alikes(candidates, index).into_iter();
    Ok(CandidateReport {
        effect: instance.effect.name.clone(),
        body: instance.body.map(|body| scene.bodies()[body].name.clone()),
        delta_chi2: candidate.evidence.delta_chi2,
        parameters_added: candidate.evidence.parameters,
        p_value: candidate.evidence.p_value,
        probability,
        stands_out: candidate.stands_out(),
        heldout_rmse_before: candidate.held_out.map(|[before, _]| before.position_rmse_m),
        heldout_rmse_after: candidate.held_out.map(|[_, after]| after.position_rmse_m),
        reduced_chi2: after.fit.reduced_chi2,
        parameters: effect.map(|effect| effect.parameters).unwrap_or_default(),
        indistinguishable_from: alike
            .map(|other| candidates[other].instance().label(scene))
            .collect(),
        shifts,
        throws: None,
    })
}

/// What the mass ratio and the restitution do.
pub(crate) fn shifts(before: &Reconstruction, after: &Reconstruction) -> Vec<Shift> {
    let shift = |quantity: &str, before: Option<&Estimate>, after: Option<&Estimate>| {
        let (before, after) = (before?, after?);
        let (from, to) = (before.value?, after.value?);
        let in_sigma = before.std.filter(|std| *std > 0.0).map(|std| (to - from) / std);
        Some(Shift { quantity: quantity.to_string(), before: from, after: to, in_sigma })
    };
    [
        shift("mass_ratio", before.mass_ratio.as_ref(), after.mass_ratio.as_ref()),
        shift("restitution", Some(&before.restitution), Some(&after.restitution)),
    ]
    .into_iter()
    .flatten()
    .collect()
}
