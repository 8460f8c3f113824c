//! The scene as it stands in a file, `smash.scene/1`: plain data, checked elsewhere.

use schemars::JsonSchema;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

/// The value of a scene file's field `schema`.
pub const SCENE_SCHEMA: &str = "smash.scene/1";

/// A scene file: two bodies, observed before and after they collide. SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "smash.scene/1")]
pub struct SceneFile {
    /// Always `smash.scene/1`.
    #[schemars(extend("const" = SCENE_SCHEMA))]
    pub schema: String,
    /// Free text.
    #[serde(default)]
    pub name: String,
    /// Frames per second; required when an observation gives `frame`.
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
    /// The noise of the annotations; estimated from the residuals when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<Noise>,
    /// The camera that the poses were seen with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// Where the data is from; carried along, never interpreted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub source: Option<serde_json::Map<String, serde_json::Value>>,
    /// One or two dynamic bodies, or one dynamic and one static; the first dynamic body is the
    /// reference body `a` with mass 1.
    #[schemars(length(min = 1, max = 2))]
    pub bodies: Vec<BodyFile>,
}

/// y is up, also in a simulation.
pub(crate) fn default_up() -> [f64; 3] {
    [0.0, 1.0, 0.0]
}

/// On Earth, in m/s².
pub(crate) fn default_gravity() -> f64 {
    9.81
}

/// One standard deviation of the annotations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Noise {
    /// Of each position coordinate, in m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub position: f64,
    /// Of each component of the rotation vector, in rad.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub orientation: f64,
}

/// The camera; only its centre is used.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Camera {
    /// The camera's centre in the world, in m.
    pub position: [f64; 3],
    /// Intrinsics and pose may join it; carried along.
    #[serde(flatten)]
    pub more: serde_json::Map<String, serde_json::Value>,
}

/// A body in a scene file: dynamic (`shape` and `observations`), or a static plane (`static`,
/// `normal` and `height`).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    {"required": ["shape", "observations"], "properties": {
        "shape": {"type": "object"}, "observations": {"type": "array"},
        "static": {"enum": [false, null]}, "normal": {"type": "null"}, "height": {"type": "null"}}},
    {"required": ["static", "normal", "height"], "properties": {
        "static": {"const": true}, "normal": {"type": "array"}, "height": {"type": "number"},
        "shape": {"type": "null"}, "observations": {"type": "null"}}}
]))]
pub struct BodyFile {
    /// The body's name; each body has its own.
    pub name: String,
    /// Dynamic: the solid shape, whose inertia is scaled by the mass.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shape: Option<Shape>,
    /// Dynamic: the annotated poses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub observations: Option<Vec<ObservationFile>>,
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

/// A solid shape of uniform density; body axes are the box's axes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "type", rename_all = "lowercase", deny_unknown_fields)]
pub enum Shape {
    /// A solid cuboid.
    Box {
        /// Edge lengths along the body's axes, in m.
        size: [f64; 3],
    },
    /// A solid ball.
    Sphere {
        /// Radius, in m.
        radius: f64,
    },
}

/// By hand, since serde's own way through a tag loses the path to a wrong value.
impl<'de> Deserialize<'de> for Shape {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct ShapeFields {
            r#type: ShapeType,
            size: Option<[f64; 3]>,
            radius: Option<f64>,
        }
        #[derive(Deserialize)]
        #[serde(rename_all = "lowercase")]
        enum ShapeType {
            Box,
            Sphere,
        }
        let fields = ShapeFields::deserialize(source)?;
        match (fields.r#type, fields.size, fields.radius) {
            (ShapeType::Box, Some(size), None) => Ok(Shape::Box { size }),
            (ShapeType::Sphere, None, Some(radius)) => Ok(Shape::Sphere { radius }),
            (ShapeType::Box, _, Some(_)) => Err(D::Error::custom(
                "is a box with a `radius`; remove `radius`, or make it a sphere",
            )),
            (ShapeType::Box, None, None) => Err(D::Error::missing_field("size")),
            (ShapeType::Sphere, Some(_), _) => {
                Err(D::Error::custom("is a sphere with a `size`; remove `size`, or make it a box"))
            }
            (ShapeType::Sphere, None, None) => Err(D::Error::missing_field("radius")),
        }
    }
}

impl Shape {
    /// The shortest edge, or the diameter, in m.
    pub fn shortest_extent_m(&self) -> f64 {
        match *self {
            Shape::Box { size: [x, y, z] } => x.min(y).min(z),
            Shape::Sphere { radius } => 2.0 * radius,
        }
    }

    /// The full edges along the body's axes, in m; of a sphere its diameter thrice.
    pub fn edges_m(&self) -> [f64; 3] {
        match *self {
            Shape::Box { size } => size,
            Shape::Sphere { radius } => [2.0 * radius; 3],
        }
    }
}

/// One annotated pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = [
    {"required": ["frame"], "properties": {"frame": {"type": "number"}, "time": {"type": "null"}}},
    {"required": ["time"], "properties": {"time": {"type": "number"}, "frame": {"type": "null"}}}
]))]
pub struct ObservationFile {
    /// Frame number; the time is frame / fps. Either this or `time`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<f64>,
    /// Time in s. Either this or `frame`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time: Option<f64>,
    /// The centre of mass in the world, in m.
    pub position: [f64; 3],
    /// The quaternion [w, x, y, z] that maps the body to the world; absent when not measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<[f64; 4]>,
    /// How many times as noisy this pose is as the others; 1 when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0.001, max = 1000))]
    pub noise_scale: Option<f64>,
}
