//! What tells a scene's content from all others'.

use super::Scene;
use crate::files::sha256;

impl Scene {
    /// The SHA-256 of all that the scene says of the collision: bodies with their shapes, poses and
    /// times in order, noise, gravity, frame rate, the camera's centre and the plane. Neither white
    /// space, the order of fields nor `frame` in place of `time` changes it, nor do the scene's name, its
    /// `source` and what else is told of the camera.
    pub fn fingerprint(&self) -> String {
        let mut file = self.to_file();
        file.name.clear();
        file.source = None;
        if let Some(camera) = &mut file.camera {
            camera.more.clear();
        }
        sha256(&file.to_json())
    }
}
