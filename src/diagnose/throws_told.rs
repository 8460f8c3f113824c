//! What several throws say of a candidate, and what to do next.

use std::collections::BTreeMap;

use super::best_of_throws::alike;
use super::diagnosis::{Agreement, CandidateReport, Diagnosis, ThrowEstimate, Verdict};
use super::pooled::{PooledCandidate, Throw};
use super::words::listed;
use crate::reconstruct::active_effect::{GIVEN, NO_DATA};
use crate::reconstruct::refined::Instance;
use crate::reconstruct::{Number, ParameterEstimate};

/// The candidate `index`, which is as probable as `probability`.
pub(super) fn report(
    throws: &[Throw],
    candidates: &[PooledCandidate],
    index: usize,
    probability: f64,
) -> Option<CandidateReport> {
    let candidate = &candidates[index];
    let (throw, own) =
        throws.iter().zip(&candidate.own).find_map(|(t, own)| Some((t, own.as_ref()?)))?;
    let instance = &own.instance;
    let alike = alike(candidates, candidate);
    let each = throws.iter().zip(&candidate.own).filter_map(|(throw, own)| {
        let own = own.as_ref()?;
        let (values, stds) = own.estimates();
        let parameters = parameters(&own.instance, &values, &stds);
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
        parameters: candidate.parameters(),
        indistinguishable_from: alike.map(|one| one.label.clone()).collect(),
        shifts: Vec::new(),
        throws: Some(Agreement {
            p_value: candidate.agreement,
            scatter: candidate.scatter,
            is_shared: candidate.is_shared,
            each: each.collect(),
        }),
    })
}

impl PooledCandidate {
    /// Those of all throws by name; empty of what is each throw's own by its nature.
    pub(crate) fn parameters(&self) -> BTreeMap<String, ParameterEstimate> {
        match self.own.iter().flatten().next() {
            Some(own) if !self.values.is_empty() => {
                parameters(&own.instance, &self.values, &self.stds)
            }
            _ => BTreeMap::new(),
        }
    }
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

/// What to do after `diagnosis`; `known`: what a command takes for the effects that the model has.
pub(super) fn advice(diagnosis: &Diagnosis, known: &str) -> Vec<String> {
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
                "add it to each throw: smash reconstruct SCENE{known} --with {} -o RESULT",
                best.label()
            ));
            if diagnosis.stays_structured {
                advice.push(
                    "see what is left over in each: diagnose the throws one by one".to_string(),
                );
            }
            advice.push(format!("look for more: smash improve SCENE SCENE …{known}"));
        }
        (Verdict::UnknownEffect, best) => {
            advice.push(
                "diagnose the throws one by one: what is wrong may not be the same in all"
                    .to_string(),
            );
            if best.is_some_and(|best| best.stands_out) {
                advice
                    .push(format!("look for several effects: smash improve SCENE SCENE …{known}"));
            }
        }
        _ => {}
    }
    advice
}
