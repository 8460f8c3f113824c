//! Whether a result can be of this scene.

use super::ResultResiduals;
use crate::scene::Scene;
use crate::words::{listed, quoted, rounded, significant};
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
            let [time, first, last] = [time, first, last].map(rounded);
            let problem =
                format!("is {time} s, but the scene's poses are from {first} s to {last} s");
            Err(Error::invalid("collision_time.value", problem)
                .mend("name the scene that this result was made from, or reconstruct it again"))
        }
        _ => Ok(()),
    }
}

/// The fit's own error and that on the same poses differ by less, in any version.
const SAME_SHARE: f64 = 0.01;
const SAME_M: f64 = 1e-6;

/// In which words `result`, which leaves `residuals` of the poses of `scene`, was made from other
/// content; `None` where it wasn't. Results of older versions tell it by their error alone.
pub(crate) fn other_content(
    scene: &Scene,
    result: &Reconstruction,
    residuals: &ResultResiduals,
) -> Option<String> {
    let own_m = result.fit.position_rmse;
    let is_other = match (&result.scene_fingerprint, residuals.position_rmse) {
        (Some(made_from), _) => *made_from != scene.fingerprint(),
        (None, Some(here_m)) => (here_m - own_m).abs() > SAME_SHARE * own_m + SAME_M,
        (None, None) => false,
    };
    if !is_other {
        return None;
    }
    let mut words = match result.scene == scene.name() {
        true => "was made from another version of this scene".to_string(),
        false => format!(
            "was made from another scene, {}; this is {}",
            quoted(&result.scene),
            quoted(scene.name())
        ),
    };
    words += &format!(": {}", differences(scene, result));
    if let Some(here_m) = residuals.position_rmse {
        let [own, here] = [own_m, here_m].map(|length_m| significant(1e3 * length_m, 3));
        words += &format!("; it misses its own poses by {own} mm, and these by {here} mm");
    }
    Some(words)
}

/// What is another one in `scene` than in that of `result`.
fn differences(scene: &Scene, result: &Reconstruction) -> String {
    let here = scene.setting();
    let Some(there) = &result.setting else { return "other poses".to_string() };
    let mut other: Vec<String> = Vec::new();
    let mut told = |name: &str, is_other: bool| {
        if is_other {
            other.push(name.to_string());
        }
    };
    told("`up`", here.up != there.up);
    told("`gravity`", here.gravity != there.gravity);
    told("`fps`", here.fps != there.fps);
    told("`camera`", here.camera != there.camera);
    told("the plane", here.plane != there.plane);
    for (here, there) in here.bodies.iter().zip(&there.bodies) {
        told(&format!("the shape of {}", here.name), here.shape != there.shape);
        told(&format!("the times of {}", here.name), here.seen != there.seen);
    }
    match other.is_empty() {
        true => "other poses, or another noise".to_string(),
        false => format!("another value of {}", other.join(", ")),
    }
}
