//! Effects: physics that the base model lacks, each a small text file; the catalogue's too.
//!
//! ```text
//! file ──► expressions ──► names, shapes, units ──► instructions ──► tried at the null
//! (toml)   (token, parse)   (check, unit)            (compile)       (trial)
//! ```
//!
//! An [`Effect`] that was read is good: its units fit, it does nothing at its null values, and it
//! has finite derivatives at rest.

mod calls;
mod catalogue;
mod check;
mod compile;
mod evaluate;
pub(crate) mod file;
mod functions;
mod hook;
mod law;
mod mistake;
mod names;
mod parameters;
mod parse;
mod program;
mod read;
mod request;
mod request_file;
mod rules;
mod token;
mod trial;
mod unit;

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};

pub(crate) use catalogue::known;
pub use catalogue::{catalogue, find};
pub use hook::Hook;
pub use names::INPUTS;
pub use program::{Instruction, Operation, Program};
pub use request::EffectRequest;
pub(crate) use request::name_of;
pub(crate) use request_file::RequestFile;
pub use unit::{Dimension, Unit};

/// A law with its parameters, and what people should know of it.
///
/// As JSON it has the form of its file, and can be read from it.
#[derive(Debug, Clone, Serialize)]
pub struct Effect {
    /// One word.
    pub name: String,
    /// What it is, in a few words.
    pub title: String,
    /// What has parameters of its own.
    pub scope: Scope,
    /// What a scene must have to show it; also what the names in its laws need.
    pub needs: Vec<Need>,
    /// In the order of their registers.
    #[serde(serialize_with = "by_name")]
    pub parameters: Vec<Parameter>,
    /// The laws, compiled, in the order of the hooks' numbers.
    #[serde(skip)]
    pub laws: Vec<(Hook, Program)>,
    /// The laws as they were written.
    #[serde(rename = "law")]
    pub sources: BTreeMap<Hook, String>,
    /// For people.
    #[serde(skip_serializing_if = "Help::is_empty")]
    pub help: Help,
    /// The file that it was read from, as it was named; `None` for the catalogue's.
    #[serde(skip)]
    pub file: Option<String>,
}

/// Wherever they were read from.
impl PartialEq for Effect {
    fn eq(&self, other: &Effect) -> bool {
        let Effect { name, title, scope, needs, parameters, laws, sources, help, file: _ } = self;
        (name, title, scope, needs) == (&other.name, &other.title, &other.scope, &other.needs)
            && (parameters, laws) == (&other.parameters, &other.laws)
            && (sources, help) == (&other.sources, &other.help)
    }
}

impl Effect {
    /// The text of its file: TOML.
    pub fn to_toml(&self) -> String {
        toml::to_string(self).expect("plain numbers and strings have a form in TOML")
    }
}

/// An unknown number of a law, or an unknown vector.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Parameter {
    /// One word, that laws use.
    #[serde(skip)]
    pub name: String,
    /// Of the value, its bounds and its scale.
    pub unit: Unit,
    /// At this value the effect does nothing: 1 number, or the 3 of a vector.
    #[serde(serialize_with = "scalar_or_vector")]
    pub null: Vec<f64>,
    /// The least and the greatest value, of each component.
    pub bounds: [f64; 2],
    /// A typical difference from the null, for steps, scans and simulated strengths; above 0.
    pub scale: f64,
    /// The frame of a vector.
    #[serde(skip_serializing_if = "Frame::is_world")]
    pub frame: Frame,
    /// Real sizes, in words.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub typical: String,
    /// Start values to be tried, where the law doesn't depend on this at the null.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scan: Option<Scan>,
}

impl Parameter {
    /// Whether it multiplies something: then twice and half of the null are as far from it.
    pub(crate) fn is_factor(&self) -> bool {
        self.bounds[0] > 0.0
    }
}

/// What has parameters of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scope {
    /// Each body.
    #[default]
    Body,
    /// The scene: one set of parameters for all bodies.
    Scene,
    /// The contact: the law acts on body a, and opposite on b.
    Contact,
}

/// What a scene must have to show an effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Need {
    /// The camera's position.
    Camera,
    /// A static plane.
    Plane,
    /// Two dynamic bodies.
    TwoBodies,
    /// Annotated orientations.
    Orientation,
    /// Gravity that isn't zero.
    Gravity,
}

/// The frame of a vector.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Frame {
    /// Fixed in the world.
    #[default]
    World,
    /// Fixed in the body.
    Body,
}

/// Where start values of a parameter come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scan {
    /// The body's stamps.
    #[serde(rename = "observations")]
    ObservationTimes,
    /// The middles of the gaps between its stamps.
    #[serde(rename = "gaps")]
    GapTimes,
    /// Whole frames, forwards and back.
    Frames,
}

/// What people should know of an effect.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Help {
    /// How it shows in poses and residuals.
    #[serde(default)]
    pub looks_like: String,
    /// Names of effects that can look the same.
    #[serde(default)]
    pub confused_with: Vec<String>,
    /// How to tell it from those.
    #[serde(default)]
    pub tell_apart: String,
    /// Where the law is from.
    #[serde(default)]
    pub source: String,
}

impl Help {
    fn is_empty(&self) -> bool {
        *self == Help::default()
    }
}

impl Need {
    /// What a scene must have.
    pub fn in_words(self) -> &'static str {
        match self {
            Need::Camera => "the camera's position",
            Need::Plane => "a static plane",
            Need::TwoBodies => "two dynamic bodies",
            Need::Orientation => "annotated orientations",
            Need::Gravity => "gravity",
        }
    }
}

impl Frame {
    fn is_world(&self) -> bool {
        *self == Frame::World
    }
}

fn by_name<S: Serializer>(parameters: &[Parameter], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(parameters.iter().map(|parameter| (&parameter.name, parameter)))
}

fn scalar_or_vector<S: Serializer>(null: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
    match null {
        [single] => serializer.serialize_f64(*single),
        list => serializer.collect_seq(list),
    }
}
