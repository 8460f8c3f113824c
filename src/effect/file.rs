//! An effect as it stands in its file: plain data, checked elsewhere.

use std::fmt;

use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::{Frame, Help, Hook, Need, Scan, Scope};

/// An effect: what the base model of a collision lacks, and by which law. The file is TOML; SI
/// units.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "smash effect")]
pub(crate) struct EffectFile {
    /// One word: letters, digits and `_`.
    #[schemars(regex(pattern = r"^[A-Za-z][A-Za-z0-9_]{0,39}$"))]
    pub name: String,
    /// What it is, in a few words.
    #[serde(default)]
    pub title: String,
    /// What has parameters of its own: each body, the scene as a whole, or the contact.
    #[serde(default)]
    pub scope: Scope,
    /// What a scene must have to show the effect.
    #[serde(default)]
    pub needs: Vec<Need>,
    /// The unknown numbers of the law, by name; at least one.
    #[schemars(extend("minProperties" = 1))]
    pub parameters: IndexMap<String, ParameterFile>,
    /// What the effect does.
    #[schemars(extend("minProperties" = 1))]
    pub law: LawFile,
    /// For people.
    #[serde(default)]
    pub help: Help,
}

/// An unknown number of a law, or an unknown vector.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ParameterFile {
    /// A product of powers of m, s, kg and rad, such as `m/s^2`; also N, J, Hz; `1` for none.
    pub unit: String,
    /// The value at which the effect does nothing. A list of three makes the parameter a vector.
    pub null: Null,
    /// The least and the greatest value, also of each component of a vector; without them, a
    /// million to both sides.
    #[serde(default)]
    pub bounds: Option<[f64; 2]>,
    /// A typical difference from the null, for steps and scans; without it, a hundredth of the way
    /// to the nearer bound.
    #[serde(default)]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub scale: Option<f64>,
    /// The frame of a vector.
    #[serde(default)]
    pub frame: Frame,
    /// Real sizes, in words.
    #[serde(default)]
    pub typical: String,
    /// Start values to be tried, where the law doesn't depend on the parameter at the null.
    #[serde(default)]
    pub scan: Option<Scan>,
}

/// The laws, each an expression. Vectors are in the world unless it is said otherwise.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LawFile {
    /// Acceleration, added to gravity: vector, m/s^2.
    #[serde(default)]
    pub acceleration: Option<String>,
    /// Rate of the angular momentum per unit of the body's mass: vector, m^2/s^2.
    #[serde(default)]
    pub torque: Option<String>,
    /// Factors on the solid's principal moments: vector, 1, in the body.
    #[serde(default)]
    pub inertia: Option<String>,
    /// The time at which the model is compared with the stamp t: scalar, s.
    #[serde(default)]
    pub time: Option<String>,
    /// Where the annotated centre is seen, if p is the centre of mass: vector, m.
    #[serde(default)]
    pub position: Option<String>,
    /// Rotation vector by which the annotation is turned off: vector, rad, in the body.
    #[serde(default)]
    pub orientation: Option<String>,
    /// Further impulse at the collision, per unit mass of body a: vector, m/s.
    #[serde(default)]
    pub impulse: Option<String>,
    /// Where `impulse` acts; the centre of mass unless given: vector, m.
    #[serde(default)]
    pub impulse_point: Option<String>,
    /// Further angular impulse at the collision, per unit mass of body a: vector, m^2/s.
    #[serde(default)]
    pub angular_impulse: Option<String>,
    /// When a further event happens: scalar, s.
    #[serde(default)]
    pub event_time: Option<String>,
    /// Change of the velocity at the event: vector, m/s.
    #[serde(default)]
    pub event_impulse: Option<String>,
    /// Change of the angular momentum per unit of the body's mass at the event: vector, m^2/s.
    #[serde(default)]
    pub event_angular_impulse: Option<String>,
}

impl LawFile {
    /// The laws that the file states, in the order of the hooks' numbers.
    pub(crate) fn stated(self) -> Vec<(Hook, String)> {
        let texts = [
            self.acceleration,
            self.torque,
            self.inertia,
            self.time,
            self.position,
            self.orientation,
            self.impulse,
            self.impulse_point,
            self.angular_impulse,
            self.event_time,
            self.event_impulse,
            self.event_angular_impulse,
        ];
        let pairs = Hook::ALL.into_iter().zip(texts);
        pairs.filter_map(|(hook, text)| text.map(|text| (hook, text))).collect()
    }
}

/// One number, or three.
#[derive(Debug, JsonSchema)]
#[serde(untagged)]
pub(crate) enum Null {
    Scalar(f64),
    Vector([f64; 3]),
}

impl<'de> Deserialize<'de> for Null {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NullVisitor)
    }
}

struct NullVisitor;

impl<'de> Visitor<'de> for NullVisitor {
    type Value = Null;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a number or a list of three")
    }

    fn visit_f64<E>(self, value: f64) -> Result<Null, E> {
        Ok(Null::Scalar(value))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Null, E> {
        Ok(Null::Scalar(value as f64))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Null, E> {
        Ok(Null::Scalar(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Null, A::Error> {
        let mut items = [0.0; 3];
        for (index, item) in items.iter_mut().enumerate() {
            let missing = || serde::de::Error::invalid_length(index, &self);
            *item = list.next_element()?.ok_or_else(missing)?;
        }
        Ok(Null::Vector(items))
    }
}
