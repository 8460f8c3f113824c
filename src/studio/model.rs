//! A variant's model: its effects, in the order in which they were added, and its changed poses.

use std::sync::Arc;

use super::action::Change;
use super::edits::{Edits, Pose};
use super::law::own_effect;
use crate::effect::{Effect, EffectRequest, catalogue, name_of};
use crate::reconstruct::refined::{Instance, instances};
use crate::words::{did_you_mean, listed, quoted, rounded};
use crate::{Error, ErrorKind, Result, Scene};

/// Effects of a model: more than any scene could tell.
const MOST_EFFECTS: usize = 16;

/// What a variant is fitted with.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Model {
    pub(super) effects: Vec<Arc<Instance>>,
    pub(super) edits: Edits,
}

impl Model {
    /// The same after `change`, which is all that it depends on; `scene` is the unedited one.
    ///
    /// # Errors
    /// The change can't be made, with place and mend.
    pub(super) fn changed(&self, scene: &Scene, change: &Change) -> Result<Model> {
        let mut model = self.clone();
        let pose = |body: &String, observation: &usize| Pose {
            body: body.clone(),
            observation: *observation,
        };
        match change {
            Change::Add { effect } => model.add(scene, effect, |name| self.known(name))?,
            Change::Remove { effect } => model.remove(scene, effect)?,
            Change::Law { text, effect } => model.put_in(scene, &own_effect(text)?, effect)?,
            Change::Mark { body, observation, wrong } => {
                model.edits.mark(scene, pose(body, observation), *wrong)?;
            }
            Change::Time { body, observation, time } => {
                model.edits.move_to(scene, pose(body, observation), *time)?;
            }
            Change::PoseNoise { body, observation, scale } => {
                model.edits.scale_noise(scene, pose(body, observation), *scale)?;
            }
            Change::Noise { position, orientation } => {
                model.edits.state_noise(scene, *position, *orientation)?;
            }
        }
        if model.effects.len() > MOST_EFFECTS {
            let problem = format!("the model would have {} effects", model.effects.len());
            return Err(Error::invalid("effect", problem)
                .mend(format!("take one out: {MOST_EFFECTS} are more than any scene can tell")));
        }
        Ok(model)
    }

    /// Whether `change` takes out a law's double that isn't there: earlier versions left one where a law
    /// of another scope took its place.
    pub(super) fn lacks_double(&self, scene: &Scene, change: &Change) -> bool {
        let Change::Remove { effect } = change else { return false };
        let name = name_of(effect);
        let is_own = !catalogue().iter().any(|known| known.name == name);
        is_own && self.own(name).is_some() && !self.has(scene, effect)
    }

    /// What `changed` did, in a few words.
    pub(super) fn told(&self, scene: &Scene, change: &Change) -> String {
        match change {
            Change::Add { effect } => format!("+ {effect}"),
            Change::Remove { effect } => format!("− {effect}"),
            Change::Law { effect, .. } if self.has(scene, effect) => {
                format!("{effect} by another law")
            }
            Change::Law { effect, .. } => format!("+ {effect}, a law of your own"),
            Change::Mark { body, observation, wrong: true } => {
                format!("pose {observation} of {body} marked wrong")
            }
            Change::Mark { body, observation, wrong: false } => {
                format!("pose {observation} of {body} taken back in")
            }
            Change::Time { body, observation, time } => {
                format!("pose {observation} of {body} at {} s", rounded(*time))
            }
            Change::PoseNoise { body, observation, scale } => {
                format!("noise of pose {observation} of {body} × {}", rounded(*scale))
            }
            Change::Noise { position: Some(position), orientation } => {
                let position = three_digits(1e3 * position);
                match orientation.filter(|_| scene.has_orientations()) {
                    Some(turn) => {
                        format!("noise {position} mm, {}°", three_digits(turn.to_degrees()))
                    }
                    None => format!("noise {position} mm"),
                }
            }
            Change::Noise { .. } => "noise as in the scene".to_string(),
        }
    }

    /// The labels of its effects.
    pub(super) fn labels(&self, scene: &Scene) -> Vec<String> {
        self.effects.iter().map(|instance| instance.label(scene)).collect()
    }

    /// The effects as a fit is asked for them.
    pub(super) fn requests(&self, scene: &Scene) -> Vec<EffectRequest> {
        self.effects.iter().map(|instance| instance.request(scene)).collect()
    }

