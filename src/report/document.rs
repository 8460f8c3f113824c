//! The report's content as the page takes it, `smash.report/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::compare::{ComparedNoise, Quantity, ResidualSeries, ResultResiduals};
use crate::diagnose::Diagnosis;
use crate::improve::Improvement;
use crate::json::pretty;
use crate::motion::Motion;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::{DynamicBody, Noise, Setting, SettingCamera, SettingPlane, Shape};
use crate::{Reconstruction, Scene};

/// The value of a report's field `schema`.
pub const REPORT_SCHEMA: &str = "smash.report/1";

/// A scene, what results make of it, and what they lack. SI units, world frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.report/1")]
pub struct Report {
    /// Always `smash.report/1`.
    #[schemars(extend("const" = REPORT_SCHEMA))]
    pub schema: String,
    /// The versions that made it.
    pub made_with: Versions,
    /// What to type to make it again, in order.
    pub commands: Vec<String>,
    /// What was seen.
    pub scene: SceneView,
    /// The noise that residuals are told in; null where neither the scene nor a result has one.
    pub noise: Option<ComparedNoise>,
    /// Each result, the main one first.
    pub models: Vec<ModelView>,
    /// What the results say, side by side.
    pub quantities: Vec<Quantity>,
    /// What looks odd.
    pub warnings: Vec<String>,
    /// Which effect the base model lacks; null where it wasn't asked.
    pub diagnosis: Option<Diagnosis>,
    /// The ladder from the base model upwards; null where it wasn't asked.
    pub improvement: Option<Improvement>,
}

/// The versions that a report was made with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Versions {
    /// Of smash.
    pub smash: String,
    /// Of Ceres Solver.
    pub ceres: String,
}

/// A checked scene: times in s and in order, unit quaternions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SceneView {
    /// Free text.
    pub name: String,
    /// Unit vector against gravity.
    pub up: [f64; 3],
    /// m/s².
    pub gravity: f64,
    /// Frames per second, if stated.
    pub fps: Option<f64>,
    /// One σ of the annotations, if stated.
    pub noise: Option<Noise>,
    /// The camera, if stated.
    pub camera: Option<SettingCamera>,
    /// What moves, the reference body first.
    pub bodies: Vec<BodyView>,
    /// The static body, if there is one.
    pub plane: Option<SettingPlane>,
}

/// A body that moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodyView {
    /// Its name.
    pub name: String,
    /// The solid.
    pub shape: Shape,
    /// Annotated poses, in order of time.
    pub observations: Vec<ObservationView>,
}

/// An annotated pose.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ObservationView {
    /// s.
    pub time: f64,
    /// m.
    pub position: [f64; 3],
    /// Quaternion [w, x, y, z], body to world; null where it wasn't measured.
    pub orientation: Option<[f64; 4]>,
}

/// A result, and how it goes with the poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ModelView {
    /// The result's name.
    pub name: String,
    /// What was found.
    pub result: Reconstruction,
    /// Whether the stated noise alone leaves such residuals in fewer than one case of a thousand;
    /// false where none is stated.
    #[serde(default)]
    pub is_beyond_chance: bool,
    /// What it leaves of the poses.
    pub residuals: ResultResiduals,
    /// The same over time, along each axis.
    pub series: Vec<ResidualSeries>,
    /// How the bodies move by it; null where no motion is known.
    pub motion: Option<Motion>,
}

impl SceneView {
    pub(super) fn new(scene: &Scene) -> SceneView {
        let Setting { up, gravity, fps, camera, plane, bodies: _ } = scene.setting();
        SceneView {
            name: scene.name().to_string(),
            up,
            gravity,
            fps,
            noise: scene.noise(),
            camera,
            bodies: scene.bodies().iter().map(BodyView::new).collect(),
            plane,
        }
    }
}

impl BodyView {
    fn new(body: &DynamicBody) -> BodyView {
        let seen = body.observations.iter().map(|seen| ObservationView {
            time: seen.time_s,
            position: seen.position_in_world.into(),
            orientation: seen.world_from_body.as_ref().map(to_wxyz),
        });
        BodyView { name: body.name.clone(), shape: body.shape, observations: seen.collect() }
    }
}

impl Report {
    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}
