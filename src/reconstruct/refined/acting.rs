//! Which effects act on which bodies, and their laws as the solver takes them.

use std::collections::BTreeMap;

use crate::bridge::refined::ffi::{ActingLaw, LawInstruction, ParameterRule, RefinedScene};
use crate::effect::{Effect, EffectRequest, Hook, INPUTS, Need, Parameter, Program, Scan, Scope};
use crate::reconstruct::{ActiveEffect, Number};
use crate::words::{did_you_mean, quoted};
use crate::{Error, Result, Scene};

/// An effect on one body, or on all.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Instance {
    pub(crate) effect: Effect,
    /// Which dynamic body; `None` for all.
    pub(crate) body: Option<usize>,
    /// Parameters that aren't unknown.
    pub(crate) fixed: BTreeMap<String, Vec<f64>>,
}

/// An effect of a model, with the place of its parameters.
#[derive(Debug, Clone)]
pub(crate) struct Acting {
    pub(crate) instance: Instance,
    /// In [`RefinedScene::parameters`].
    pub(crate) first: usize,
    pub(crate) count: usize,
}

impl Instance {
    /// The one that stands in a result at `place`, and its parameters, scalar by scalar.
    ///
    /// # Errors
    /// It can't be of this scene, or a value is missing.
    pub(crate) fn of_result(
        scene: &Scene,
        active: &ActiveEffect,
        place: &str,
    ) -> Result<(Instance, Vec<f64>)> {
        let mend = "name the scene that this result was made from, or reconstruct it again";
        let effect = active.effect().map_err(|error| error.at(format!("{place}.name")))?;
        if let Some(lacking) = lacking(scene, effect) {
            return Err(Error::invalid(place, format!("this scene {lacking}")).mend(mend));
        }
        let names: Vec<&str> = scene.bodies().iter().map(|body| body.name.as_str()).collect();
        let index = |name: &String| {
            let found = names.iter().position(|known| known == name);
            found.ok_or_else(|| no_body(&format!("{place}.body"), name, &names))
        };
        let body = active.body.as_ref().map(index).transpose()?;
        let mut values = Vec::new();
        for parameter in &effect.parameters {
            let found = active.parameters.get(&parameter.name).and_then(|one| one.value.as_ref());
            match found.map(Number::components) {
                Some(numbers) if numbers.len() == parameter.null.len() => values.extend(numbers),
                _ => {
                    let place = format!("{place}.parameters.{}.value", parameter.name);
                    let form = if parameter.null.len() == 3 { "three numbers" } else { "a number" };
                    return Err(Error::invalid(place, format!("isn't {form}")).mend(mend));
                }
            }
        }
        Ok((Instance { effect: effect.clone(), body, fixed: BTreeMap::new() }, values))
    }

    /// What asks for it in `scene`.
    pub(crate) fn request(&self, scene: &Scene) -> EffectRequest {
        EffectRequest {
            effect: self.effect.clone(),
            body: self.body.map(|body| scene.bodies()[body].name.clone()),
            fixed: self.fixed.clone(),
        }
    }

    /// `NAME@BODY`, or `NAME` where it acts on all.
    pub(crate) fn label(&self, scene: &Scene) -> String {
        match self.body {
            Some(body) => format!("{}@{}", self.effect.name, scene.bodies()[body].name),
            None => self.effect.name.clone(),
        }
    }

    /// Without the bounds that keep a parameter on one side of its null: estimates that are to be
    /// averaged must be free to scatter to both.
    pub(crate) fn freely(mut self) -> Instance {
        for parameter in self.effect.parameters.iter_mut().filter(|p| !p.is_factor()) {
            let [low, high] = parameter.bounds;
            for null in &parameter.null {
                let reach = (high - null).max(null - low);
                parameter.bounds[0] = parameter.bounds[0].min(null - reach);
                parameter.bounds[1] = parameter.bounds[1].max(null + reach);
            }
        }
        self
    }

