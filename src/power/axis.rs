//! The directions in which an effect can grow from its null.

use std::collections::BTreeMap;

use crate::effect::{Effect, Parameter, Scan};
use crate::reconstruct::Number;
use crate::simulate::EffectSpec;
use crate::words::{limit, measured};
use crate::{Error, Result};

/// One parameter, growing from its null; all others stay at theirs, moments where they are given.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    effect: EffectSpec,
    pub parameter: Parameter,
    /// ±1, or a unit vector.
    pub direction: Vec<f64>,
    /// How far off its null the question is asked, in the parameter's unit.
    pub size: f64,
    /// Where the first component reaches its bound.
    pub longest: f64,
}

impl Axis {
    /// The effect at `size`.
    pub fn effect(&self, size: f64) -> EffectSpec {
        let mut effect = self.effect.clone();
        effect.parameters.insert(self.parameter.name.clone(), self.value(size));
        effect
    }

    /// The parameter's value at `size`.
    pub fn value(&self, size: f64) -> Number {
        let parts = self.parameter.null.iter().zip(&self.direction);
        parts.map(|(null, part)| null + size * part).collect::<Vec<f64>>().into()
    }
}

/// The axes of `effect`, sought as `asked`: that of the parameter which `asked` gives, or else of
/// each component of each parameter. `size` in place of the given or typical one.
///
/// # Errors
/// A moment is missing, several parameters are given, or the size is none.
pub(super) fn axes(effect: &Effect, asked: &EffectSpec, size: Option<f64>) -> Result<Vec<Axis>> {
    let mut still = EffectSpec { parameters: BTreeMap::new(), ..asked.clone() };
    let mut given = Vec::new();
    for parameter in &effect.parameters {
        let value = asked.parameters.get(&parameter.name);
        if is_moment(parameter) && value.is_none() {
            return Err(missing_moment(effect, parameter, asked));
        }
        given.extend(value.filter(|_| !is_moment(parameter)).map(|value| (parameter, value)));
        let moment = value.filter(|_| is_moment(parameter)).copied();
        let null = Number::from(parameter.null.clone());
        still.parameters.insert(parameter.name.clone(), moment.unwrap_or(null));
    }
    let mut axes = match given.as_slice() {
        [] => effect
            .parameters
            .iter()
            .filter(|parameter| !is_moment(parameter))
            .flat_map(|parameter| components(parameter, &still))
            .collect(),
        [(parameter, value)] => vec![along(parameter, value, &still)?],
        _ => {
            let problem = "has several parameters given: along which does it grow?";
            return Err(Error::invalid(&effect.name, problem)
                .mend("give one of them; the others then stay at their null"));
        }
    };
    if let Some(size) = size {
        resize(effect, &mut axes, size)?;
    }
    for axis in &axes {
        if axis.size > axis.longest * (1.0 + 1e-9) {
            let Parameter { name, unit, .. } = &axis.parameter;
            let problem = format!("{} is beyond the bounds of `{name}`", limit(axis.size));
            return Err(Error::invalid(&effect.name, problem).mend(format!(
                "at most {} off its null",
                measured(&limit(axis.longest), &unit.to_string())
            )));
        }
    }
    Ok(axes)
}

/// Whether it says when something happens, not how strongly.
fn is_moment(parameter: &Parameter) -> bool {
    matches!(parameter.scan, Some(Scan::ObservationTimes | Scan::GapTimes))
}

fn missing_moment(effect: &Effect, parameter: &Parameter, asked: &EffectSpec) -> Error {
    let at = asked.body.as_ref().map_or(String::new(), |body| format!("@{body}"));
    let problem = format!("`{}` is missing: when does it happen?", parameter.name);
    Error::invalid(&effect.name, problem).mend(format!(
        "write {}{at}:{}=0.5, in {}; {}",
        asked.name, parameter.name, parameter.unit, parameter.typical
    ))
}

/// The axes of a parameter, upwards where its bounds leave the room.
fn components(parameter: &Parameter, still: &EffectSpec) -> Vec<Axis> {
    let component = |index: usize| {
        let null = parameter.null[index];
        let [low, high] = parameter.bounds;
        let sign =
            if high - null >= parameter.scale || null - low < high - null { 1.0 } else { -1.0 };
        let mut direction = vec![0.0; parameter.null.len()];
        direction[index] = sign;
        let longest = longest(parameter, &direction);
        let size = parameter.scale.min(longest);
        Axis { effect: still.clone(), parameter: parameter.clone(), direction, size, longest }
    };
    (0..parameter.null.len()).map(component).collect()
}

/// From the null to `value`.
fn along(parameter: &Parameter, value: &Number, still: &EffectSpec) -> Result<Axis> {
    let off: Vec<f64> =
        value.components().iter().zip(&parameter.null).map(|(value, null)| value - null).collect();
    let size = off.iter().map(|part| part * part).sum::<f64>().sqrt();
    if off.len() != parameter.null.len() || size.is_nan() || size <= 0.0 {
        let problem = "doesn't lead off the value at which the effect does nothing";
        return Err(Error::invalid(&parameter.name, problem)
            .mend("give a size or a direction, or leave the parameter out"));
    }
    let direction: Vec<f64> = off.iter().map(|part| part / size).collect();
    let longest = longest(parameter, &direction);
    Ok(Axis { effect: still.clone(), parameter: parameter.clone(), direction, size, longest })
}

fn longest(parameter: &Parameter, direction: &[f64]) -> f64 {
    let [low, high] = parameter.bounds;
    let room = |(null, part): (&f64, &f64)| match *part {
        0.0 => f64::INFINITY,
        part if part > 0.0 => (high - null) / part,
        part => (low - null) / part,
    };
    parameter.null.iter().zip(direction).map(room).fold(f64::INFINITY, f64::min)
}

fn resize(effect: &Effect, axes: &mut [Axis], size: f64) -> Result<()> {
    if !(size.is_finite() && size > 0.0) {
        return Err(Error::invalid("size", format!("{size} is no size"))
            .mend("give how far off its null the parameter is, above 0"));
    }
    if axes.iter().any(|axis| axis.parameter.unit != axes[0].parameter.unit) {
        let one = &axes[0].parameter;
        let problem = "has parameters of several units: one size doesn't fit all";
        let form = if one.null.len() == 3 { "[1,0,0]" } else { "1" };
        return Err(Error::invalid(&effect.name, problem)
            .mend(format!("give one parameter, such as {}={form}", one.name)));
    }
    axes.iter_mut().for_each(|axis| axis.size = size);
    Ok(())
}
