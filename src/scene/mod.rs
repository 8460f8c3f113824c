//! Scenes: what was observed of a collision.
//!
//! [`SceneFile`] is the file; [`Scene`] is the same after every rule was checked, with times in
//! seconds, sorted, and unit quaternions. A `Scene` can only be made through those checks.

pub(crate) mod body;
pub(crate) mod bounds;
mod check;
pub(crate) mod file;
mod fingerprint;
mod flights;
mod gaps;
mod order;
mod read;
mod rounding;
mod setting;
mod touches;
mod units;
pub(crate) mod values;
mod warn;

pub use file::{BodyFile, Camera, Noise, ObservationFile, SCENE_SCHEMA, SceneFile, Shape};
pub use gaps::Gap;
pub(crate) use gaps::gaps_between;
pub(crate) use rounding::smallest_m;
pub use setting::{Setting, SettingBody, SettingCamera, SettingPlane};
pub(crate) use units::{direction_in_words, seen_fps, seen_up};

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

/// A checked scene: one or two dynamic bodies, and maybe a static plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    name: String,
    fps: Option<f64>,
    up_in_world: UnitVector3<f64>,
    gravity_m_s2: f64,
    noise: Option<Noise>,
    camera: Option<Camera>,
    source: Option<serde_json::Map<String, serde_json::Value>>,
    bodies: Vec<DynamicBody>,
    plane: Option<StaticPlane>,
    warnings: Vec<Warning>,
}

/// A body that moves: its solid shape and its annotated poses, in order of time.
#[derive(Debug, Clone, PartialEq)]
pub struct DynamicBody {
    /// Unique within the scene.
    pub name: String,
    /// The solid whose inertia is scaled by the mass.
    pub shape: Shape,
    /// In order of time, no time twice.
    pub observations: Vec<Observation>,
}

/// One annotated pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Observation {
    /// Time in s.
    pub time_s: f64,
    /// Centre of mass in the world, in m.
    pub position_in_world: Vector3<f64>,
    /// Maps the body to the world; `None` when it wasn't measured.
    pub world_from_body: Option<UnitQuaternion<f64>>,
    /// Its σ over that of the scene's noise; 1 unless stated.
    pub noise_scale: f64,
}

/// The infinitely heavy plane normal·p = height.
#[derive(Debug, Clone, PartialEq)]
pub struct StaticPlane {
    /// Unique within the scene.
    pub name: String,
    /// Unit normal out of the solid, in the world.
    pub normal_in_world: UnitVector3<f64>,
    /// Distance from the origin along the normal, in m.
    pub height_m: f64,
}

/// Something that is allowed but often a mistake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// What looks wrong, and where.
    pub text: String,
    /// What to do about it.
    pub mend: String,
}

/// Prints as `text` and, on a second line, `hint: mend`, as errors do.
impl std::fmt::Display for Warning {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{}\n  hint: {}", self.text, self.mend)
    }
}

impl Scene {
    /// Free text from the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Frames per second, if the scene states them.
    pub fn fps(&self) -> Option<f64> {
        self.fps
    }

    /// Unit vector against gravity, in the world.
    pub fn up_in_world(&self) -> UnitVector3<f64> {
        self.up_in_world
    }

    /// Gravity in m/s².
    pub fn gravity_m_s2(&self) -> f64 {
        self.gravity_m_s2
    }

    /// One σ of the annotations, if stated.
    pub fn noise(&self) -> Option<Noise> {
        self.noise
    }

    /// The same poses, with no noise stated.
    pub(crate) fn without_noise(&self) -> Scene {
        Scene { noise: None, ..self.clone() }
    }

    /// With these poses alone.
    pub(crate) fn keeping(&self, is_kept: impl Fn(&Observation) -> bool) -> Scene {
        let mut scene = self.clone();
        scene.bodies.iter_mut().for_each(|body| body.observations.retain(&is_kept));
        scene
    }

    /// With another direction against gravity.
    pub(crate) fn with_up(&self, up_in_world: UnitVector3<f64>) -> Scene {
        Scene { up_in_world, ..self.clone() }
    }

