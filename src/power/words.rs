//! The answer in plain words.

use super::report::{AxisPower, Bias, Power};
use crate::effect::Effect;
use crate::reconstruct::Number;
use crate::words::{measured, significant};

/// A larger bias is worth a word.
const NOTABLE_SIGMA: f64 = 1.0;

/// What `power` says, a sentence a line.
pub(super) fn explanation(power: &Power, effect: &Effect) -> String {
    let label = power.label();
    let mut lines: Vec<String> = power.axes.iter().map(|axis| least(&label, axis)).collect();
    let known = |axis: &&AxisPower| effect.parameters.iter().find(|p| p.name == axis.parameter);
    let mut typical: Vec<String> = power
        .axes
        .iter()
        .filter_map(|axis| known(&axis))
        .filter(|parameter| !parameter.typical.is_empty())
        .map(|parameter| format!("Real sizes of {}: {}.", parameter.name, parameter.typical))
        .collect();
    typical.dedup();
    lines.extend(typical);
    lines.extend(power.axes.iter().filter_map(biased));
    lines.extend(power.axes.iter().filter_map(confused));
    lines.join("\n")
}

fn least(label: &str, axis: &AxisPower) -> String {
    let at_size = format!("At {} it is found {}.", axis.in_words(axis.size), often(axis.power));
    match (axis.least_size_90, axis.least_size_50) {
        (Some(ninety), Some(fifty)) => format!(
            "{label} must be at least {} to be found in 9 of 10 such films, and {} in every \
             second. {at_size}",
            axis.in_words(ninety),
            axis.in_words(fifty)
        ),
        (None, Some(fifty)) => format!(
            "{label} is found in every second such film at {}, in 9 of 10 at no size within its \
             bounds. {at_size}",
            axis.in_words(fifty)
        ),
        (_, None) => format!(
            "{label} can't be found in such films by {}, whatever its size within its bounds. \
             {at_size}",
            axis.parameter
        ),
    }
}

fn biased(axis: &AxisPower) -> Option<String> {
    let is_notable = |bias: &&Bias| bias.in_sigma.is_some_and(|s| s.abs() > NOTABLE_SIGMA);
    let moved: Vec<String> = axis
        .bias
        .iter()
        .filter(is_notable)
        .map(|bias| {
            format!(
                "the {} from {} to {} ({} of its σ)",
                bias.quantity.replace('_', " "),
                significant(bias.truth, 4),
                significant(bias.found, 4),
                significant(bias.in_sigma.unwrap_or_default().abs(), 2)
            )
        })
        .collect();
    (!moved.is_empty()).then(|| {
        format!("Overlooked at {}, it moves {}.", axis.in_words(axis.size), moved.join(" and "))
    })
}

fn confused(axis: &AxisPower) -> Option<String> {
    let alike = axis.alike.as_ref().filter(|alike| !alike.effects.is_empty())?;
    Some(format!(
        "At {} such films can't tell it from {}.",
        axis.in_words(alike.size),
        alike.effects.join(", ")
    ))
}

impl AxisPower {
    /// The parameter at `size`, for people: `k = 0.012 1/m`.
    pub fn in_words(&self, size: f64) -> String {
        // Off a null that isn't 0 the digits of the difference count.
        let digits = |null: f64| match null == 0.0 {
            true => 2,
            false => 2 + (null.abs() / size).log10().ceil().clamp(0.0, 8.0) as usize,
        };
        let parts: Vec<String> = self
            .value(size)
            .components()
            .iter()
            .zip(self.null.components())
            .map(|(value, null)| significant(*value, digits(*null)))
            .collect();
        let value = match self.null {
            Number::Scalar(_) => parts.concat(),
            Number::Vector(_) => format!("[{}]", parts.join(", ")),
        };
        format!("{} = {}", self.parameter, measured(&value, &self.unit))
    }
}

fn often(power: f64) -> String {
    match 100.0 * power {
        percent if percent >= 99.5 => "practically always".to_string(),
        percent if percent < 0.5 => "practically never".to_string(),
        percent => format!("in {percent:.0} of 100"),
    }
}
