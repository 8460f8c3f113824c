//! Whether a result can be of this scene.

use crate::scene::Scene;
use crate::words::{listed, quoted};
use crate::{Error, Reconstruction, Result};

/// Refuses a result that can't be of `scene`.
pub(super) fn check(scene: &Scene, result: &Reconstruction) -> Result<()> {
    let of_scene: Vec<&str> = scene.bodies().iter().map(|body| body.name.as_str()).collect();
    let of_result: Vec<&str> = result.bodies.iter().map(|body| body.name.as_str()).collect();
    if of_scene != of_result {
        let problem = match of_result.as_slice() {
            [] => "is empty".to_string(),
            names => format!("are {}, but the scene moves {}", listed(names), listed(&of_scene)),
        };
        return Err(Error::invalid("bodies", problem)
            .mend("name the scene that this result was made from, or reconstruct it again"));
    }
    let times = || scene.bodies().iter().flat_map(|body| &body.observations).map(|o| o.time_s);
    let first = times().fold(f64::INFINITY, f64::min);
    let last = times().fold(f64::NEG_INFINITY, f64::max);
    match result.collision_time.value {
        Some(time) if !(first..=last).contains(&time) => {
            let problem =
                format!("is {time} s, but the scene's poses are from {first} s to {last} s");
            Err(Error::invalid("collision_time.value", problem)
                .mend("name the scene that this result was made from, or reconstruct it again"))
        }
        _ => Ok(()),
    }
}

/// Names are free text: another one is no fault, but often a mistake.
pub(super) fn doubt(scene: &Scene, name: &str, result: &Reconstruction) -> Option<String> {
    (result.scene != scene.name()).then(|| {
        format!(
            "{name} was made from the scene {}, this is {}: are these its poses?",
            quoted(&result.scene),
            quoted(scene.name())
        )
    })
}
