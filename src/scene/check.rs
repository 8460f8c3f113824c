//! The rules of a scene: a [`SceneFile`] that keeps them all becomes a [`Scene`].

use super::body::{dynamic_body, static_plane};
use super::bounds::{FPS, GRAVITY_M_S2};
use super::values::{check_name, check_noise, check_range, position, unit_vector};
use super::{BodyFile, SCENE_SCHEMA, Scene, SceneFile, gaps, warn};
use crate::json::check_schema;
use crate::words::quoted;
use crate::{Error, Result};

impl Scene {
    /// Checks every rule of `smash.scene/1`, sorts the times and normalises what has unit length.
    ///
    /// # Errors
    /// The first broken rule, with its place, the value found, and a mend.
    pub fn from_file(file: SceneFile) -> Result<Scene> {
        Ok(checked(file)?.looked_over(None))
    }

    /// With the usual mistakes among its warnings. `collision_s`: when it is, if that is known.
    pub(super) fn looked_over(mut self, collision_s: Option<f64>) -> Scene {
        let odd = warn::look(&self, collision_s);
        self.warnings.extend(odd);
        self
    }
}

/// By every rule.
pub(super) fn checked(file: SceneFile) -> Result<Scene> {
    check_schema(&file.schema, SCENE_SCHEMA)?;
    check_name("name", &file.name)?;
    if let Some(fps) = file.fps {
        check_range("fps", fps, &FPS, "give the frames per second of the recording")?;
    }
    check_range("gravity", file.gravity, &GRAVITY_M_S2, "give gravity in m/s², such as 9.81")?;
    let up_in_world = unit_vector("up", file.up)?;
    if let Some(noise) = file.noise {
        check_noise("noise", &noise)?;
    }
    if let Some(camera) = &file.camera {
        position("camera.position", camera.position)?;
    }
    check_bodies(&file.bodies)?;

    let mut bodies = Vec::new();
    let mut plane = None;
    let mut warnings = Vec::new();
    for (index, body) in file.bodies.into_iter().enumerate() {
        let place = format!("bodies[{index}]");
        if body.is_static == Some(true) {
            plane = Some(static_plane(&place, body)?);
        } else {
            bodies.push(dynamic_body(&place, body, file.fps, &mut warnings)?);
        }
    }
    gaps::check(&bodies)?;
    Ok(Scene {
        name: file.name,
        fps: file.fps,
        up_in_world,
        gravity_m_s2: file.gravity,
        noise: file.noise,
        camera: file.camera,
        source: file.source,
        bodies,
        plane,
        warnings,
    })
}

fn check_bodies(bodies: &[BodyFile]) -> Result<()> {
    let planes = bodies.iter().filter(|body| body.is_static == Some(true)).count();
    let wanted = "a scene has 1 or 2 dynamic bodies, or 1 dynamic and 1 static";
    match (bodies.len() - planes, planes) {
        (1 | 2, 0) | (1, 1) => {}
        (0, 0) => return Err(Error::invalid("bodies", "is empty").mend(wanted)),
        (dynamic, planes) => {
            let problem = format!("holds {dynamic} dynamic and {planes} static");
            return Err(Error::invalid("bodies", problem).mend(wanted));
        }
    }
    let names = bodies.iter().enumerate();
    check_names(names.map(|(index, body)| (format!("bodies[{index}].name"), &body.name)))
}

/// Each name, with its place: not empty, and no other body's.
pub(super) fn check_names<'a>(names: impl Iterator<Item = (String, &'a String)>) -> Result<()> {
    let mut known: Vec<&String> = Vec::new();
    for (place, name) in names {
        check_name(&place, name)?;
        if name.is_empty() {
            return Err(Error::invalid(place, "is empty").mend("give the body a name, such as `a`"));
        }
        if known.contains(&name) {
            let problem = format!("{} is the name of two bodies", quoted(name));
            return Err(Error::invalid(place, problem).mend("give each body a name of its own"));
        }
        known.push(name);
    }
    Ok(())
}
