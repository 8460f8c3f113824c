//! `smash simulate` as a user meets it: files in, files out, and the scenes of the repository.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use smash::simulate::{SimulationSpec, Truth, simulate};
use smash::{SchemaKind, schema};

const SCENES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");

fn smash(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .arg("simulate")
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The specifications in the repository, by path without `.spec.json`.
fn specifications() -> Vec<String> {
    let entries = fs::read_dir(SCENES).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path().display().to_string());
    paths.filter_map(|path| path.strip_suffix(".spec.json").map(str::to_owned)).collect()
}

/// The committed scenes are what the program makes of the specifications beside them. Numbers may
/// differ by 1e-12: another machine's sine rounds otherwise.
#[test]
fn every_scene_of_the_repository_can_be_made_again() {
    let stems = specifications();
    assert!(stems.len() >= 4);
    let folder = tempfile::tempdir().unwrap();
    for stem in stems {
        let made = smash(folder.path(), &[&format!("{stem}.spec.json"), "-o", "-"]);
        assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
        let made: Value = serde_json::from_slice(&made.stdout).unwrap();
        let committed = fs::read_to_string(format!("{stem}.json")).unwrap();
        assert_same(&made, &serde_json::from_str(&committed).unwrap(), &stem);
    }
}

fn assert_same(made: &Value, committed: &Value, place: &str) {
    match (made, committed) {
        (Value::Number(x), Value::Number(y)) => {
            let difference = x.as_f64().unwrap() - y.as_f64().unwrap();
            assert!(difference.abs() < 1e-12, "{place}: {x} is not {y}");
        }
        (Value::Array(x), Value::Array(y)) if x.len() == y.len() => {
            for (index, (x, y)) in x.iter().zip(y).enumerate() {
                assert_same(x, y, &format!("{place}[{index}]"));
            }
        }
        (Value::Object(x), Value::Object(y)) if x.keys().eq(y.keys()) => {
            for (key, value) in x {
                assert_same(value, &y[key], &format!("{place}.{key}"));
            }
        }
        _ => assert_eq!(made, committed, "{place}"),
    }
}

/// Specifications keep the published schema; so do random ones, and the truth keeps its own.
#[test]
fn specifications_and_truths_keep_their_schemas() {
    let schema = published(SchemaKind::Simulation);
    let keeps = |spec: &Value| jsonschema::is_valid(&schema, spec);
    for stem in specifications() {
        let text = fs::read_to_string(format!("{stem}.spec.json")).unwrap();
        let mut spec: Value = serde_json::from_str(&text).unwrap();
        assert!(keeps(&spec), "{stem}");
        spec["collision"]["restitution"] = 0.5.into();
        spec["collision"]["impulse"] = serde_json::json!([0, 1, 0]);
        assert!(!keeps(&spec), "{stem}: both strengths");
    }
    let truth_schema = published(SchemaKind::Truth);
    for spec in [SimulationSpec::random_cuboids(1), SimulationSpec::random_ball_drop(1)] {
        assert!(keeps(&serde_json::from_str(&spec.to_json()).unwrap()));
        let truth = simulate(&spec).unwrap().truth.to_json();
        assert!(jsonschema::is_valid(&truth_schema, &serde_json::from_str(&truth).unwrap()));
    }
}

fn published(kind: SchemaKind) -> Value {
    serde_json::from_str(&schema(kind)).unwrap()
}

/// A specification written and read again is the same one, to the last bit.
#[test]
fn a_specification_survives_its_file() {
    for spec in [SimulationSpec::random_cuboids(4), SimulationSpec::random_ball_drop(4)] {
        assert_eq!(SimulationSpec::parse(&spec.to_json(), "spec.json").unwrap(), spec);
    }
}

#[test]
fn the_command_writes_scene_and_truth_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let spec = format!("{SCENES}/boxes.spec.json");
    let run = smash(folder.path(), &[&spec, "-o", "scene.json", "--truth", "truth.json"]);
    let told = String::from_utf8(run.stdout).unwrap();
    assert!(run.status.success() && told.contains("1.8000") && told.contains("scene.json"));
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let truth: Truth = serde_json::from_str(&read("truth.json")).unwrap();
    assert_eq!((truth.mass_ratio, truth.restitution), (Some(1.8), 0.6));
    let seeded = |seed: &str| {
        assert!(smash(folder.path(), &[&spec, "-o", "s.json", "--seed", seed]).status.success());
        read("s.json")
    };
    assert_eq!(seeded("1"), read("scene.json"), "the specification's own seed is 1");
    assert_ne!(seeded("2"), read("scene.json"));
    let json = smash(folder.path(), &[&spec, "-o", "scene.json", "--json"]);
    assert_eq!(String::from_utf8(json.stdout).unwrap(), read("truth.json"));
}

#[test]
fn a_mistake_is_named_with_its_file_place_and_mend() {
    let folder = tempfile::tempdir().unwrap();
    let good = fs::read_to_string(format!("{SCENES}/boxes.spec.json")).unwrap();
    for (wrong, right, expected) in [
        ("\"restitutoin\"", "\"restitution\"", "did you mean `restitution`?"),
        ("\"gausian\"", "\"gaussian\"", "did you mean `gaussian`?"),
        ("\"regular\": 4, \"x\"", "\"regular\"", "observations"),
        ("\"gaussian\", \"x\": {\"gaussian\"", "{\"gaussian\"", "such as {\"gaussian\": {"),
        ("\"seed\": -1", "\"seed\": 1", "seed"),
        ("\"velocity\": [0.9, 0.1]", "\"velocity\": [0.9, 0.1, 0.3]", "bodies[0].velocity"),
        ("\"restitution\": 1.2", "\"restitution\": 0.6", "from 0 (no bounce) to 1"),
        ("\"restitution\": 1e999", "\"restitution\": 0.6", "broken.json"),
    ] {
        assert!(good.contains(right), "{right}");
        fs::write(folder.path().join("broken.json"), good.replace(right, wrong)).unwrap();
        let run = smash(folder.path(), &["broken.json", "-o", "scene.json"]);
        let message = String::from_utf8(run.stderr).unwrap();
        assert_eq!(run.status.code(), Some(1), "{message}");
        assert!(message.starts_with("error: broken.json: "), "{message}");
        assert!(message.contains(expected) && message.contains("hint: "), "{message}");
        assert!(!folder.path().join("scene.json").exists());
    }
}
