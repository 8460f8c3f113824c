//! Scenes in good order, for other tests to break.

use serde_json::{Value, json};

/// Frames of an observation: regular, with the gap at the collision that the paper leaves.
const FRAMES: [i32; 10] = [-15, -12, -9, -6, -3, 3, 6, 9, 12, 15];

/// Two boxes that fly, meet at frame 0 and part. At 60 frames per second.
pub fn two_boxes() -> Value {
    json!({
        "schema": "smash.scene/1", "name": "two boxes", "fps": 60, "up": [0, 1, 0], "gravity": 9.81,
        "bodies": [
            {"name": "a", "shape": {"type": "box", "size": [0.1, 0.2, 0.3]},
             "observations": flight(-0.1, [2.0, -0.5])},
            {"name": "b", "shape": {"type": "sphere", "radius": 0.1},
             "observations": flight(0.1, [-1.0, 1.5])},
        ],
    })
}

/// A box that falls on a level floor and bounces.
pub fn box_on_floor() -> Value {
    let mut scene = two_boxes();
    scene["bodies"][1] =
        json!({"name": "floor", "static": true, "normal": [0, 1, 0], "height": -0.1});
    scene
}

/// A scene after `edit`.
pub fn edited(mut scene: Value, edit: impl Fn(&mut Value)) -> Value {
    edit(&mut scene);
    scene
}

/// Poses of a body that is at `x` at frame 0, with the speeds along x before and after.
fn flight(x: f64, speeds: [f64; 2]) -> Value {
    let poses = FRAMES.iter().map(|&frame| {
        let t = f64::from(frame) / 60.0;
        let speed = speeds[usize::from(frame > 0)];
        let half_turn = 0.5 * 3.0 * t;
        json!({
            "frame": frame,
            "position": [x + speed * t, 1.0 + 0.5 * t - 0.5 * 9.81 * t * t, 0.2 * t],
            "orientation": [half_turn.cos(), 0.0, half_turn.sin(), 0.0],
        })
    });
    poses.collect()
}
