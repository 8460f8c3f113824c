//! Laws that the catalogue hasn't got, held against the best that it has: a name isn't given with
//! confidence where a law of a simple form explains as much.

use std::collections::BTreeMap;

use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::evidence::{Evidence, evidence};
use super::forms::{LawForm, forms, law_of};
use super::ranking::TELLS_APART;
use super::{Candidate, FALSE_ALARM, Leftover, of_a_body, reported};
use crate::effect::Effect;
use crate::reconstruct::ActiveEffect;
use crate::reconstruct::refined::{Fitted, Instance, gains, possible};
use crate::{Result, Scene};

/// Forms that are refitted, the best by score.
const REFITTED: usize = 4;
/// A form whose score is less than this share of the best one's isn't refitted.
const WORTH: f64 = 0.3;

/// A law of a simple form that isn't in the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OtherLaw {
    /// What it goes with, in words.
    pub goes_with: String,
    /// As lines of an effect file's `[law]`, joined by `and`.
    pub law: String,
    /// It as an effect, with its values.
    pub effect: ActiveEffect,
    /// By how much χ² falls with it; as improbable, where the noise is estimated.
    pub delta_chi2: f64,
    /// How many independent numbers it adds.
    pub parameters_added: usize,
    /// Schwarz's criterion against the model without it; the smaller, the better.
    pub bic: f64,
    /// Whether it leaves more than noise, too.
    pub leaves_more: bool,
}

/// The same, with the model that it extends.
pub(crate) struct Rival {
    pub(super) goes_with: String,
    pub(super) law: String,
    pub(crate) evidence: Evidence,
    pub(crate) bic: f64,
    pub(super) fitted: Fitted,
}

impl OtherLaw {
    /// Whether it is a push that lasts, told beside an impulse.
    pub(super) fn is_a_push(&self) -> bool {
        self.law.starts_with(&line(&PUSH[0]))
    }
}

impl Rival {
    /// `with`, which has one law more than `without`, one of `tried`.
    fn new(
        goes_with: String,
        law: String,
        (without, with): (&Fitted, Fitted),
        tried: usize,
    ) -> Option<Rival> {
        let evidence = evidence(without, &with, 1, tried)?;
        let bic = evidence.bic(with.numbers(), None);
        Some(Rival { goes_with, law, evidence, bic, fitted: with })
    }

    fn instance(&self) -> &Instance {
        &self.fitted.acting[self.fitted.acting.len() - 1].instance
    }

    /// Whether a user's candidate is it, to the letter.
    pub(crate) fn is_the_law_of(&self, tried: &Instance) -> bool {
        let mut laws = tried.effect.sources.iter();
        laws.any(|(hook, law)| format!("{hook} = \"{law}\"") == self.law)
    }

    /// Whether `candidate` is a special case of it, and does as well: then it takes no part of its
    /// probability, though it may be told.
    pub(super) fn is_needless_beside(&self, candidate: &Candidate, scene: &Scene) -> bool {
        self.holds(candidate, scene) && candidate.bic - of_a_body(candidate.instance()) <= self.bic
    }

    /// Whether `candidate` is a special case of it.
    pub(super) fn holds(&self, candidate: &Candidate, scene: &Scene) -> bool {
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
        let is_same_body = scene.bodies().len() == 1 || instance.body == self.instance().body;
        is_same_body && is_held(&instance.effect.name)
    }

    /// What it leaves over.
    pub(super) fn rest(&self, scene: &Scene) -> Result<Leftover> {
        Leftover::of(scene, &self.fitted)
    }

    /// Whether that is no more than noise.
    pub(super) fn leaves_nothing(&self, scene: &Scene) -> bool {
        self.rest(scene).is_ok_and(|rest| !rest.is_structured())
    }

    /// As it stands in a file.
    pub(crate) fn told(&self, scene: &Scene) -> Result<OtherLaw> {
        let effect = reported(scene, &self.fitted)?.effects.pop();
        Ok(OtherLaw {
            goes_with: self.goes_with.clone(),
            law: self.law.clone(),
            effect: effect.expect("its model has one effect at least"),
            delta_chi2: self.evidence.delta_chi2,
            parameters_added: self.evidence.parameters,
            bic: self.bic,
            leaves_more: self.rest(scene)?.is_structured(),
        })
    }
}

