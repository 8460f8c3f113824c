//! An effect as a command line asks for it.

use std::borrow::Cow;
use std::collections::BTreeMap;

use std::fmt;

use serde::{Deserialize, Serialize};

use super::catalogue::check_is_told_apart;
use super::request_file::RequestFile;
use super::{Effect, Parameter, find};
use crate::words::{did_you_mean, limit, measured, quoted};
use crate::{Error, ErrorKind, Result};

/// An effect, perhaps on one body alone, perhaps with parameters that are known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(into = "RequestFile", try_from = "RequestFile")]
pub struct EffectRequest {
    /// What is asked for.
    pub effect: Effect,
    /// The body's name; `None` is every dynamic body.
    pub body: Option<String>,
    /// The parameters that aren't unknown, in their units: 1 or 3 numbers.
    pub fixed: BTreeMap<String, Vec<f64>>,
}

/// As [`EffectRequest::parse`] reads it: `NAME[@BODY][:parameter=value,…]`, of a user's own effect
/// with the path of its file, if it was read from one.
impl fmt::Display for EffectRequest {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.effect.file.as_deref().unwrap_or(&self.effect.name))?;
        if let Some(body) = &self.body {
            write!(out, "@{body}")?;
        }
        for (index, (name, numbers)) in self.fixed.iter().enumerate() {
            out.write_str(if index == 0 { ":" } else { "," })?;
            match numbers.as_slice() {
                [number] => write!(out, "{name}={}", limit(*number))?,
                all => {
                    let all: Vec<String> = all.iter().map(|number| limit(*number)).collect();
                    write!(out, "{name}=[{}]", all.join(","))?;
                }
            }
        }
        Ok(())
    }
}

impl EffectRequest {
    /// Reads `NAME[@BODY][:parameter=value,…]`, such as `quadratic_drag@a:k=0.15` or
    /// `./wind.toml:air=[1,0,0.5]`. A path ends with `.toml`.
    ///
    /// # Errors
    /// There is no such effect or parameter, or a value isn't within its bounds.
    pub fn parse(text: &str) -> Result<EffectRequest> {
        EffectRequest::parse_among(text, |name| find(name).map(Cow::into_owned))
    }

    /// The same, with the effects that `find` knows by their names.
    ///
    /// # Errors
    /// `find` knows none, or as [`EffectRequest::parse`].
    pub(crate) fn parse_among(
        text: &str,
        find: impl Fn(&str) -> Result<Effect>,
    ) -> Result<EffectRequest> {
        let (name, rest) = text.split_at(end_of_name(text));
        let (body, values) = match rest.split_once(':') {
            Some((body, values)) => (body, Some(values)),
            None => (rest, None),
        };
        let body = body.strip_prefix('@');
        let in_request = |problem: &str, mend: &str| {
            Error::new(ErrorKind::Invalid, format!("{}: {problem}", quoted(text))).mend(mend)
        };
        if name.is_empty() {
            return Err(in_request("the effect's name is missing", "write NAME[@BODY][:k=0.1]"));
        }
        if body == Some("") {
            return Err(in_request("the body's name is missing", "write it after `@`"));
        }
        let effect = find(name)?;
        check_is_told_apart(&effect)?;
        let mut fixed = BTreeMap::new();
        for setting in values.map(settings).unwrap_or_default() {
            let Some((name, value)) = setting.split_once('=') else {
                let problem = format!("{} sets nothing", quoted(setting));
                return Err(in_request(&problem, "write parameter=value, such as k=0.1"));
            };
            let (name, value) = known_value(&effect, name.trim(), value.trim())?;
            if fixed.insert(name.clone(), value).is_some() {
                return Err(in_request(&format!("`{name}` is set twice"), "keep one of the two"));
            }
        }
        Ok(EffectRequest { effect, body: body.map(str::to_owned), fixed })
    }
}

/// The name or path in `NAME[@BODY][:parameter=value,…]`.
pub(crate) fn name_of(text: &str) -> &str {
    &text[..end_of_name(text)]
}

/// A path may hold `@` and `:` itself.
fn end_of_name(text: &str) -> usize {
    let after_path = text.match_indices(".toml").map(|(at, found)| at + found.len());
    let mut ends =
        after_path.filter(|&end| text[end..].is_empty() || text[end..].starts_with(['@', ':']));
    ends.next().or_else(|| text.find(['@', ':'])).unwrap_or(text.len())
}

/// The settings between the commas that stand outside of brackets.
fn settings(text: &str) -> Vec<&str> {
    let mut depth = 0;
    let outside = |character: char| {
        depth += i32::from(character == '[') - i32::from(character == ']');
        character == ',' && depth == 0
    };
    text.split(outside).collect()
}

/// A parameter's name, and its value as 1 or 3 numbers.
fn known_value(effect: &Effect, name: &str, value: &str) -> Result<(String, Vec<f64>)> {
    let parameter = parameter(effect, name)?;
    let numbers = numbers(value, parameter).ok_or_else(|| no_value(effect, parameter, value))?;
    check_value(effect, parameter, &numbers)?;
    Ok((name.to_owned(), numbers))
}

pub(super) fn parameter<'a>(effect: &'a Effect, name: &str) -> Result<&'a Parameter> {
    effect.parameters.iter().find(|known| known.name == name).ok_or_else(|| {
        let names: Vec<&str> = effect.parameters.iter().map(|known| known.name.as_str()).collect();
        let problem = format!("`{}` has no parameter {}", effect.name, quoted(name));
        Error::new(ErrorKind::Invalid, problem).mend(did_you_mean(name, &names))
    })
}

pub(super) fn check_value(effect: &Effect, parameter: &Parameter, numbers: &[f64]) -> Result<()> {
    if numbers.len() != parameter.null.len() {
        return Err(no_value(effect, parameter, &format!("{numbers:?}")));
    }
    let [low, high] = parameter.bounds;
    match numbers.iter().find(|number| !(low..=high).contains(*number)) {
        Some(outside) => {
            let problem = format!("{} is outside its bounds", limit(*outside));
            let range = format!("{} to {}", limit(low), limit(high));
            let mend = measured(&range, &parameter.unit.to_string());
            let place = format!("{}:{}", effect.name, parameter.name);
            Err(Error::invalid(place, problem).mend(mend))
        }
        None => Ok(()),
    }
}

fn no_value(effect: &Effect, parameter: &Parameter, value: &str) -> Error {
    let form = if parameter.null.len() == 3 { "[x,y,z] without spaces" } else { "one number" };
    let place = format!("{}:{}", effect.name, parameter.name);
    Error::invalid(place, format!("{} is no value of it", quoted(value)))
        .mend(format!("write {form}, in {}", parameter.unit))
}

fn numbers(text: &str, parameter: &Parameter) -> Option<Vec<f64>> {
    let parts: Vec<&str> = match parameter.null.len() {
        1 => vec![text],
        _ => text.strip_prefix('[')?.strip_suffix(']')?.split(',').collect(),
    };
    let numbers: Option<Vec<f64>> = parts.iter().map(|part| part.trim().parse().ok()).collect();
    numbers.filter(|numbers| numbers.len() == parameter.null.len())
}
