//! What a result carries of its scene.

use serde_json::{Value, json};
use smash::{Options, Reconstruction, reconstruct};

use super::{SCENES, result, scene};
use crate::scenes::edited;

#[test]
fn both_presets_say_where_and_when_the_collision_was_seen() {
    for name in SCENES {
        let scene = scene(name);
        for options in [Options::default(), Options::paper()] {
            let result = reconstruct(&scene, &options).unwrap();
            let setting = result.setting.as_ref().unwrap();
            assert_eq!(setting.up, <[f64; 3]>::from(scene.up_in_world().into_inner()));
            assert_eq!((setting.gravity, setting.fps), (scene.gravity_m_s2(), scene.fps()));
            for (body, seen) in setting.bodies.iter().zip(scene.bodies()) {
                assert_eq!((&body.name, body.shape), (&seen.name, seen.shape));
                let times: Vec<f64> = seen.observations.iter().map(|pose| pose.time_s).collect();
                assert_eq!(body.seen, [times[0], times[times.len() - 1]]);
            }
            let plane = setting.plane.as_ref().map(|plane| (plane.name.as_str(), plane.height));
            assert_eq!(plane, scene.plane().map(|plane| (plane.name.as_str(), plane.height_m)));
            let read = Reconstruction::parse(&result.to_json(), "result.json").unwrap();
            assert_eq!(read, result);
        }
    }
}

#[test]
fn a_result_of_an_older_version_is_read_without_one() {
    let result = result("boxes");
    let older = edited(serde_json::to_value(&result).unwrap(), |result| {
        result.as_object_mut().unwrap().remove("setting");
    });
    let read = Reconstruction::parse(&older.to_string(), "result.json").unwrap();
    assert_eq!(read, Reconstruction { setting: None, ..result });
}

type Case = (fn(&mut Value), &'static str, &'static str);

/// Each rule broken once: the place and a word of the problem or the mend.
fn assert_refused(scene_name: &str, cases: &[Case]) {
    let good = serde_json::to_value(result(scene_name)).unwrap();
    for (edit, place, word) in cases {
        let text = edited(good.clone(), |result| edit(&mut result["setting"])).to_string();
        let error = Reconstruction::parse(&text, "result.json").unwrap_err();
        assert_eq!(error.place(), Some(*place), "{error}");
        let message = error.to_string();
        assert!(message.starts_with("result.json: "), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}

#[test]
fn broken_settings_are_refused_by_name() {
    let cases: &[Case] = &[
        (|s| *s = json!("a studio"), "setting", "object"),
        (|s| s["up"] = json!([0, 2, 0]), "setting.up", "length"),
        (|s| s["up"] = json!([0, 1]), "setting.up", "list of 3"),
        (|s| s["gravity"] = json!(-9.81), "setting.gravity", "m/s²"),
        (|s| s["gravity"] = json!(null), "setting.gravity", "number"),
        (|s| s["fps"] = json!(0), "setting.fps", "frames per second"),
        (|s| s["camera"] = json!({"position": [0, 1e7, 0]}), "setting.camera.position[1]", "m"),
        (|s| s["bodies"] = json!([]), "setting.bodies", "1 or 2 dynamic"),
        (|s| s["bodies"][1]["name"] = json!("a"), "setting.bodies[1].name", "two bodies"),
        (|s| s["bodies"][1]["name"] = json!("c"), "setting.bodies", "`a`, `c`, but"),
        (|s| s["bodies"][1]["name"] = json!(""), "setting.bodies[1].name", "empty"),
        (
            |s| s["bodies"][0]["shape"]["size"][2] = json!(0),
            "setting.bodies[0].shape.size[2]",
            "lengths",
        ),
        (|s| s["bodies"][0]["shape"]["type"] = json!("bx"), "setting.bodies[0].shape.type", "box"),
        (|s| s["bodies"][0]["seen"] = json!([2, 1]), "setting.bodies[0].seen", "first"),
        (|s| s["bodies"][0]["seen"] = json!([0, 9e4]), "setting.bodies[0].seen", "a day"),
        (|s| s["bodies"][0]["seen"][1] = json!(1e11), "setting.bodies[0].seen[1]", "s"),
        (
            |s| {
                s["bodies"][0]["seen"] = json!([0.0, 0.1]);
                s["bodies"][1]["seen"] = json!([0.0, 0.1]);
            },
            "collision_time.value",
            "reconstruct",
        ),
    ];
    assert_refused("boxes", cases);
    let cases: &[Case] = &[
        (|s| s["plane"]["normal"] = json!([0, 0, 0]), "setting.plane.normal", "length"),
        (|s| s["plane"]["height"] = json!(1e9), "setting.plane.height", "height"),
        (|s| s["plane"]["name"] = s["bodies"][0]["name"].clone(), "setting.plane.name", "two"),
        (
            |s| {
                let again = s["bodies"][0].clone();
                s["bodies"].as_array_mut().unwrap().push(again);
            },
            "setting.bodies",
            "1 dynamic and 1 static",
        ),
    ];
    assert_refused("ball_on_floor", cases);
}

/// Results may be edited in a program, too: what doesn't fit together isn't flown.
#[test]
fn a_setting_of_other_bodies_is_not_flown() {
    let mut edited = result("boxes");
    edited.bodies.pop();
    let error = smash::export::csv(&edited, None).unwrap_err();
    assert_eq!(error.place(), Some("setting.bodies"));
}
