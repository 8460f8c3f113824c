//! A scene without its poses: what a result needs to be flown again where the scene isn't at hand.

use nalgebra::{UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::body::{plane, solid};
use super::bounds::{FPS, GRAVITY_M_S2, LONGEST_SPAN_S, TIME_S};
use super::check::check_names;
use super::values::{check_range, position, unit_vector};
use super::{Camera, DynamicBody, Observation, Scene, Shape};
use crate::words::rounded;
use crate::{Error, Result};

/// Where and when a collision was seen. SI units, world frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Setting {
    /// Unit vector against gravity.
    pub up: [f64; 3],
    /// Gravity in m/s², as the scene states it.
    pub gravity: f64,
    /// Frames per second, if the scene states them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fps: Option<f64>,
    /// The camera's centre, if the scene states it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<SettingCamera>,
    /// The dynamic bodies, the reference body first.
    #[schemars(length(min = 1, max = 2))]
    pub bodies: Vec<SettingBody>,
    /// The static body, if there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plane: Option<SettingPlane>,
}

/// Where the camera was.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettingCamera {
    /// The camera's centre, m.
    pub position: [f64; 3],
}

/// A dynamic body, and when it was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettingBody {
    /// Its name.
    pub name: String,
    /// Its solid shape.
    pub shape: Shape,
    /// The times of its first and its last pose, s.
    pub seen: [f64; 2],
}

/// The static body: the plane normal·p = height.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SettingPlane {
    /// Its name.
    pub name: String,
    /// Unit normal out of the solid.
    pub normal: [f64; 3],
    /// Distance from the origin along the normal, m.
    pub height: f64,
}

impl Scene {
    /// The scene without its poses.
    pub fn setting(&self) -> Setting {
        let seen = |body: &DynamicBody| match body.observations.as_slice() {
            [first, .., last] => [first.time_s, last.time_s],
            _ => unreachable!("a scene has two poses or more on each side of a gap"),
        };
        let body = |body: &DynamicBody| SettingBody {
            name: body.name.clone(),
            shape: body.shape,
            seen: seen(body),
        };
        Setting {
            up: self.up_in_world.into_inner().into(),
            gravity: self.gravity_m_s2,
            fps: self.fps,
            camera: self.camera.as_ref().map(|camera| SettingCamera { position: camera.position }),
            bodies: self.bodies.iter().map(body).collect(),
            plane: self.plane.as_ref().map(|plane| SettingPlane {
                name: plane.name.clone(),
                normal: plane.normal_in_world.into_inner().into(),
                height: plane.height_m,
            }),
        }
    }
}

impl Setting {
    /// The scene again, if every rule of a scene is kept. In place of its poses each body has two,
    /// at its first and its last time, that only say when: there is nothing to be fitted.
    ///
    /// # Errors
    /// The first broken rule; places are those in the setting at `place`.
    pub(crate) fn scene(&self, place: &str, name: &str) -> Result<Scene> {
        let at = |field: &str| format!("{place}.{field}");
        if let Some(fps) = self.fps {
            check_range(&at("fps"), fps, &FPS, "give the frames per second of the recording")?;
        }
        let mend = "give gravity in m/s², such as 9.81";
        check_range(&at("gravity"), self.gravity, &GRAVITY_M_S2, mend)?;
        if let Some(camera) = &self.camera {
            position(&at("camera.position"), camera.position)?;
        }
        if !matches!((self.bodies.len(), &self.plane), (1 | 2, None) | (1, Some(_))) {
            let planes = if self.plane.is_some() { "and a plane" } else { "and no plane" };
            let problem = format!("holds {} dynamic {planes}", self.bodies.len());
            return Err(Error::invalid(at("bodies"), problem)
                .mend("a scene has 1 or 2 dynamic bodies, or 1 dynamic and 1 static"));
        }
        let names = self.bodies.iter().enumerate();
        let names = names.map(|(index, body)| (at(&format!("bodies[{index}].name")), &body.name));
        let plane_name = self.plane.iter().map(|plane| (at("plane.name"), &plane.name));
        check_names(names.chain(plane_name))?;
        let bodies = self.bodies.iter().enumerate();
        let bodies = bodies.map(|(index, body)| dynamic(&at(&format!("bodies[{index}]")), body));
        let static_plane = |one: &SettingPlane| {
            plane(&at("plane"), one.name.clone(), Some(one.normal), Some(one.height))
        };
        Ok(Scene {
            name: name.to_string(),
            fps: self.fps,
            up_in_world: unit_vector(&at("up"), self.up)?,
            gravity_m_s2: self.gravity,
            noise: None,
            camera: self
                .camera
                .as_ref()
                .map(|camera| Camera { position: camera.position, more: serde_json::Map::new() }),
            source: None,
            bodies: bodies.collect::<Result<_>>()?,
            plane: self.plane.as_ref().map(static_plane).transpose()?,
            warnings: Vec::new(),
        })
    }
}

/// The body at `place`, with a pose at either end.
fn dynamic(place: &str, body: &SettingBody) -> Result<DynamicBody> {
    let shape = solid(place, Some(body.shape), None, None)?;
    let [first_s, last_s] = body.seen;
    for (index, time_s) in body.seen.into_iter().enumerate() {
        let place = format!("{place}.seen[{index}]");
        check_range(&place, time_s, &TIME_S, "give the time in s")?;
    }
    if first_s >= last_s || last_s - first_s > LONGEST_SPAN_S {
        let problem = format!("is from {} s to {} s", rounded(first_s), rounded(last_s));
        return Err(Error::invalid(format!("{place}.seen"), problem)
            .mend("give the times of the first and the last pose, a day apart at most"));
    }
    let pose = |time_s| Observation {
        time_s,
        position_in_world: Vector3::zeros(),
        world_from_body: Some(UnitQuaternion::identity()),
        noise_scale: 1.0,
    };
    Ok(DynamicBody { name: body.name.clone(), shape, observations: body.seen.map(pose).into() })
}