    /// The effect of this name that it has.
    pub(super) fn own(&self, name: &str) -> Option<&Effect> {
        self.effects.iter().map(|instance| &instance.effect).find(|effect| effect.name == name)
    }

    /// The effect of this name: its own, or the catalogue's. No file is ever looked for.
    fn known(&self, name: &str) -> Result<Effect> {
        let known = || catalogue().iter().find(|effect| effect.name == name);
        self.own(name).or_else(known).cloned().ok_or_else(|| {
            let names: Vec<&str> = catalogue().iter().map(|effect| effect.name.as_str()).collect();
            let problem = format!("there is no effect {}", quoted(name));
            Error::invalid("effect", problem).mend(did_you_mean(name, &names))
        })
    }

    fn has(&self, scene: &Scene, label: &str) -> bool {
        self.labels(scene).iter().any(|known| known == label)
    }

    fn add(
        &mut self,
        scene: &Scene,
        request: &str,
        find: impl Fn(&str) -> Result<Effect>,
    ) -> Result<()> {
        let request = EffectRequest::parse_among(request, find);
        let added = request.and_then(|request| instances(scene, &request)).map_err(at_effect)?;
        for instance in added {
            let label = instance.label(scene);
            if self.has(scene, &label) && !instance.is_of_a_moment() {
                return Err(Error::invalid(
                    "effect",
                    format!("{} is in the model already", quoted(&label)),
                )
                .mend("take it out first, or go to the variant before it"));
            }
            self.effects.push(Arc::new(instance));
        }
        Ok(())
    }

    /// The last one with this label.
    fn remove(&mut self, scene: &Scene, label: &str) -> Result<()> {
        let labels = self.labels(scene);
        let Some(index) = labels.iter().rposition(|known| known == label) else {
            let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
            let problem = format!("{} isn't in the model", quoted(label));
            let mend = match labels.as_slice() {
                [] => "it has no effects: it is the base model".to_string(),
                labels => format!("it has {}", listed(labels)),
            };
            return Err(Error::invalid("effect", problem).mend(mend));
        };
        self.effects.remove(index);
        Ok(())
    }

    /// Puts a user's law in the place of that of the same name, wherever it acts, and where it is asked
    /// for.
    fn put_in(&mut self, scene: &Scene, law: &Effect, request: &str) -> Result<()> {
        let find = |name: &str| match name == law.name {
            true => Ok(law.clone()),
            false => {
                Err(Error::invalid("effect", format!("{} isn't the law's name", quoted(name)))
                    .mend(format!("the text says {}", quoted(&law.name))))
            }
        };
        let request = EffectRequest::parse_among(request, find).map_err(at_effect)?;
        let asked = instances(scene, &request).map_err(at_effect)?;
        let is_law = |instance: &Arc<Instance>| instance.effect.name == law.name;
        // Of another scope, the law can't act at the old places: only where it is asked for.
        let stays = |instance: &Arc<Instance>| {
            let again = EffectRequest {
                effect: law.clone(),
                body: instance.body.map(|body| scene.bodies()[body].name.clone()),
                fixed: Default::default(),
            };
            let there = instances(scene, &again);
            there.is_ok_and(|there| matches!(&there[..], [only] if only.body == instance.body))
        };
        self.effects.retain(|instance| !is_law(instance) || stays(instance));
        let mut left = asked;
        for instance in self.effects.iter_mut().filter(|instance| is_law(instance)) {
            let is_same = |asked: &Instance| asked.body == instance.body;
            let fixed = match left.iter().position(is_same) {
                Some(index) => left.remove(index).fixed,
                None => Default::default(),
            };
            *instance = Arc::new(Instance { effect: law.clone(), body: instance.body, fixed });
        }
        self.effects.extend(left.into_iter().map(Arc::new));
        Ok(())
    }
}

/// As exact as anybody knows a noise.
fn three_digits(value: f64) -> String {
    let rounded = format!("{value:.2e}").parse().unwrap_or(value);
    rounded.to_string()
}

/// Errors of effects name their parts; what was asked for is the field `effect`.
fn at_effect(error: Error) -> Error {
    match error.kind() {
        ErrorKind::Invalid => {
            let place = match error.place() {
                Some(place) if !place.starts_with("effect") => format!("effect: {place}"),
                _ => "effect".to_string(),
            };
            error.at(place)
        }
        _ => error,
    }
}
