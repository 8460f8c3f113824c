//! A scene is of one collision: of several contacts with a plane the first, with the flights before and
//! after it. What was filmed while the body was at the plane, or after it came back to it, is of neither.

use super::touches::{Path, Touch};
use super::{Observation, Scene, Warning};
use crate::words::{counted, quoted, rounded};

/// The scene without the poses that are of no flight before or after the body's first touch of the
/// plane: those taken during the touch, and those from the next one on. A warning says which. Returns when
/// it touches the plane, too, where something was left out.
pub(super) fn of_one_collision(mut scene: Scene) -> (Scene, Option<f64>) {
    let Some(found) = flights(&scene) else { return (scene, None) };
    scene.bodies[0].observations = found.kept;
    scene.warnings.push(found.warning);
    (scene, Some(found.touch_s))
}

struct Flights {
    kept: Vec<Observation>,
    /// Between the last pose before the touch and the first one after it.
    touch_s: f64,
    warning: Warning,
}

/// `None` where all poses are of one of two flights.
fn flights(scene: &Scene) -> Option<Flights> {
    let (body, plane) = (scene.bodies.first()?, scene.plane.as_ref()?);
    let path = Path::of(scene, body, plane)?;
    let touch = path.touch(0)?;
    let next = path.touch(touch.end);
    let all = &body.observations;
    let end = next.map_or(all.len(), |next| next.start);
    let left_out = touch.end - touch.start + all.len() - end;
    if left_out == 0 {
        return None;
    }
    let touch_s = 0.5 * (all[touch.start - 1].time_s + all[touch.end].time_s);
    let at = |pose: usize| rounded(all[pose].time_s);
    let (name, floor) = (quoted(&body.name), quoted(&plane.name));
    let kept = [&all[..touch.start], &all[touch.end..end]].concat();
    let during = |Touch { start, end }: Touch| match end - start {
        0 => None,
        count => Some(format!(
            "the {} from {} s on, while it touches the plane {floor}",
            counted(count, "pose"),
            at(start)
        )),
    };
    let after = next.map(|next| {
        let count = counted(all.len() - next.start, "pose");
        format!("the {count} from {} s on, when it is back at the plane {floor}", at(next.start))
    });
    let parts: Vec<String> = during(touch).into_iter().chain(after).collect();
    let text = format!(
        "body {name}: left out, since of no flight before or after the collision, are {}",
        parts.join(", and ")
    );
    let mend = "to reconstruct another contact, keep the poses around that one alone";
    Some(Flights { kept, touch_s, warning: Warning { text, mend: mend.into() } })
}
