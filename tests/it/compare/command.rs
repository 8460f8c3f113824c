//! `smash compare` as a person or a script meets it.

use std::fs;

use serde_json::json;
use smash::Comparison;

use super::{folder, run, success};
use crate::scenes::edited;

#[test]
fn the_command_tells_in_words_and_in_json() {
    let folder = folder();
    let words =
        success(run(folder.path(), &["scene.json", "paper.json", "refined.json", "-o", "c.json"]));
    for expected in [
        "mass ratio",
        "collision time (s)",
        "difference",
        " σ",
        "yardstick",
        "position",
        "orientation",
        " mm",
        "°",
        "stated in the scene",
        "Where it fails",
    ] {
        assert!(words.contains(expected), "no {expected:?} in\n{words}");
    }
    let written = fs::read_to_string(folder.path().join("c.json")).unwrap();
    let comparison: Comparison = serde_json::from_str(&written).unwrap();
    assert_eq!(comparison.schema, "smash.comparison/1");
    assert_eq!(comparison.results[1].name, "refined.json");
    let arguments = ["scene.json", "paper.json", "refined.json", "--json"];
    assert_eq!(success(run(folder.path(), &arguments)), written);

    let alone = success(run(folder.path(), &["scene.json", "refined.json"]));
    assert!(!alone.contains("difference") && alone.contains("Nothing looks structured"), "{alone}");
    assert!(alone.contains("angular momentum") && alone.contains("energy of spin"), "{alone}");
    // A screen.
    assert!(alone.lines().count() < 50, "{alone}");
}

/// A picture for each result and body, in a folder that is made; results of one name are told apart.
#[test]
fn the_command_draws() {
    let folder = folder();
    fs::create_dir(folder.path().join("other")).unwrap();
    fs::copy(folder.path().join("paper.json"), folder.path().join("other/refined.json")).unwrap();
    let arguments = ["scene.json", "refined.json", "other/refined.json", "--svg", "plots"];
    success(run(folder.path(), &arguments));
    let mut files: Vec<String> = fs::read_dir(folder.path().join("plots"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    let expected = ["refined-a-2.svg", "refined-a.svg", "refined-b-2.svg", "refined-b.svg"];
    assert_eq!(files, expected);
    let svg = |name| fs::read_to_string(folder.path().join("plots").join(name)).unwrap();
    assert!(svg("refined-a.svg").contains("refined.json: a, poses minus model"));
    assert_ne!(svg("refined-a.svg"), svg("refined-a-2.svg"));
    let output = run(folder.path(), &["scene.json", "refined.json", "--svg", "scene.json"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(message.contains("scene.json") && message.contains("folder"), "{message}");
}

#[test]
fn the_command_names_the_file_at_fault() {
    let folder = folder();
    fs::write(folder.path().join("cut.json"), "{\"schema\": \"smash.result/1\", ").unwrap();
    fs::write(folder.path().join("twice.json"), "{\"impulse\": 1, \"impulse\": 2}").unwrap();
    for file in ["cut.json", "twice.json", "missing.json", "scene.json"] {
        let output =
            run(folder.path(), &["scene.json", "refined.json", file, "-o", "comparison.json"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.starts_with(&format!("error: {file}: ")), "{message}");
        assert!(message.contains("\n  hint: "), "{message}");
        assert!(!folder.path().join("comparison.json").exists());
    }
    // A result is an input: it isn't written over.
    let output = run(folder.path(), &["scene.json", "refined.json", "-o", "refined.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(run(folder.path(), &["scene.json"]).status.code(), Some(2));
}

/// Names are free text: another one alone is no matter; beside other poses it says which scene's they
/// are.
#[test]
fn another_scene_is_a_warning() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("scene.json")).unwrap();
    let renamed =
        edited(serde_json::from_str(&text).unwrap(), |scene| scene["name"] = json!("new"));
    let other = edited(renamed.clone(), |scene| scene["gravity"] = json!(9.8));
    for (scene, told) in
        [(renamed, ""), (other, "warning: refined.json was made from another scene")]
    {
        fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
        let output = run(folder.path(), &["scene.json", "refined.json"]);
        assert_eq!(output.status.code(), Some(0));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with(told) && message.is_empty() == told.is_empty(), "{message}");
    }
}
