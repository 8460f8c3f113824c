//! Effects as a specification asks for them: which, on which bodies, and how strong.

use std::borrow::Cow;
use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effect::{Effect, EffectRequest, Parameter, Scan, find, name_of};
use crate::reconstruct::Number;
use crate::reconstruct::refined::acting::{Instance, instances};
use crate::scene::DynamicBody;
use crate::words::{did_you_mean, limit, measured, quoted};
use crate::{Error, ErrorKind, Result, Scene};

/// An effect beyond the base model, with the body that it acts on and its parameters.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EffectSpec {
    /// Its name in the catalogue, or the path of an effect file, from the working directory.
    pub name: String,
    /// The body's name. When absent, an effect of bodies acts on each dynamic one alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// All its parameters by name, in their units.
    #[serde(default)]
    pub parameters: BTreeMap<String, Number>,
}

impl EffectSpec {
    /// Reads `NAME[@BODY][:parameter=value,…]`, as [`EffectRequest::parse`] does.
    ///
    /// # Errors
    /// As [`EffectRequest::parse`].
    pub fn parse(text: &str) -> Result<EffectSpec> {
        let EffectRequest { body, fixed, .. } = EffectRequest::parse(text)?;
        let parameters = fixed.into_iter().map(|(name, value)| (name, value.into())).collect();
        Ok(EffectSpec { name: name_of(text).to_owned(), body, parameters })
    }

    /// The same with no parameter known.
    ///
    /// # Errors
    /// There is no such effect.
    pub(crate) fn unknown(&self) -> Result<EffectRequest> {
        let effect = self.effect()?;
        Ok(EffectRequest { effect, body: self.body.clone(), fixed: BTreeMap::new() })
    }

    fn effect(&self) -> Result<Effect> {
        if self.name == "-" {
            return Err(Error::new(ErrorKind::Invalid, "is standard input")
                .mend("name an effect of the catalogue, or a file"));
        }
        find(&self.name).map(Cow::into_owned)
    }

    /// What acts in `outline`, which holds the bodies and their stamps; the effect is at `place` in
    /// the specification.
    pub(super) fn instances(&self, place: &str, outline: &Scene) -> Result<Vec<Instance>> {
        let effect = self.effect().map_err(|error| match error.place() {
            // Within the effect's own file.
            Some(_) => error,
            None => error.at(format!("{place}.name")),
        })?;
        let fixed = self.values(place, &effect.name, &effect.parameters)?;
        let request = EffectRequest { effect, body: self.body.clone(), fixed };
        let instances = instances(outline, &request).map_err(|error| error.at(place))?;
        for instance in &instances {
            check_stamps(place, instance, outline)?;
        }
        Ok(instances)
    }

    fn values(
        &self,
        place: &str,
        effect: &str,
        parameters: &[Parameter],
    ) -> Result<BTreeMap<String, Vec<f64>>> {
        let place = format!("{place}.parameters");
        let names: Vec<&str> = parameters.iter().map(|known| known.name.as_str()).collect();
        if let Some(name) = self.parameters.keys().find(|name| !names.contains(&name.as_str())) {
            let problem = format!("`{effect}` has no parameter {}", quoted(name));
            return Err(Error::invalid(place, problem).mend(did_you_mean(name, &names)));
        }
        let value = |parameter: &Parameter| {
            let value = self.parameters.get(&parameter.name).ok_or_else(|| {
                Error::invalid(&place, format!("`{}` of `{effect}` is missing", parameter.name))
                    .mend(wanted(parameter))
            })?;
            let place = format!("{place}.{}", parameter.name);
            let numbers = value.components();
            if numbers.len() != parameter.null.len() {
                let problem =
                    format!("holds {} where {} belong", numbers.len(), parameter.null.len());
                return Err(Error::invalid(place, problem).mend(wanted(parameter)));
            }
            let [low, high] = parameter.bounds;
            match numbers.iter().find(|number| !(low..=high).contains(*number)) {
                Some(outside) => {
                    let problem = format!("{} is outside its bounds", limit(*outside));
                    Err(Error::invalid(place, problem).mend(wanted(parameter)))
                }
                None => Ok((parameter.name.clone(), numbers.to_vec())),
            }
        };
        parameters.iter().map(value).collect()
    }
}

/// How to write a parameter.
fn wanted(parameter: &Parameter) -> String {
    let form = if parameter.null.len() == 3 { "three numbers" } else { "a number" };
    let [low, high] = parameter.bounds.map(limit);
    let Parameter { name, unit, typical, .. } = parameter;
    let example = if typical.is_empty() { String::new() } else { format!("; {typical}") };
    let range = measured(&format!("{low} to {high}"), &unit.to_string());
    format!("write `{name}`: {form} from {range}{example}")
}

/// What concerns single poses must hit one.
fn check_stamps(place: &str, instance: &Instance, outline: &Scene) -> Result<()> {
    let effect = &instance.effect;
    let timed = effect.parameters.iter().filter(|p| p.scan == Some(Scan::ObservationTimes));
    for parameter in timed {
        let Some(&[time_s]) = instance.fixed.get(&parameter.name).map(Vec::as_slice) else {
            continue;
        };
        let bodies = outline.bodies().iter().enumerate();
        let seen: Vec<&DynamicBody> = bodies
            .filter(|(index, _)| instance.body.is_none_or(|body| body == *index))
            .map(|(_, body)| body)
            .collect();
        let stamps = seen.iter().flat_map(|body| &body.observations).map(|pose| pose.time_s);
        let off_s = |stamp_s: f64| (stamp_s - time_s).abs();
        let Some(nearest_s) = stamps.min_by(|a, b| off_s(*a).total_cmp(&off_s(*b))) else {
            continue;
        };
        // As `same` in a law has it.
        if off_s(nearest_s) > 1e-9 * nearest_s.abs().max(time_s.abs()).max(1.0) {
            let names: Vec<String> = seen.iter().map(|body| quoted(&body.name)).collect();
            let problem = format!("{time_s} s is no time at which {} is seen", names.join(" or "));
            return Err(Error::invalid(format!("{place}.parameters.{}", parameter.name), problem)
                .mend(format!("the nearest is {nearest_s} s")));
        }
    }
    Ok(())
}
