//! Effects as they stand in a result: with their values, and with all that it takes to apply them.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::Result;
use crate::effect::file::EffectFile;
use crate::effect::{Effect, known};

/// Why a parameter that isn't unknown has no deviation.
pub(crate) const GIVEN: &str = "it was given";
/// Why a parameter has none that the poses leave open.
pub(crate) const NO_DATA: &str = "the poses don't determine it";

/// An effect beyond the base model, with its parameters. The `paper` preset has none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ActiveEffect {
    /// Its name in the catalogue, or in the user's file.
    pub name: String,
    /// The body that it acts on; null for all.
    pub body: Option<String>,
    /// Its parameters by name.
    pub parameters: BTreeMap<String, ParameterEstimate>,
    /// What it is, in the form of its file; missing where it is the catalogue's effect of this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<EffectFile>")]
    pub definition: Option<Effect>,
}

impl ActiveEffect {
    /// `NAME@BODY`, or `NAME` where it acts on all.
    pub fn label(&self) -> String {
        match &self.body {
            Some(body) => format!("{}@{body}", self.name),
            None => self.name.clone(),
        }
    }

    /// The effect itself: no file is needed.
    ///
    /// # Errors
    /// It has no definition, and the catalogue has no effect of this name.
    pub fn effect(&self) -> Result<&Effect> {
        self.definition.as_ref().map_or_else(|| known(&self.name), Ok)
    }
}

/// A parameter of an effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ParameterEstimate {
    /// The estimate, of a vector its three components; null where the data don't determine it.
    pub value: Option<Number>,
    /// One standard deviation; null where it can't be computed.
    pub std: Option<Number>,
    /// Of the value.
    pub unit: String,
    /// Why `value` or `std` is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl ParameterEstimate {
    /// Whether the poses leave it open: its value is then as good as any.
    pub fn is_open(&self) -> bool {
        self.reason.as_deref() == Some(NO_DATA)
    }
}

/// A scalar, or a vector.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "is no value of a parameter; write a number, or a list of three")]
pub enum Number {
    /// One number.
    Scalar(f64),
    /// Three components, in the world or in the body as the effect says.
    Vector([f64; 3]),
}

impl Number {
    /// The components.
    pub fn components(&self) -> &[f64] {
        match self {
            Number::Scalar(value) => std::slice::from_ref(value),
            Number::Vector(values) => values,
        }
    }
}

impl From<Vec<f64>> for Number {
    fn from(values: Vec<f64>) -> Self {
        match <[f64; 3]>::try_from(values.as_slice()) {
            Ok(vector) => Number::Vector(vector),
            Err(_) => Number::Scalar(values.first().copied().unwrap_or(f64::NAN)),
        }
    }
}

/// What [`crate::reconstruct::Uncertainty`] calls the scalars of the effect's parameter.
pub(crate) fn scalar_names(effect: usize, parameter: &str, scalars: usize) -> Vec<String> {
    let name = format!("effects[{effect}].{parameter}");
    match scalars {
        1 => vec![name],
        _ => ["x", "y", "z"].map(|axis| format!("{name}.{axis}")).into(),
    }
}
