//! A result beside poses that it wasn't made from: `smash compare` warns, `smash report` refuses.

use std::fs;
use std::path::Path;

use serde_json::Value;
use smash::scene::SceneFile;
use smash::{Scene, reconstruct};

use super::{ROOT, assert_done, smash};

fn scene_file() -> Value {
    let path = format!("{ROOT}/scenes/thrown_ball_drag.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// Writes the changed scene and the result of the unchanged one.
fn prepare(folder: &Path, change: impl Fn(&mut Value)) {
    let mut file = scene_file();
    fs::write(folder.join("scene.json"), file.to_string()).unwrap();
    assert_done(&smash(folder, &["reconstruct", "scene.json", "-o", "result.json"]));
    change(&mut file);
    fs::write(folder.join("scene.json"), file.to_string()).unwrap();
}

fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let output = smash(folder, arguments);
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

const REPORT: [&str; 5] = ["report", "scene.json", "result.json", "-o", "report.html"];

#[test]
fn another_scene_or_an_edited_one_is_told_of_with_what_differs() {
    for (change, differs) in [
        (
            (|file: &mut Value| {
                let x = file["bodies"][0]["observations"][3]["position"][0].as_f64().unwrap();
                file["bodies"][0]["observations"][3]["position"][0] = (x + 0.3).into();
            }) as fn(&mut Value),
            "another version of this scene: other poses, or another noise; it misses its own poses \
             by 7.16 mm, and these by 29.8 mm",
        ),
        (
            |file: &mut Value| file["gravity"] = 9.7.into(),
            "another version of this scene: another value of `gravity`; it misses its own poses by \
             7.16 mm, and these by 7.16 mm",
        ),
        (
            |file: &mut Value| {
                file["name"] = "another".into();
                file["bodies"][0]["shape"]["radius"] = 0.2.into();
            },
            "`; this is `another`: another value of the shape of ball; it misses",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        prepare(folder, change);
        let (code, words) = said(folder, &["compare", "scene.json", "result.json"]);
        assert_eq!(code, Some(0), "{words}");
        let told = "warning: result.json was made from another ";
        assert!(words.contains(told) && words.contains(differs), "{words}");
        let (code, words) = said(folder, &REPORT);
        assert_eq!(code, Some(1), "{words}");
        assert!(words.contains("error: result.json: was made from another "), "{words}");
        assert!(
            words.contains(differs) && words.contains("reconstruct this scene again"),
            "{words}"
        );
        assert!(!folder.join("report.html").exists());
    }
}

/// The name, the source and the way in which the file is written are no content.
#[test]
fn the_same_poses_written_in_another_way_are_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    prepare(folder, |file| {
        file["name"] = "another name".into();
        file["source"] = serde_json::json!({"film": "7"});
        file["bodies"][0]["observations"].as_array_mut().unwrap().reverse();
        let x = &mut file["bodies"][0]["observations"][3]["position"][0];
        *x = x.as_f64().unwrap().next_up().into();
        let checked =
            Scene::from_file(serde_json::from_value::<SceneFile>(file.clone()).unwrap()).unwrap();
        *file = serde_json::to_value(checked.to_file()).unwrap();
    });
    for command in [&["compare", "scene.json", "result.json"][..], &REPORT] {
        let (code, words) = said(folder, command);
        assert_eq!((code, words.contains("was made from")), (Some(0), false), "{words}");
    }
}

/// Results of older versions tell it by their error.
#[test]
fn an_older_result_is_known_by_its_error() {
    for (shift, code) in [(0.0, 0), (0.3, 1)] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        prepare(folder, |file| {
            let x = file["bodies"][0]["observations"][3]["position"][0].as_f64().unwrap();
            file["bodies"][0]["observations"][3]["position"][0] = (x + shift).into();
        });
        let path = folder.join("result.json");
        let mut old: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        old.as_object_mut().unwrap().remove("scene_fingerprint").unwrap();
        fs::write(&path, old.to_string()).unwrap();
        let (found, words) = said(folder, &REPORT);
        assert_eq!(found, Some(code), "{words}");
    }
}

/// q and -q are the same pose.
#[test]
fn the_sign_of_quaternions_is_no_other_content() {
    let scene = Scene::read(format!("{ROOT}/scenes/boxes.json")).unwrap();
    let mut file = scene.to_file();
    for pose in file.bodies.iter_mut().filter_map(|body| body.observations.as_mut()).flatten() {
        let turned = pose.orientation.as_mut().unwrap();
        turned.iter_mut().for_each(|x| *x = -*x);
    }
    assert_eq!(Scene::from_file(file).unwrap().fingerprint(), scene.fingerprint());
}

/// By the error alone the results of all methods are known for their own.
#[test]
fn no_older_result_of_the_scenes_is_taken_for_anothers() {
    for name in ["boxes", "ball_on_floor", "box_on_floor", "uneven_times", "thrown_ball_drag"] {
        let scene = Scene::read(format!("{ROOT}/scenes/{name}.json")).unwrap();
        for options in [smash::Options::default(), smash::Options::paper()] {
            let mut result = reconstruct(&scene, &options).unwrap();
            result.scene_fingerprint = None;
            let told = smash::compare(&scene, &[("result".to_string(), result)]).unwrap();
            assert!(told.warnings.is_empty(), "{name}: {:?}", told.warnings);
        }
    }
}