/// A push that lasts for a tenth of a second, where `candidate`, which extends `fitted`, is an impulse from
/// outside, and the poses can't tell the two apart. `tried`: how many candidates there are beside it.
pub(super) fn lasting_push(fitted: &Fitted, candidate: &Candidate, tried: usize) -> Option<Rival> {
    /// Two bodies hardly touch for half of it.
    const LASTING_S: f64 = 0.1;
    let unknowns = &candidate.fitted.best().solution.unknowns;
    let acting = candidate.fitted.acting.last()?;
    let numbers = &unknowns.parameters[acting.first..acting.first + acting.count];
    let body = acting.instance.body?;
    // When, and by how much velocity and spin jump.
    let (time_s, jump, laws) = match acting.instance.effect.name.as_str() {
        "second_impact" => (numbers[0], numbers[1..].to_vec(), PUSH.as_slice()),
        "external_impulse" => {
            let mass = if body == 0 { 1.0 } else { unknowns.log_mass_ratio.exp() };
            let velocity = numbers.iter().map(|impulse| impulse / mass).collect();
            (unknowns.collision_time_s, velocity, &PUSH[..1])
        }
        _ => return None,
    };
    let [from_s, to_s] = [time_s - 0.5 * LASTING_S, time_s + 0.5 * LASTING_S];
    let rate = 1.0 / (to_s - from_s);
    let mut instance = Instance { effect: push(laws), body: Some(body), fixed: BTreeMap::new() };
    instance.fixed.insert("from".to_string(), vec![from_s]);
    instance.fixed.insert("rate".to_string(), vec![rate]);
    let spread = jump.iter().map(|jump| jump * rate);
    let values: Vec<f64> = [from_s, rate].into_iter().chain(spread).collect();
    let with = fitted.with_from(&instance, &candidate.fitted, &values).ok()?;
    let goes_with = format!("time: a push that lasts, from {from_s:.3} s to {to_s:.3} s");
    let lines: Vec<String> = laws.iter().map(line).collect();
    let push = Rival::new(goes_with, lines.join(" and "), (fitted, with), tried + 1)?;
    (push.bic < candidate.bic + TELLS_APART).then_some(push)
}

/// A law with its hook, and its parameter with its unit.
type PushLaw = (&'static str, &'static str, (&'static str, &'static str));

/// The laws of a push that lasts, with their parameters: it rises and falls evenly, since no flight can be
/// followed over a jump.
const PUSH: [PushLaw; 2] = [
    (
        "acceleration",
        "step(t - from) * step(1 - rate * (t - from)) * (1 - cos(6.2832 * rate * (t - from))) * a",
        ("a", "m/s^2"),
    ),
    (
        "torque",
        "step(t - from) * step(1 - rate * (t - from)) * (1 - cos(6.2832 * rate * (t - from))) * b",
        ("b", "m^2/s^2"),
    ),
];

/// As in an effect file.
fn line((hook, law, _): &PushLaw) -> String {
    format!("{hook} = \"{law}\"")
}

fn push(laws: &[PushLaw]) -> Effect {
    let when = [("from", "s", 1), ("rate", "1/s", 1)].into_iter();
    let own = when.chain(laws.iter().map(|(_, _, (name, unit))| (*name, *unit, 3)));
    let own: Vec<_> =
        own.map(|(name, unit, count)| (name.to_string(), unit.to_string(), count)).collect();
    let lines: Vec<(&str, &str)> = laws.iter().map(|(hook, law, _)| (*hook, *law)).collect();
    law_of(&lines, &own)
}

/// The laws that explain `scene` significantly better than its model, the best first. `tried`: how
/// many candidates there are beside them.
pub(crate) fn rivals(scene: &Scene, fitted: &Fitted, tried: usize) -> Result<Vec<Rival>> {
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
        let rival = Rival::new(form.goes_with.to_string(), form.line(), (fitted, with), tried)?;
        (rival.evidence.p_value < FALSE_ALARM).then_some(rival)
    };
    let mut rivals: Vec<Rival> = order.par_iter().filter_map(refitted).collect();
    rivals.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    Ok(rivals)
}
