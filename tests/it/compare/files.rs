//! Comparisons and results as files.

use serde_json::{Value, json};
use smash::{Comparison, Reconstruction, SchemaKind, compare, schema};

use super::{SCENES, compared, paper, refined, scene};
use crate::scenes::edited;

#[test]
fn a_comparison_fits_its_schema() {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Comparison)).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    for name in SCENES {
        let scene = scene(name);
        let comparison = compared(&scene, &[&paper(&scene), &refined(&scene)]);
        let written: Value = serde_json::from_str(&comparison.to_json()).unwrap();
        assert_eq!(validator.validate(&written).map_err(|e| e.to_string()), Ok(()));
        let read: Comparison = serde_json::from_value(written).unwrap();
        assert_eq!(read, comparison);
    }
}

/// What a result says is what is read, in every digit; unknown fields, as a batch adds, are passed
/// over.
#[test]
fn a_result_is_read_as_it_was_written() {
    for name in SCENES {
        let scene = scene(name);
        for result in [paper(&scene), refined(&scene)] {
            let read = Reconstruction::parse(&result.to_json(), "result.json").unwrap();
            assert_eq!(read, result);
            let later = edited(serde_json::to_value(&result).unwrap(), |value| {
                value["provenance"] = json!({"by": "a batch"});
                value["bodies"][0]["colour"] = json!("red");
            });
            assert_eq!(Reconstruction::parse(&later.to_string(), "result.json").unwrap(), result);
        }
    }
}

/// Each rule broken once: the place and a word of the problem or the mend.
#[test]
fn broken_results_are_refused_by_name() {
    type Case = (fn(&mut Value), &'static str, &'static str);
    let cases: [Case; 12] = [
        (|r| r["schema"] = json!("smash.scene/1"), "schema", "smash.result/1"),
        (|r| r["schema"] = json!(null), "schema", "text"),
        (|r| r["impulse"] = json!([0, 1]), "impulse", "list of 3"),
        (|r| r["impulse"][1] = json!("much"), "impulse[1]", "number"),
        (|r| r["impulse"][1] = json!(1e101), "impulse[1]", "not within"),
        (|r| r["collision_time"] = json!(0.5), "collision_time", "object"),
        (|r| r["restitution"]["std"] = json!(-0.1), "restitution.std", "σ"),
        (|r| r["uncertainty"]["std"][0] = json!(0), "uncertainty.std[0]", "σ"),
        (|r| r["uncertainty"]["std"] = json!([]), "uncertainty.std", "each quantity"),
        (|r| r["noise"]["position"] = json!(0), "noise.position", "σ"),
        (
            |r| r["bodies"][1]["orientation"] = json!([2, 0, 0, 0]),
            "bodies[1].orientation",
            "length",
        ),
        (|r| r["preset"] = json!("papr"), "preset", "did you mean `paper`?"),
    ];
    let good = serde_json::to_value(refined(&scene("boxes"))).unwrap();
    for (edit, place, word) in cases {
        let text = edited(good.clone(), edit).to_string();
        let error = Reconstruction::parse(&text, "result.json").unwrap_err();
        assert_eq!(error.place(), Some(place));
        let message = error.to_string();
        assert!(message.starts_with("result.json: "), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}

/// Results that are in order, but can't be of this scene.
#[test]
fn results_of_another_scene_are_refused() {
    let scene = scene("boxes");
    let good = refined(&scene);
    type Case = (fn(&mut Reconstruction), &'static str);
    let cases: [Case; 5] = [
        (|r| r.bodies.swap(0, 1), "`b`, `a`"),
        (|r| r.bodies.truncate(1), "`a`, but"),
        (|r| r.bodies.clear(), "empty"),
        (|r| r.collision_time.value = Some(7.0), "7 s"),
        (|r| r.bodies[0].angular_velocity_after = Some([1e6, 0.0, 0.0]), "turns"),
    ];
    for (edit, word) in cases {
        let mut wrong = good.clone();
        edit(&mut wrong);
        let named = [("good.json".to_string(), good.clone()), ("wrong.json".to_string(), wrong)];
        let error = compare(&scene, &named).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("wrong.json: "), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}