    /// Whether it has an impulse at the contact.
    pub(crate) fn acts_at_the_contact(&self) -> bool {
        self.effect.laws.iter().any(|(hook, _)| *hook == Hook::ImpulsePoint)
    }

    /// Whether it is a property of the objects or of the camera, the same in every throw; not an
    /// event of one.
    pub(crate) fn is_of_all_throws(&self) -> bool {
        let has = |wanted: Hook| self.effect.laws.iter().any(|(hook, _)| *hook == wanted);
        let strikes = has(Hook::AngularImpulse) || (has(Hook::Impulse) && !has(Hook::ImpulsePoint));
        !strikes && !self.is_of_a_moment()
    }

    /// Whether it is of single poses: it may be there more than once, and chooses among them.
    pub(crate) fn is_of_a_pose(&self) -> bool {
        self.effect.parameters.iter().any(|p| p.scan == Some(Scan::ObservationTimes))
    }

    /// Whether it is of a single pose or a moment of its own: it may be there more than once.
    pub(crate) fn is_of_a_moment(&self) -> bool {
        self.is_of_a_pose() || self.effect.laws.iter().any(|(hook, _)| *hook == Hook::EventTime)
    }

    /// Whether it acts all along the flights, or is a property of the objects: not at the contact, nor at a
    /// moment.
    pub(super) fn is_in_flight(&self) -> bool {
        self.effect.scope != Scope::Contact && self.scan().is_none()
    }

    /// Whether all parameters are known, and do nothing.
    pub(crate) fn is_held_at_null(&self) -> bool {
        let held = |p: &Parameter| self.fixed.get(&p.name) == Some(&p.null);
        self.effect.parameters.iter().all(held)
    }

    /// The index of the bodies that it acts on.
    pub(crate) fn bodies(&self, scene: &RefinedScene) -> Vec<usize> {
        match self.body {
            Some(body) => vec![body],
            None => (0..scene.bodies.len()).collect(),
        }
    }

    /// The parameter that has to be scanned for a start, and its place among the scalars.
    pub(crate) fn scan(&self) -> Option<(Scan, usize)> {
        let mut place = 0;
        for parameter in &self.effect.parameters {
            match parameter.scan {
                Some(scan) if !self.fixed.contains_key(&parameter.name) => {
                    return Some((scan, place));
                }
                _ => place += parameter.null.len(),
            }
        }
        None
    }

    /// Where the parameters start: where they are known, or do nothing.
    pub(crate) fn null(&self) -> Vec<f64> {
        let parameters = self.effect.parameters.iter();
        parameters.flat_map(|p| self.fixed.get(&p.name).unwrap_or(&p.null)).copied().collect()
    }

    /// Those that aren't known.
    pub(crate) fn free_parameters(&self) -> impl Iterator<Item = &Parameter> {
        let parameters = self.effect.parameters.iter();
        parameters.filter(|parameter| !self.fixed.contains_key(&parameter.name))
    }

    /// Adds the laws to a scene.
    pub(crate) fn act_on(&self, scene: &mut RefinedScene) -> Acting {
        let first = scene.parameters.len();
        for parameter in &self.effect.parameters {
            // One pose or another: nothing between them to be optimised.
            let is_discrete = parameter.scan == Some(Scan::ObservationTimes);
            let [low, high] = parameter.bounds;
            let held = is_discrete || self.fixed.contains_key(&parameter.name);
            scene.parameters.extend(parameter.null.iter().map(|_| ParameterRule {
                low,
                high,
                held,
            }));
        }
        let count = scene.parameters.len() - first;
        let effect = scene.laws.last().map_or(0, |law| law.effect + 1);
        for body in self.bodies(scene) {
            let is_opposite = self.effect.scope == Scope::Contact && body == 1;
            for (hook, program) in &self.effect.laws {
                scene.laws.push(ActingLaw {
                    body,
                    effect,
                    sign: if is_opposite { -1.0 } else { 1.0 },
                    first_parameter: first,
                    parameter_count: count,
                    ..acting_law(*hook, program)
                });
            }
        }
        Acting { instance: self.clone(), first, count }
    }
}

