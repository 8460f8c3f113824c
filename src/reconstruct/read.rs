//! Results from files.

use std::ops::RangeInclusive;
use std::path::Path;

use serde_json::Value;

use super::{Estimate, RESULT_SCHEMA, Reconstruction};
use crate::files::{display_name, read_text};
use crate::json::decode;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::values::{check_range, unit_quaternion};
use crate::words::{listed, rounded};
use crate::{Error, Result, Scene};

/// Far beyond any collision, and far enough from overflow that squares stay finite.
const NUMBERS: RangeInclusive<f64> = -1e100..=1e100;
/// Whatever is divided by it stays finite, too.
const DEVIATIONS: RangeInclusive<f64> = 1e-100..=1e100;

impl Reconstruction {
    /// Reads and checks the result file `path` (`-` is standard input).
    ///
    /// Fields that this version doesn't know are passed over: a batch adds `provenance`, and a later
    /// version may add others.
    ///
    /// # Errors
    /// The file can't be read, isn't JSON, is no `smash.result/1`, or holds a value that no result
    /// has; with place, value and mend.
    pub fn read(path: impl AsRef<Path>) -> Result<Reconstruction> {
        let path = path.as_ref();
        Reconstruction::parse(&read_text(path)?, &display_name(path, "standard input"))
    }

    /// Reads and checks a result from `text`; `file_name` is only for messages.
    ///
    /// # Errors
    /// As [`Reconstruction::read`].
    pub fn parse(text: &str, file_name: &str) -> Result<Reconstruction> {
        let result: Reconstruction = decode(text, file_name, RESULT_SCHEMA)?;
        result.checked().map_err(|error| error.in_file(file_name))
    }

    /// The same with orientations of unit length, if all numbers can be reckoned with.
    fn checked(mut self) -> Result<Reconstruction> {
        let tree = serde_json::to_value(&self).expect("it was a JSON tree before");
        check_numbers("", &tree, "reconstruct the scene again")?;
        let ratio = self.mass_ratio.iter().map(|ratio| ("mass_ratio", ratio));
        let others = [("restitution", &self.restitution), ("collision_time", &self.collision_time)];
        for (place, estimate) in ratio.chain(others) {
            check_estimate(place, estimate)?;
        }
        if let Some(noise) = &self.noise {
            check_deviation("noise.position", noise.position)?;
            if let Some(orientation) = noise.orientation {
                check_deviation("noise.orientation", orientation)?;
            }
        }
        if let Some(uncertainty) = &self.uncertainty {
            let (names, stds) = (uncertainty.quantities.len(), uncertainty.std.len());
            if names != stds {
                let problem = format!("holds {stds} deviations for {names} quantities");
                return Err(Error::invalid("uncertainty.std", problem)
                    .mend("give one for each quantity, null where there is none"));
            }
            for (index, std) in uncertainty.std.iter().enumerate() {
                if let Some(std) = std {
                    check_deviation(&format!("uncertainty.std[{index}]"), *std)?;
                }
            }
        }
        for (index, body) in self.bodies.iter_mut().enumerate() {
            if let Some(wxyz) = &mut body.orientation {
                let place = format!("bodies[{index}].orientation");
                *wxyz = to_wxyz(&unit_quaternion(&place, *wxyz)?);
            }
        }
        self.own_scene()?;
        Ok(self)
    }

    /// The scene that its setting tells, without poses; `None` without a setting.
    ///
    /// # Errors
    /// The setting breaks a rule, or can't be of this result.
    pub(crate) fn own_scene(&self) -> Result<Option<Scene>> {
        let Some(setting) = &self.setting else { return Ok(None) };
        let scene = setting.scene("setting", &self.scene)?;
        let mend = "reconstruct the scene again";
        let of_result: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        let of_setting: Vec<&str> = setting.bodies.iter().map(|b| b.name.as_str()).collect();
        if of_setting != of_result {
            let problem =
                format!("are {}, but the result moves {}", listed(&of_setting), listed(&of_result));
            return Err(Error::invalid("setting.bodies", problem).mend(mend));
        }
        let seen = || setting.bodies.iter().flat_map(|body| body.seen);
        let first_s = seen().fold(f64::INFINITY, f64::min);
        let last_s = seen().fold(f64::NEG_INFINITY, f64::max);
        match self.collision_time.value {
            Some(time_s) if !(first_s..=last_s).contains(&time_s) => {
                let [time_s, first_s, last_s] = [time_s, first_s, last_s].map(rounded);
                let problem =
                    format!("is {time_s} s, but poses are from {first_s} s to {last_s} s");
                Err(Error::invalid("collision_time.value", problem).mend(mend))
            }
            _ => Ok(Some(scene)),
        }
    }
}

fn check_estimate(place: &str, estimate: &Estimate) -> Result<()> {
    match estimate.std {
        Some(std) => check_deviation(&format!("{place}.std"), std),
        None => Ok(()),
    }
}

fn check_deviation(place: &str, std: f64) -> Result<()> {
    check_range(place, std, &DEVIATIONS, "give one σ, above 0; null if it isn't known")
}

/// Checks that every number in `tree`, which stands at `place`, is of a reasonable size.
pub(crate) fn check_numbers(place: &str, tree: &Value, mend: &str) -> Result<()> {
    match tree {
        Value::Number(number) => {
            let value = number.as_f64().unwrap_or(f64::NAN);
            check_range(place, value, &NUMBERS, mend)
        }
        Value::Array(items) => {
            let mut items = items.iter().enumerate();
            items.try_for_each(|(index, item)| {
                check_numbers(&format!("{place}[{index}]"), item, mend)
            })
        }
        Value::Object(fields) => fields.iter().try_for_each(|(key, item)| {
            let dot = if place.is_empty() { "" } else { "." };
            check_numbers(&format!("{place}{dot}{key}"), item, mend)
        }),
        Value::Null | Value::Bool(_) | Value::String(_) => Ok(()),
    }
}
