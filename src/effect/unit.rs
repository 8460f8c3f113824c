//! Units: products of powers of metre, second and kilogram.

use std::fmt;

use serde::{Serialize, Serializer};

use super::mistake::Mistake;
use super::parse::{Binary, Expression, Kind, parse};
use crate::words::{did_you_mean, quoted, rounded};

/// Exponents are counted in twelfths: halves, thirds and quarters stay exact.
const PART: i32 = 12;

/// No law of physics needs a higher power.
const HIGHEST_POWER: i32 = 20;

/// The powers of metre, second and kilogram that a quantity has. A radian is a pure number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Dimension {
    metre: i32,
    second: i32,
    kilogram: i32,
}

/// A unit as a file states it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unit {
    text: String,
    dimension: Dimension,
}

impl Dimension {
    /// Of a pure number.
    pub const NONE: Dimension = Dimension::of(0, 0, 0);

    /// The product of whole powers of metre, second and kilogram.
    pub const fn of(metre: i32, second: i32, kilogram: i32) -> Dimension {
        Dimension { metre: metre * PART, second: second * PART, kilogram: kilogram * PART }
    }

    /// The powers of metre, second and kilogram.
    pub fn powers(self) -> [f64; 3] {
        [self.metre, self.second, self.kilogram].map(|part| f64::from(part) / f64::from(PART))
    }

    pub(super) fn times(self, other: Dimension) -> Dimension {
        Dimension {
            metre: self.metre + other.metre,
            second: self.second + other.second,
            kilogram: self.kilogram + other.kilogram,
        }
    }

    pub(super) fn over(self, other: Dimension) -> Dimension {
        Dimension {
            metre: self.metre - other.metre,
            second: self.second - other.second,
            kilogram: self.kilogram - other.kilogram,
        }
    }

    /// `None` where the power isn't a sensible one.
    pub(super) fn to_the(self, exponent: f64) -> Option<Dimension> {
        let part = |own: i32| {
            let raised = f64::from(own) * exponent;
            let is_sensible =
                raised.fract() == 0.0 && raised.abs() <= (HIGHEST_POWER * PART).into();
            // In range, so the conversion is exact.
            is_sensible.then_some(raised as i32)
        };
        Some(Dimension {
            metre: part(self.metre)?,
            second: part(self.second)?,
            kilogram: part(self.kilogram)?,
        })
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let parts = [("kg", self.kilogram), ("m", self.metre), ("s", self.second)];
        let power = |(name, part): (&str, i32)| match part.abs() {
            PART => name.to_owned(),
            other => format!("{name}^{}", rounded(f64::from(other) / f64::from(PART))),
        };
        let above: Vec<_> = parts.into_iter().filter(|p| p.1 > 0).map(power).collect();
        let below: Vec<_> = parts.into_iter().filter(|p| p.1 < 0).map(power).collect();
        out.write_str(if above.is_empty() { "1" } else { "" })?;
        out.write_str(&above.join("*"))?;
        below.iter().try_for_each(|part| write!(out, "/{part}"))
    }
}

impl Unit {
    /// Reads a unit such as `1/m`, `m/s^2` or `kg*m^2/s`; also `rad`, `N`, `J` and `Hz`.
    pub(super) fn parse(text: &str) -> Result<Unit, Mistake> {
        if text.trim().is_empty() {
            return Err(Mistake::new(0..0, "is empty", "write `1` for a pure number"));
        }
        let dimension = dimension(&parse(text)?)?;
        Ok(Unit { text: text.trim().to_owned(), dimension })
    }

    /// What it is made of.
    pub fn dimension(&self) -> Dimension {
        self.dimension
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.text)
    }
}

impl Serialize for Unit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

const UNITS: [(&str, Dimension); 7] = [
    ("m", Dimension::of(1, 0, 0)),
    ("s", Dimension::of(0, 1, 0)),
    ("kg", Dimension::of(0, 0, 1)),
    ("rad", Dimension::NONE),
    ("N", Dimension::of(1, -2, 1)),
    ("J", Dimension::of(2, -2, 1)),
    ("Hz", Dimension::of(0, -1, 0)),
];

fn dimension(expression: &Expression<'_>) -> Result<Dimension, Mistake> {
    let span = expression.span.clone();
    let no_unit = || Mistake::new(span.clone(), "is no unit", "write it like m/s^2, kg*m or 1");
    match &expression.kind {
        Kind::Number(1.0) => Ok(Dimension::NONE),
        Kind::Name(name) => {
            UNITS.iter().find(|(known, _)| known == name).map(|unit| unit.1).ok_or_else(|| {
                Mistake::new(span.clone(), format!("{} is no unit", quoted(name)), other_unit(name))
            })
        }
        Kind::Binary(binary, parts) => {
            let [left, right] = &**parts;
            match binary {
                Binary::Multiply => bounded(dimension(left)?.times(dimension(right)?)),
                Binary::Divide => bounded(dimension(left)?.over(dimension(right)?)),
                Binary::Power => {
                    exponent(right).and_then(|power| dimension(left).ok()?.to_the(power))
                }
                Binary::Add | Binary::Subtract => None,
            }
            .ok_or_else(no_unit)
        }
        _ => Err(no_unit()),
    }
}

fn bounded(dimension: Dimension) -> Option<Dimension> {
    dimension.to_the(1.0)
}

fn exponent(expression: &Expression<'_>) -> Option<f64> {
    match &expression.kind {
        Kind::Number(value) => Some(*value),
        Kind::Negative(of) => exponent(of).map(|value| -value),
        Kind::Binary(Binary::Divide, parts) => Some(exponent(&parts[0])? / exponent(&parts[1])?),
        _ => None,
    }
}

fn other_unit(name: &str) -> String {
    match name {
        "mm" | "cm" | "km" | "in" | "ft" => "lengths are in `m`".into(),
        "ms" | "min" | "h" | "frame" | "frames" => "times are in `s`".into(),
        "g" | "t" | "lb" => "masses are in `kg`".into(),
        "deg" | "degree" | "degrees" => "angles are in `rad`".into(),
        _ => did_you_mean(name, &UNITS.map(|(known, _)| known)),
    }
}
