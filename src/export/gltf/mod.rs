//! A film in 3D: glTF 2.0 in one binary file.

mod animation;
mod buffer;
mod container;
mod material;
mod solid;
mod stage;

use serde_json::{Value, json};

use super::frames::{Film, film, tracks};
use crate::{Reconstruction, Result};
use animation::Keys;
use buffer::Buffer;
use solid::Solid;
use stage::{Ground, upright};

/// A body turns no further from key to key, rad. Between keys viewers turn about one axis at one
/// speed; that of a tumbling box is off by some (turn)²/8 then, 0.07°.
const LARGEST_TURN_RAD: f64 = 0.1;

/// The motion in `result` as a film in 3D: the bytes of a glTF 2.0 binary file (`.glb`).
///
/// Each body is a node that moves, below one that turns the scene's `up` to +y, as glTF has it: a
/// body's own translation and rotation are those of the scene. Its keys are `fps` a second (at the
/// scene's own rate for `None`, or 60), and at the collision; where it turns by more than 0.1 rad
/// between them each frame is divided. Seconds count from the first pose; `extras` of the scene tell
/// what that is by the scene's clock, and what the result found. A body whose spin isn't known isn't
/// turned.
///
/// # Errors
/// The result has no setting or no collision time, the keys are too many, or the motion can't be
/// followed.
///
/// # Example
/// ```no_run
/// let result = smash::Reconstruction::read("result.json")?;
/// std::fs::write("collision.glb", smash::export::gltf(&result, None)?).expect("a place to write");
/// # Ok::<(), smash::Error>(())
/// ```
pub fn gltf(result: &Reconstruction, fps: Option<f64>) -> Result<Vec<u8>> {
    let mut film = film(result, fps)?;
    let parts = (fastest_spin(&film) / film.fps / LARGEST_TURN_RAD).ceil();
    if parts > 1.0 {
        film = self::film(result, Some(film.fps * parts))?;
    }
    let mut buffer = Buffer::default();
    let (mut nodes, mut meshes, mut materials) = (vec![Value::Null], Vec::new(), Vec::new());
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    for (index, (body, motion)) in film.scene.bodies().iter().zip(&film.motion.bodies).enumerate() {
        meshes.push(Solid::of(&body.shape).mesh(&body.name, materials.len(), &mut buffer));
        materials.extend(material::of_body(index, &body.name));
        let keys = Keys::of(motion, film.first_s);
        keys.animate(nodes.len(), &mut buffer, &mut samplers, &mut channels);
        nodes.push(keys.node(&body.name, meshes.len() - 1));
    }
    if let Some(plane) = film.scene.plane() {
        let ground = Ground::below(&film, plane);
        meshes.push(Solid::sheet(ground.half_m).mesh(&plane.name, materials.len(), &mut buffer));
        materials.push(material::of_plane(&plane.name));
        nodes.push(ground.node(&plane.name, meshes.len() - 1));
    }
    let name = if result.scene.is_empty() { "collision" } else { &result.scene };
    nodes[0] = json!({
        "name": name, "rotation": upright(&film.scene.up_in_world()),
        "children": (1..nodes.len()).collect::<Vec<_>>(),
    });
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("smash ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": name, "nodes": [0], "extras": extras(result, &film)}],
        "nodes": nodes, "meshes": meshes, "materials": materials,
        "animations": [{"name": "collision", "samplers": samplers, "channels": channels}],
        "accessors": buffer.accessors, "bufferViews": buffer.views,
        "buffers": [{"byteLength": buffer.bytes.len()}],
    });
    Ok(container::glb(&document, &buffer.bytes))
}

/// rad/s; 0 where no spin is known.
fn fastest_spin(film: &Film) -> f64 {
    let spins = film.motion.bodies.iter().flat_map(tracks).flat_map(|track| &track.spins).flatten();
    spins.map(|spin| spin.iter().fold(0.0, |sum: f64, x| sum.hypot(*x))).fold(0.0, f64::max)
}

/// What a program may want to know beside the motion.
fn extras(result: &Reconstruction, film: &Film) -> Value {
    let effects: Vec<String> = result.effects.iter().map(|effect| effect.label()).collect();
    json!({
        "smash": env!("CARGO_PKG_VERSION"),
        "scene": result.scene,
        "first_pose_s": film.first_s,
        "collision_s": film.motion.collision_time - film.first_s,
        "mass_ratio": result.mass_ratio.as_ref().and_then(|ratio| ratio.value),
        "restitution": result.restitution.value,
        "effects": effects,
    })
}
