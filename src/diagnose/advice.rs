//! What to film, measure or type next.

use super::Candidate;
use super::candidates::is_own;
use super::diagnosis::{Diagnosis, Verdict};
use super::rivals::OtherLaw;
use crate::Scene;
use crate::effect::{Effect, catalogue};
use crate::files::shell_word;
use crate::reconstruct::refined::{Acting, Fitted, Instance};

/// The first advice where even the best leaves far more than noise: a scene that is misread does.
pub const MISREAD: &str = "first check the order of the quaternion's components, `up`, `fps` and \
    the units: what is wrong there looks like physics";

/// The advice that goes with a diagnosis; in its commands SCENE is the scene's file. `leaves_more`: whether
/// the best that there is leaves more than noise.
pub(super) fn advice(
    scene: &Scene,
    fitted: &Fitted,
    diagnosis: &Diagnosis,
    leaves_more: bool,
) -> Vec<String> {
    let mut advice = Vec::new();
    let known = known_effects(scene, fitted);
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::Missing, Some(best)) => {
            let alike = &best.indistinguishable_from;
            if !alike.is_empty() {
                advice.extend(telling_apart(std::iter::once(&best.effect).chain(alike)));
            }
            advice.push(format!(
                "add it: smash reconstruct SCENE{known} --with {} -o result.json",
                best.label()
            ));
            advice.push(format!("look for more: smash improve SCENE{known}"));
        }
        (Verdict::UnknownEffect, _) => {
            advice.push(format!(
                "look where the model fails: smash reconstruct SCENE{known} -o result.json && smash \
                 compare SCENE result.json --svg plots"
            ));
            advice.extend(match diagnosis.other_laws.first() {
                Some(law) => law.trying(&known),
                None => vec![format!(
                    "write the law that you suspect into a file (start from one of examples/effects) and \
                     try it: smash diagnose SCENE{known} --try ./law.toml"
                )],
            });
        }
        _ => {
            if diagnosis.reduced_chi2.is_none() {
                advice.push(
                    "state the noise of the annotations in the scene (`noise`) if you know it: \
                     then weaker effects show"
                        .to_string(),
                );
            }
            advice.push(
                "weak effects show in several throws together: smash diagnose SCENE SCENE …"
                    .to_string(),
            );
        }
    }
    if let Some(otherwise) = &diagnosis.otherwise {
        // What has a name stays first.
        let place = if diagnosis.missing().is_some() { advice.len() } else { 0 };
        advice.insert(place, otherwise.mend.clone());
    }
    if leaves_more && fitted.is_far_off() {
        advice.insert(0, MISREAD.to_string());
    }
    advice.retain(|line| !line.is_empty());
    advice
}

impl OtherLaw {
    /// The commands that keep it in a file, and add it to a model with the `known` effects.
    pub fn trying(&self, known: &str) -> Vec<String> {
        let Some(effect) = &self.effect.definition else { return Vec::new() };
        let file = format!("{}.toml", effect.name);
        let body = self.effect.body.as_ref().map_or(String::new(), |body| format!("@{body}"));
        let with = format!("SCENE{known} --with ./{file}{body}");
        vec![
            format!("keep that law: printf %s {} > {file}", shell_word(&effect.to_toml())),
            format!("add it: smash reconstruct {with} -o result.json"),
            format!("look for more: smash improve {with}"),
        ]
    }
}

/// What to do about the user's own laws that have no answer.
pub(super) fn without_answer(
    scene: &Scene,
    fitted: &Fitted,
    instances: &[Instance],
    candidates: &[Candidate],
) -> Vec<String> {
    let has_answer = |instance: &&Instance| {
        let mut labels = candidates.iter().map(|candidate| candidate.instance().label(scene));
        let own = instance.label(scene);
        labels.any(|label| label == own)
    };
    let unanswered = instances.iter().filter(|one| is_own(one) && !has_answer(one));
    unanswered.map(|one| unfitted(scene, fitted, one)).collect()
}

/// What to do about a user's law that couldn't be fitted, or that nothing depends on.
fn unfitted(scene: &Scene, fitted: &Fitted, law: &Instance) -> String {
    let (known, label) = (known_effects(scene, fitted), law.label(scene));
    format!(
        "{label} couldn't be fitted, or changes nothing here; this says why: smash reconstruct \
         SCENE{known} --with {label}"
    )
}

/// What a command takes for the effects that the model has.
pub(super) fn known_effects(scene: &Scene, fitted: &Fitted) -> String {
    let label = |acting: &Acting| format!(" --with {}", acting.instance.label(scene));
    fitted.acting.iter().map(label).collect()
}

/// What tells each of these effects from others, said once; each is `NAME` or `NAME@BODY`.
pub(crate) fn telling_apart<'a>(labels: impl Iterator<Item = &'a String>) -> Vec<String> {
    let effects = labels.filter_map(|label| find(label.split('@').next()?));
    let mut told: Vec<(Vec<&str>, &str)> = Vec::new();
    for Effect { name, help, .. } in effects {
        match told.iter_mut().find(|(_, text)| *text == help.tell_apart) {
            Some((names, _)) if names.contains(&name.as_str()) => {}
            Some((names, _)) => names.push(name),
            None => told.push((vec![name], &help.tell_apart)),
        }
    }
    told.iter().map(|(names, text)| format!("{}: {text}", names.join(", "))).collect()
}

fn find(name: &str) -> Option<&'static Effect> {
    catalogue().iter().find(|effect| effect.name == name)
}