    /// With another frame rate, if it has one.
    pub(crate) fn with_fps(&self, fps: f64) -> Scene {
        let mut scene = Scene { fps: Some(fps), ..self.clone() };
        let longer = self.fps.unwrap_or(fps) / fps;
        let poses = scene.bodies.iter_mut().flat_map(|body| &mut body.observations);
        poses.for_each(|pose| pose.time_s *= longer);
        scene
    }

    /// With each orientation turned into another one.
    pub(crate) fn turning(
        &self,
        turned: impl Fn(UnitQuaternion<f64>) -> UnitQuaternion<f64>,
    ) -> Scene {
        let mut scene = self.clone();
        for pose in scene.bodies.iter_mut().flat_map(|body| &mut body.observations) {
            pose.world_from_body = pose.world_from_body.map(&turned);
        }
        scene
    }

    /// With one pose in `every`, outwards from `time_s`.
    pub(crate) fn thinned(&self, every: usize, time_s: f64) -> Scene {
        let mut scene = self.clone();
        for body in &mut scene.bodies {
            let before = body.observations.partition_point(|pose| pose.time_s < time_s);
            let outwards = |index: usize| match index < before {
                true => before - 1 - index,
                false => index - before,
            };
            let mut index = 0..;
            body.observations.retain(|_| index.next().is_some_and(|i| outwards(i) % every == 0));
        }
        scene
    }

    /// The camera, if stated.
    pub fn camera(&self) -> Option<&Camera> {
        self.camera.as_ref()
    }

    /// The one or two bodies that move; the first is the reference body `a`.
    pub fn bodies(&self) -> &[DynamicBody] {
        &self.bodies
    }

    /// The static plane, if the contact is with one.
    pub fn plane(&self) -> Option<&StaticPlane> {
        self.plane.as_ref()
    }

    /// Whether any pose has its orientation measured.
    pub(crate) fn has_orientations(&self) -> bool {
        let poses = self.bodies.iter().flat_map(|body| &body.observations);
        poses.into_iter().any(|pose| pose.world_from_body.is_some())
    }

    /// The scene with the stamps of one body, or of all, moved by `shift_s`; `None` where they then
    /// leave no gap for the collision.
    pub(crate) fn delayed(&self, body: Option<usize>, shift_s: f64) -> Option<Scene> {
        let mut moved = self.clone();
        for (index, other) in moved.bodies.iter_mut().enumerate() {
            if body.is_none_or(|body| body == index) {
                other.observations.iter_mut().for_each(|seen| seen.time_s += shift_s);
            }
        }
        (!moved.gaps().is_empty()).then_some(moved)
    }

    /// The scene without the poses of one body, or of all, at `time_s`; `None` where the others leave no
    /// gap for the collision.
    pub(crate) fn without_pose(&self, body: Option<usize>, time_s: f64) -> Option<Scene> {
        let mut rest = self.clone();
        for (index, other) in rest.bodies.iter_mut().enumerate() {
            if body.is_none_or(|body| body == index) {
                other.observations.retain(|seen| seen.time_s != time_s);
            }
        }
        (!rest.gaps().is_empty()).then_some(rest)
    }

    /// The scene as if each body were annotated at these times in s, all in one place: for what only
    /// asks when.
    pub(crate) fn sampled_at(&self, times_s: Vec<Vec<f64>>) -> Scene {
        let mut sampled = self.clone();
        for (body, times_s) in sampled.bodies.iter_mut().zip(times_s) {
            let sample = |time_s| Observation {
                time_s,
                position_in_world: Vector3::zeros(),
                world_from_body: Some(UnitQuaternion::identity()),
                noise_scale: 1.0,
            };
            body.observations = times_s.into_iter().map(sample).collect();
        }
        sampled
    }

    /// Puts the warnings in the terms of what the scene was made of.
    pub(crate) fn retell_warnings(&mut self, retold: impl Fn(&str) -> String) {
        for warning in &mut self.warnings {
            warning.text = retold(&warning.text);
        }
    }

    /// What looked odd when the scene was read.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}
