//! What tells a scene's content from all others'.

use serde_json::Value;

use super::Scene;
use crate::files::sha256;

impl Scene {
    /// The SHA-256 of all that the scene says of the collision: bodies with their shapes, poses and
    /// times in order, noise, gravity, frame rate, the camera's centre and the plane, each number to
    /// nine digits. Neither white space, the order of fields, `frame` in place of `time` nor a quaternion's
    /// sign changes it, and rounding beyond those digits hardly ever does, nor do the scene's name, its `source` and what else is told of the
    /// camera.
    pub fn fingerprint(&self) -> String {
        let mut file = self.to_file();
        file.name.clear();
        file.source = None;
        if let Some(camera) = &mut file.camera {
            camera.more.clear();
        }
        // q and -q are the same.
        let poses = file.bodies.iter_mut().filter_map(|body| body.observations.as_mut()).flatten();
        for q in poses.filter_map(|pose| pose.orientation.as_mut()) {
            if q.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) {
                q.iter_mut().for_each(|x| *x = -*x);
            }
        }
        let tree = serde_json::to_value(&file).expect("plain numbers and strings have a JSON form");
        let mut text = String::new();
        write(&mut text, &tree);
        sha256(&text)
    }
}

/// Whatever differs is written otherwise: as JSON, but for the numbers.
fn write(text: &mut String, tree: &Value) {
    match tree {
        Value::Number(number) => {
            // The sum has no −0.
            let value = number.as_f64().unwrap_or(f64::NAN) + 0.0;
            *text += &format!("{value:.8e},");
        }
        Value::Array(items) => {
            text.push('[');
            items.iter().for_each(|item| write(text, item));
            text.push(']');
        }
        Value::Object(fields) => {
            text.push('{');
            for (name, item) in fields {
                *text += &format!("{name:?}:");
                write(text, item);
            }
            text.push('}');
        }
        other => *text += &format!("{other},"),
    }
}
