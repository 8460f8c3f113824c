//! The published schemas agree with what is read and written.

use serde_json::{Value, json};
use smash::{Scene, SchemaKind, schema};

use crate::scenes::{box_on_floor, edited, two_boxes};

fn validator() -> jsonschema::Validator {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Scene)).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

#[test]
fn what_is_written_fits_the_schema() {
    for value in [two_boxes(), box_on_floor()] {
        let scene = Scene::parse(&value.to_string(), "scene.json").unwrap();
        let written: Value = serde_json::from_str(&scene.to_file().to_json()).unwrap();
        for instance in [value, written] {
            assert_eq!(validator().validate(&instance).map_err(|e| e.to_string()), Ok(()));
        }
    }
}

/// Scenes that differ in form from a good one, and whether they are still scenes.
#[test]
fn schema_and_reader_agree() {
    type Case = (bool, fn(&mut Value));
    let cases: [Case; 16] = [
        (true, |s| s["source"] = json!({"anything": [1, "x", null]})),
        (true, |s| s["camera"] = json!({"position": [0, 1, 2], "focal_length": 0.05})),
        (true, |s| s["bodies"][0]["observations"][0]["orientation"] = json!(null)),
        (true, |s| s["bodies"][0]["static"] = json!(false)),
        (false, |s| s["bodies"][0]["observations"][0]["orientaton"] = json!([1, 0, 0, 0])),
        (false, |s| s["gravitiy"] = json!(9.81)),
        (false, |s| s["schema"] = json!("smash.scene/2")),
        (false, |s| s["fps"] = json!(0)),
        (false, |s| s["gravity"] = json!(-1)),
        (false, |s| s["up"] = json!([0, 1])),
        (false, |s| s["bodies"] = json!([])),
        (false, |s| s["bodies"][0]["observations"][0]["time"] = json!(0)),
        (false, |s| s["bodies"][0]["observations"][0]["frame"] = json!(null)),
        (false, |s| s["bodies"][0]["shape"] = json!({"type": "box", "radius": 1})),
        (false, |s| s["bodies"][0]["height"] = json!(1)),
        (false, |s| s["bodies"][0]["static"] = json!(true)),
    ];
    for (index, (is_scene, edit)) in cases.into_iter().enumerate() {
        let value = edited(two_boxes(), edit);
        let reads = Scene::parse(&value.to_string(), "scene.json").map(|_| ());
        assert_eq!(reads.is_ok(), is_scene, "case {index}: {reads:?}");
        assert_eq!(validator().is_valid(&value), is_scene, "case {index}: schema");
    }
}
