//! What a scene says, in short: enough to tell what was changed in its file since.

use serde_json::{Map, Value, json};

use crate::Scene;
use crate::files::sha256;
use crate::json::pretty;
use crate::scene::ObservationFile;
use crate::words::{quoted, shortened};

/// Checksums of a body: of more poses, one is of several.
const MOST_CHECKS: usize = 1_000;
/// Hexadecimal digits of a checksum.
const CHECK_DIGITS: usize = 6;
/// Changes that are told; more are counted.
const MOST_TOLD: usize = 4;

/// The fields of the scene's file, with checksums instead of the poses; without what changes no fit.
pub(super) fn content(scene: &Scene) -> Map<String, Value> {
    let mut file = scene.to_file();
    file.name.clear();
    file.source = None;
    if let Some(camera) = &mut file.camera {
        camera.more.clear();
    }
    let poses: Vec<_> = file.bodies.iter_mut().map(|body| body.observations.take()).collect();
    let mut tree = json!(file);
    for (body, poses) in poses.iter().enumerate() {
        if let Some(poses) = poses {
            tree["bodies"][body]["observations"] =
                json!({"count": poses.len(), "checks": checks(poses)});
        }
    }
    // As a session's file holds it: whole numbers have no `.0` there.
    serde_json::from_str(&pretty(&tree)).unwrap_or_default()
}

/// Of so many poses each is one checksum.
fn block(count: usize) -> usize {
    count.div_ceil(MOST_CHECKS).max(1)
}

fn checks(poses: &[ObservationFile]) -> String {
    let check = |block: &[ObservationFile]| sha256(&json!(block).to_string());
    poses.chunks(block(poses.len())).map(|block| check(block)[..CHECK_DIGITS].to_string()).collect()
}

/// What is other `now` than it `was`, in words.
pub(super) fn changes(was: &Map<String, Value>, now: &Map<String, Value>) -> String {
    let mut all = Vec::new();
    compare_fields("", was, now, &mut all);
    let further = all.len().saturating_sub(MOST_TOLD);
    all.truncate(MOST_TOLD);
    let told = all.join("; ");
    if further > 0 { format!("{told}; and {further} more") } else { told }
}

fn compare_fields(
    path: &str,
    was: &Map<String, Value>,
    now: &Map<String, Value>,
    all: &mut Vec<String>,
) {
    let new = now.keys().filter(|key| !was.contains_key(*key));
    for key in was.keys().chain(new) {
        let place = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        compare(&place, was.get(key), now.get(key), all);
    }
}

fn compare(place: &str, was: Option<&Value>, now: Option<&Value>, all: &mut Vec<String>) {
    match (was, now) {
        _ if was == now => {}
        (Some(Value::Object(was)), Some(Value::Object(now))) if is_poses(was) && is_poses(now) => {
            all.push(poses_in_words(place, was, now));
        }
        (Some(Value::Object(was)), Some(Value::Object(now))) => {
            compare_fields(place, was, now, all)
        }
        (Some(Value::Array(was)), Some(Value::Array(now))) if now.iter().all(Value::is_object) => {
            for index in 0..was.len().max(now.len()) {
                compare(&format!("{place}[{index}]"), was.get(index), now.get(index), all);
            }
        }
        (Some(_), None) => all.push(format!("{} isn't there any more", quoted(place))),
        (None, Some(_)) => all.push(format!("{} is new", quoted(place))),
        (Some(was), Some(now)) => {
            let [was, now] = [was, now].map(|value| shortened(&value.to_string()));
            all.push(format!("{} is {now}, and was {was}", quoted(place)));
        }
        (None, None) => {}
    }
}

fn is_poses(fields: &Map<String, Value>) -> bool {
    fields.contains_key("checks")
}

fn poses_in_words(place: &str, was: &Map<String, Value>, now: &Map<String, Value>) -> String {
    let count = |fields: &Map<String, Value>| fields.get("count").and_then(Value::as_u64);
    let name = quoted(place);
    let (Some(had), Some(has)) = (count(was), count(now)) else {
        return format!("{name} are others");
    };
    if had != has {
        return format!("{name} are {has} poses, and were {had}");
    }
    let checks = |fields| -> Vec<u8> { text(fields, "checks").bytes().collect() };
    let (before, after) = (checks(was), checks(now));
    let pairs = before.chunks(CHECK_DIGITS).zip(after.chunks(CHECK_DIGITS));
    let other: Vec<usize> =
        pairs.enumerate().filter(|(_, (was, now))| was != now).map(|(index, _)| index).collect();
    let size = block(has as usize);
    match (other.as_slice(), size) {
        ([], _) => format!("{name} are others"),
        ([only], 1) => format!("in {name} pose {only} has other values"),
        ([first, ..], 1) => {
            format!("in {name} {} poses have other values, first {first}", other.len())
        }
        ([first, ..], _) => format!(
            "in {name} poses have other values, first in {} to {}",
            first * size,
            (first + 1) * size - 1
        ),
    }
}

fn text<'a>(fields: &'a Map<String, Value>, key: &str) -> &'a str {
    fields.get(key).and_then(Value::as_str).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(change: impl Fn(&mut Value)) -> String {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/boxes.json");
        let text = std::fs::read_to_string(file).unwrap();
        let mut tree: Value = serde_json::from_str(&text).unwrap();
        let was = Scene::parse(&text, "was").unwrap();
        change(&mut tree);
        let now = Scene::parse(&tree.to_string(), "now").unwrap();
        changes(&content(&was), &content(&now))
    }

    #[test]
    fn what_was_changed_is_told_by_its_place() {
        assert_eq!(told(|_| {}), "");
        assert_eq!(told(|scene| scene["name"] = json!("x")), "");
        assert_eq!(told(|scene| scene["gravity"] = json!(9.8)), "`gravity` is 9.8, and was 9.81");
        let noise = told(|scene| scene["noise"]["position"] = json!(0.25));
        assert!(noise.starts_with("`noise.position` is 0.25, and was 0.00"), "{noise}");
        let none = told(|scene| _ = scene.as_object_mut().unwrap().remove("noise"));
        assert_eq!(none, "`noise` isn't there any more");
        let pose = told(|scene| scene["bodies"][1]["observations"][3]["position"][0] = json!(0.5));
        assert_eq!(pose, "in `bodies[1].observations` pose 3 has other values");
        let fewer = told(|scene| {
            scene["bodies"][0]["observations"].as_array_mut().unwrap().pop();
        });
        assert!(fewer.starts_with("`bodies[0].observations` are "), "{fewer}");
        let many = told(|scene| {
            for (key, value) in
                [("fps", json!(59)), ("gravity", json!(1)), ("up", json!([0, 0, 1]))]
            {
                scene[key] = value;
            }
            scene["noise"] = json!({"position": 1, "orientation": 1});
        });
        assert!(many.matches("; ").count() == MOST_TOLD, "{many}");
    }
}
