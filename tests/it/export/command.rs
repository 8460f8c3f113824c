//! `smash export`, as it is typed.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

use super::result;
use crate::scenes::edited;

/// A folder with `result.json`, that of boxes, and `ball.json`, whose spin isn't known.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("result.json"), result("boxes").to_json()).unwrap();
    fs::write(folder.path().join("ball.json"), result("ball_on_floor").to_json()).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
    command.arg("export").args(arguments).current_dir(folder).stdin(Stdio::null());
    command.output().unwrap()
}

fn success(output: Output) -> Vec<u8> {
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    assert_eq!(output.status.code(), Some(0));
    output.stdout
}

fn failure(output: Output) -> String {
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

/// The name's ending tells the format, unless it is given.
#[test]
fn the_format_is_told_or_guessed() {
    let folder = folder();
    let read = |file: &str| fs::read(folder.path().join(file)).unwrap();
    for (arguments, file, start) in [
        (&["result.json", "-o", "film.glb"][..], "film.glb", b"glTF"),
        (&["result.json", "-o", "table.CSV"], "table.CSV", b"time"),
        (&["result.json", "-o", "film", "--format", "gltf"], "film", b"glTF"),
        (&["result.json", "-o", "odd.glb", "--format", "csv", "--fps", "7"], "odd.glb", b"time"),
    ] {
        let said = String::from_utf8(success(run(folder.path(), arguments))).unwrap();
        assert!(
            said.starts_with(&format!("Written: {file}\n")) && said.contains("Next: "),
            "{said}"
        );
        assert_eq!(&read(file)[..4], start);
    }
    for arguments in [
        &["result.json", "-o", "film.gltf"][..],
        &["result.json", "-o", "-"],
        &["result.json"],
        &["result.json", "-o", "film.glb", "--fps", "0"],
        &["result.json", "-o", "film.glb", "--fps", "often"],
        &["result.json", "-o", "film.glb", "--format", "fbx"],
    ] {
        assert_eq!(run(folder.path(), arguments).status.code(), Some(2), "{arguments:?}");
    }
    let wrong =
        |arguments: &[&str]| String::from_utf8(run(folder.path(), arguments).stderr).unwrap();
    let said = wrong(&["result.json", "-o", "film.gltf"]);
    assert!(said.contains("film.gltf: ") && said.contains("Usage: smash export "), "{said}");
    let said = wrong(&["result.json", "-o", "film.glb", "--fps", "-5"]);
    assert!(said.contains("above 0") && !said.contains("unexpected"), "{said}");
}

#[test]
fn standard_streams_carry_data_alone() {
    let folder = folder();
    let text = fs::read(folder.path().join("result.json")).unwrap();
    success(run(folder.path(), &["result.json", "-o", "film.glb"]));
    let film = success(run(folder.path(), &["result.json", "-o", "-", "--format", "gltf"]));
    assert_eq!(film, fs::read(folder.path().join("film.glb")).unwrap());
    let mut child = Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(["export", "-", "-o", "-", "--format", "csv"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), &text).unwrap();
    let table = child.wait_with_output().unwrap().stdout;
    let expected = smash::export::csv(&result("boxes"), None).unwrap();
    assert_eq!(String::from_utf8(table).unwrap(), expected);
    let arguments = ["result.json", "-o", "-", "--format", "csv", "--json"];
    assert!(failure(run(folder.path(), &arguments)).contains("--json"));
}

#[test]
fn what_is_left_out_is_said() {
    let folder = folder();
    let words = success(run(folder.path(), &["ball.json", "-o", "ball.glb"]));
    let words = String::from_utf8(words).unwrap();
    assert!(words.contains("Not known, and left out: how ball turns"), "{words}");
    let told = success(run(folder.path(), &["ball.json", "-o", "ball.csv", "--json"]));
    let told: Value = serde_json::from_slice(&told).unwrap();
    let expected = json!({"file": "ball.csv", "format": "csv", "unknown": ["how ball turns"]});
    assert_eq!(told, expected);
    let told = success(run(folder.path(), &["result.json", "-o", "film.glb", "--json"]));
    assert_eq!(serde_json::from_slice::<Value>(&told).unwrap()["unknown"], json!([]));
}

/// Results that are in order, but can't be flown: the file, the place and the mend; and what was there
/// before stays.
#[test]
fn what_cannot_move_is_refused_by_name() {
    type Case = (fn(&mut Value), &'static [&'static str], &'static str, &'static str);
    let cases: [Case; 6] = [
        (|r| drop(r.as_object_mut().unwrap().remove("setting")), &[], "setting", "reconstruct"),
        (
            |r| r["collision_time"] = json!({"value": null, "std": null, "reason": "no jump"}),
            &[],
            "collision_time.value",
            "no jump",
        ),
        (|_| {}, &["--fps", "9e6"], "fps", "fewer frames"),
        (|r| r["bodies"][0]["velocity_after"][0] = json!(1e20), &[], "bodies[0]", "velocities"),
        (|r| r["bodies"][1]["angular_velocity_after"][0] = json!(1e9), &[], "bodies[1]", "rad/s"),
        (|r| r["gravity"] = json!([0, 9.81, 0]), &[], "gravity", "upwards"),
    ];
    let folder = folder();
    fs::write(folder.path().join("film.glb"), "an older film").unwrap();
    let good = serde_json::to_value(result("boxes")).unwrap();
    for (edit, further, place, word) in cases {
        let text = edited(good.clone(), edit).to_string();
        fs::write(folder.path().join("bad.json"), text).unwrap();
        let arguments = [&["bad.json", "-o", "film.glb"], further].concat();
        let message = failure(run(folder.path(), &arguments));
        assert!(message.starts_with(&format!("error: bad.json: {place}")), "{message}");
        assert!(message.contains(word) && message.contains("hint: "), "{message}");
        let kept = fs::read_to_string(folder.path().join("film.glb")).unwrap();
        assert_eq!(kept, "an older film");
    }
}

#[test]
fn the_file_at_fault_is_named() {
    let folder = folder();
    fs::write(folder.path().join("cut.json"), "{\"schema\": \"smash.result/1\", ").unwrap();
    let scene = format!("{}/scenes/boxes.json", env!("CARGO_MANIFEST_DIR"));
    fs::copy(scene, folder.path().join("scene.json")).unwrap();
    for file in ["cut.json", "scene.json", "missing.json"] {
        let message = failure(run(folder.path(), &[file, "-o", "film.glb"]));
        assert!(message.starts_with(&format!("error: {file}: ")), "{message}");
        assert!(!folder.path().join("film.glb").exists());
    }
    let message = failure(run(folder.path(), &["result.json", "-o", "no/film.glb"]));
    assert!(message.contains("no/film.glb"), "{message}");
    // A result is an input: it isn't written over.
    let arguments = ["result.json", "-o", "result.json", "--format", "csv"];
    assert!(failure(run(folder.path(), &arguments)).contains("input"));
}
