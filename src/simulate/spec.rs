//! The specification as it stands in a file, `smash.simulation/1`: plain data, checked elsewhere.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{EffectSpec, NoiseSpec, Sampling};
use crate::scene::file::{default_gravity, default_up};
use crate::scene::{Camera, Shape};

/// The value of a specification's field `schema`.
pub const SIMULATION_SCHEMA: &str = "smash.simulation/1";

/// Two bodies, how they move when they touch, and when and how exactly they are seen. SI units.
///
/// Names and conventions are those of the scene, `smash.scene/1`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "smash.simulation/1")]
pub struct SimulationSpec {
    /// Always `smash.simulation/1`.
    #[schemars(extend("const" = SIMULATION_SCHEMA))]
    pub schema: String,
    /// The scene's name; free text.
    #[serde(default)]
    pub name: String,
    /// Frames per second; required unless all observations are given by `times`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub fps: Option<f64>,
    /// Unit vector against gravity, in the world.
    #[serde(default = "default_up")]
    pub up: [f64; 3],
    /// Gravity in m/s².
    #[serde(default = "default_gravity")]
    #[schemars(range(min = 0))]
    pub gravity: f64,
    /// Mass of b over mass of a; required for two dynamic bodies, absent with a static one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub mass_ratio: Option<f64>,
    /// Two dynamic bodies, or a dynamic and a static one; the first dynamic one is `a`, mass 1.
    #[schemars(length(min = 2, max = 2))]
    pub bodies: Vec<BodySpec>,
    /// Where, when and how the bodies collide.
    pub collision: CollisionSpec,
    /// Physics beyond the base model, and wrong annotations; none when absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub effects: Vec<EffectSpec>,
    /// The camera, which some effects need; the scene then states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// When the bodies are seen; a body may have an `observations` of its own.
    pub observations: Sampling,
    /// The noise added to what is seen.
    #[serde(default)]
    pub noise: NoiseSpec,
    /// Start of the noise's random numbers: the same seed gives the same scene.
    #[serde(default)]
    pub seed: u64,
}

/// A body: dynamic (`shape`, and its state at the collision, just before the impulse), or a static
/// plane (`static`, `normal` and `height`).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    {"required": ["shape", "position", "velocity"], "not": {"anyOf": [
        {"properties": {"static": {"const": true}}, "required": ["static"]},
        {"required": ["normal"]}, {"required": ["height"]}]}},
    {"required": ["static", "normal", "height"], "properties": {"static": {"const": true}},
     "not": {"anyOf": [{"required": ["shape"]}, {"required": ["position"]},
        {"required": ["orientation"]}, {"required": ["velocity"]},
        {"required": ["angular_velocity"]}, {"required": ["measure_orientation"]},
        {"required": ["observations"]}]}}
]))]
pub struct BodySpec {
    /// The body's name; each body has its own.
    pub name: String,
    /// Dynamic: the solid shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Dynamic: the centre of mass at the collision, in m; effects may put the shape's off it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<[f64; 3]>,
    /// Dynamic: the quaternion [w, x, y, z] that maps the body to the world at the collision;
    /// [1, 0, 0, 0] when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<[f64; 4]>,
    /// Dynamic: the velocity just before the collision, in m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub velocity: Option<[f64; 3]>,
    /// Dynamic: the angular velocity in the world just before the collision, in rad/s; zero when
    /// absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub angular_velocity: Option<[f64; 3]>,
    /// Dynamic: whether the orientation is seen; `false` for a plain ball. `true` when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub measure_orientation: Option<bool>,
    /// Dynamic: when this body is seen, where that differs from the other's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observations: Option<Sampling>,
    /// `true` for the infinitely heavy plane normal·p = height.
    #[serde(default, rename = "static", skip_serializing_if = "Option::is_none")]
    pub is_static: Option<bool>,
    /// Static: the plane's unit normal, out of the solid, in the world.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// Static: the plane's distance from the origin along its normal, in m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
}

/// One instantaneous impulse **J** on a, −**J** on b, at one point; exactly one of `restitution`
/// and `impulse` says how strong it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [{"required": ["restitution"]}, {"required": ["impulse"]}]))]
pub struct CollisionSpec {
    /// When, in s; frame n is at n / fps.
    pub time: f64,
    /// Where the bodies touch, in the world, in m: on the surface of both.
    pub contact_point: [f64; 3],
    /// The unit vector along the impulse on a, out of b into a; required with `restitution`
    /// between two dynamic bodies, otherwise absent: a plane has its own, an impulse its direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// −(relative normal velocity after)/(before) by the contact alone, with its friction but without
    /// impulses from elsewhere: from 0, no bounce, to 1, no loss.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0, max = 1))]
    pub restitution: Option<f64>,
    /// The impulse on a, per unit mass of a, in N·s/kg; on a static plane along its normal. What
    /// effects add to it isn't counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub impulse: Option<[f64; 3]>,
}
