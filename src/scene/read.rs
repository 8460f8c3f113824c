//! Scenes from files and back.

use std::path::Path;

use super::check::checked;
use super::flights::of_one_collision;
use super::{BodyFile, ObservationFile, SCENE_SCHEMA, Scene, SceneFile, StaticPlane};
use crate::Result;
use crate::files::{display_name, read_text};
use crate::json::{decode, pretty};
use crate::rigid_body::quaternion::to_wxyz;

impl Scene {
    /// Reads and checks the scene file `path` (`-` is standard input), as [`Scene::parse`].
    ///
    /// # Errors
    /// The file can't be read, isn't JSON, or breaks a rule; with place, value and mend.
    pub fn read(path: impl AsRef<Path>) -> Result<Scene> {
        let path = path.as_ref();
        Scene::parse(&read_text(path)?, &display_name(path, "standard input"))
    }

    /// Reads and checks a scene from `text`; `file_name` is only for messages. Poses that were taken while
    /// the body touched the plane, or after it came back to it, are of no flight before or after the
    /// collision: they are left out, with a warning.
    ///
    /// # Errors
    /// The text isn't JSON or breaks a rule; with place, value and mend.
    pub fn parse(text: &str, file_name: &str) -> Result<Scene> {
        let file = decode(text, file_name, SCENE_SCHEMA)?;
        let scene = checked(file).map_err(|error| error.in_file(file_name))?;
        let (scene, collision_s) = of_one_collision(scene);
        Ok(scene.looked_over(collision_s))
    }

    /// The scene as a file: with times in s, in order, and unit vectors and quaternions.
    pub fn to_file(&self) -> SceneFile {
        let bodies = self.bodies.iter().map(|body| BodyFile {
            name: body.name.clone(),
            shape: Some(body.shape),
            observations: Some(body.observations.iter().map(ObservationFile::from).collect()),
            ..BodyFile::default()
        });
        let plane = self.plane.iter().map(BodyFile::from);
        SceneFile {
            schema: SCENE_SCHEMA.into(),
            name: self.name.clone(),
            fps: self.fps,
            up: self.up_in_world.into_inner().into(),
            gravity: self.gravity_m_s2,
            noise: self.noise,
            camera: self.camera.clone(),
            source: self.source.clone(),
            bodies: bodies.chain(plane).collect(),
        }
    }
}

impl SceneFile {
    /// The file's text: JSON with one observation a line.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}

impl From<&super::Observation> for ObservationFile {
    fn from(seen: &super::Observation) -> Self {
        ObservationFile {
            frame: None,
            time: Some(seen.time_s),
            position: seen.position_in_world.into(),
            orientation: seen.world_from_body.as_ref().map(to_wxyz),
            noise_scale: (seen.noise_scale != 1.0).then_some(seen.noise_scale),
        }
    }
}

impl From<&StaticPlane> for BodyFile {
    fn from(plane: &StaticPlane) -> Self {
        BodyFile {
            name: plane.name.clone(),
            is_static: Some(true),
            normal: Some(plane.normal_in_world.into_inner().into()),
            height: Some(plane.height_m),
            ..BodyFile::default()
        }
    }
}
