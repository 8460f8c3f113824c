//! Laws that the catalogue hasn't got, held against the best that it has: a name isn't given with
//! confidence where a law of a simple form explains as much.

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::evidence::evidence;
use super::forms::{LawForm, forms};
use super::{Candidate, FALSE_ALARM};
use crate::effect::Scan;
use crate::reconstruct::refined::{Fitted, Instance, gains, possible};
use crate::{Result, Scene};

/// Forms that are refitted, the best by score.
const REFITTED: usize = 4;
/// A form whose score is less than this share of the best one's isn't refitted.
const WORTH: f64 = 0.3;

/// A law of a simple form that isn't in the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OtherLaw {
    /// The body that it acts on; null for all.
    pub body: Option<String>,
    /// What it goes with, in words.
    pub goes_with: String,
    /// As a line of an effect file's `[law]`.
    pub law: String,
    /// By how much χ² falls with it; as improbable, where the noise is estimated.
    pub delta_chi2: f64,
    /// How many independent numbers it adds.
    pub parameters_added: usize,
    /// Schwarz's criterion against the model without it; the smaller, the better.
    pub bic: f64,
}

impl OtherLaw {
    /// Whether a user's candidate is it, to the letter.
    pub(super) fn is_the_law_of(&self, tried: &Instance) -> bool {
        let mut laws = tried.effect.sources.iter();
        laws.any(|(hook, law)| format!("{hook} = \"{law}\"") == self.law)
    }

    /// Whether `candidate` is a special case of it, and does as well: then it takes no part of its
    /// probability, though it may be told.
    pub(super) fn is_needless_beside(&self, candidate: &Candidate, scene: &Scene) -> bool {
        let form = forms().iter().find(|form| form.line() == self.law);
        let held = form.and_then(|form| form.beyond).unwrap_or_default();
        let is_held = |name: &str| match name {
            // On a lone body another gravity is a constant force.
            "gravity_scale" | "gravity_tilt" if scene.bodies().len() == 1 => {
                held.contains(&"constant_force")
            }
            _ => held.contains(&name),
        };
        let instance = candidate.instance();
        let body = instance.body.map(|body| &scene.bodies()[body].name);
        let is_same_body = scene.bodies().len() == 1 || body == self.body.as_ref();
        is_same_body && is_held(&instance.effect.name) && candidate.bic <= self.bic
    }
}

/// A push that lasts, where `candidate` is an impact at a time of its own and no pose tells whether it
/// was as short as one.
pub(super) fn lasting_push(candidate: &Candidate, scene: &Scene) -> Option<OtherLaw> {
    /// Two bodies hardly touch for longer, s.
    const SHORT_S: f64 = 0.05;
    let acting = candidate.fitted.acting.last()?;
    let (Scan::GapTimes, place) = acting.instance.scan()? else { return None };
    let body = &scene.bodies()[acting.instance.body?];
    let unknowns = &candidate.fitted.best().solution.unknowns;
    let time_s = unknowns.parameters[acting.first + place];
    let after = body.observations.partition_point(|seen| seen.time_s < time_s);
    let [from_s, to_s] =
        [after.checked_sub(1)?, after].map(|index| body.observations.get(index).map(|o| o.time_s));
    let (from_s, to_s) = (from_s?, to_s?);
    (to_s - from_s > SHORT_S).then(|| OtherLaw {
        body: Some(body.name.clone()),
        goes_with: format!("time: a push that lasts, at most from {from_s:.3} s to {to_s:.3} s"),
        law: "acceleration = \"step(t - from) * step(to - t) * a\"".to_string(),
        delta_chi2: candidate.evidence.delta_chi2,
        parameters_added: candidate.evidence.parameters,
        bic: candidate.bic,
    })
}

/// The laws that explain `scene` significantly better than its model, the best first. `tried`: how
/// many candidates there are beside them.
pub(crate) fn rivals(scene: &Scene, fitted: &Fitted, tried: usize) -> Result<Vec<OtherLaw>> {
    let foreign = forms().iter().filter(|form| form.beyond.is_some());
    let all: Vec<(&LawForm, Instance)> = foreign
        .flat_map(|form| possible(scene, &form.effect).into_iter().map(move |one| (form, one)))
        .collect();
    let tests: Vec<(Instance, Vec<f64>)> =
        all.iter().map(|(_, instance)| (instance.clone(), instance.null())).collect();
    let worth = |count: usize| count as f64 * fitted.numbers().ln();
    let scores: Vec<f64> =
        gains(fitted, &tests)?.iter().map(|gain| gain.chi2 - worth(gain.directions)).collect();
    let best = scores.iter().copied().fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..all.len()).filter(|&i| scores[i] > WORTH * best).collect();
    order.sort_by(|a, b| scores[*b].total_cmp(&scores[*a]));
    order.truncate(REFITTED);
    let tried = tried + all.len();
    let refitted = |index: &usize| {
        let (form, instance) = &all[*index];
        let with = fitted.with_quickly(scene, instance).ok()?;
        let evidence = evidence(fitted, &with, 1, tried)?;
        (evidence.p_value < FALSE_ALARM).then(|| OtherLaw {
            body: instance.body.map(|body| scene.bodies()[body].name.clone()),
            goes_with: form.goes_with.to_string(),
            law: form.line(),
            delta_chi2: evidence.delta_chi2,
            parameters_added: evidence.parameters,
            bic: evidence.bic(with.numbers(), None),
        })
    };
    let mut rivals: Vec<OtherLaw> = order.par_iter().filter_map(refitted).collect();
    rivals.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    Ok(rivals)
}