/// What `request` asks for in `scene`: without a body, an effect of bodies is one of each.
///
/// # Errors
/// The scene has no such body, or can't show the effect.
pub(crate) fn instances(scene: &Scene, request: &EffectRequest) -> Result<Vec<Instance>> {
    let EffectRequest { effect, body, fixed } = request;
    if let Some(lacking) = lacking(scene, effect) {
        return Err(Error::invalid(&effect.name, format!("this scene {lacking}"))
            .mend("leave the effect out, or complete the scene"));
    }
    let instance = |body| Instance { effect: effect.clone(), body, fixed: fixed.clone() };
    let names: Vec<&str> = scene.bodies().iter().map(|body| body.name.as_str()).collect();
    match (effect.scope, body) {
        (Scope::Body, None) => Ok((0..names.len()).map(|body| instance(Some(body))).collect()),
        // What only a plane does is told of the one body that meets it.
        (Scope::Contact, None) if effect.needs.contains(&Need::Plane) => {
            Ok(vec![instance(Some(0))])
        }
        (Scope::Scene | Scope::Contact, None) => Ok(vec![instance(None)]),
        (scope, Some(name)) => {
            let Some(index) = names.iter().position(|known| known == name) else {
                return Err(no_body(&effect.name, name, &names));
            };
            match scope {
                Scope::Body => Ok(vec![instance(Some(index))]),
                Scope::Contact if effect.needs.contains(&Need::Plane) => {
                    Ok(vec![instance(Some(index))])
                }
                Scope::Contact if names.len() == 1 => Ok(vec![instance(None)]),
                _ => Err(Error::invalid(&effect.name, "acts on all bodies together")
                    .mend(format!("leave `@{name}` out"))),
            }
        }
    }
}

fn no_body(place: &str, name: &str, names: &[&str]) -> Error {
    let problem = format!("there is no dynamic body {}", quoted(name));
    Error::invalid(place, problem).mend(did_you_mean(name, names))
}

/// All instances of an effect that a scene can show: of each body, or of all.
pub(crate) fn possible(scene: &Scene, effect: &Effect) -> Vec<Instance> {
    let request = EffectRequest { effect: effect.clone(), body: None, fixed: BTreeMap::new() };
    instances(scene, &request).unwrap_or_default()
}

/// What `scene` hasn't got that `effect` needs.
fn lacking(scene: &Scene, effect: &Effect) -> Option<&'static str> {
    let has_orientation = || {
        let poses = scene.bodies().iter().flat_map(|body| &body.observations);
        poses.filter(|pose| pose.world_from_body.is_some()).count() > 0
    };
    effect.needs.iter().find_map(|need| match need {
        Need::Camera => scene.camera().is_none().then_some("states no camera"),
        Need::Plane => scene.plane().is_none().then_some("has no static body"),
        Need::TwoBodies => (scene.bodies().len() < 2).then_some("has only one dynamic body"),
        Need::Orientation => (!has_orientation()).then_some("has no orientations"),
        Need::Gravity => (scene.gravity_m_s2() == 0.0).then_some("has no gravity"),
    })
}

/// A law without its bodies and parameters.
fn acting_law(hook: Hook, program: &Program) -> ActingLaw {
    ActingLaw {
        body: 0,
        effect: 0,
        hook: hook as u8,
        sign: 1.0,
        first_parameter: 0,
        parameter_count: 0,
        registers: program.registers.max(INPUTS + 1),
        result: program.result,
        instructions: program
            .instructions
            .iter()
            .map(|step| LawInstruction {
                operation: step.operation as u8,
                target: step.target,
                left: step.left,
                right: step.right,
                value: step.value,
            })
            .collect(),
    }
}
