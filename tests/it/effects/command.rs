//! `smash effects` as a person or a script meets it.

use std::fs;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use smash::effect::catalogue;
use tempfile::TempDir;

use super::with_acceleration;

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// Standard output of a run that must succeed without a word on standard error.
fn quiet_success(output: Output) -> String {
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

/// Standard error of a run whose input is at fault.
fn failure(output: Output) -> String {
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(output.stdout, b"");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn list_names_every_effect() {
    let folder = tempfile::tempdir().unwrap();
    let words = quiet_success(run(&folder, &["effects", "list"]));
    let text = quiet_success(run(&folder, &["effects", "list", "--json"]));
    let json: Vec<Value> = serde_json::from_str(&text).unwrap();
    assert_eq!(json.len(), catalogue().len());
    for (effect, value) in catalogue().iter().zip(json) {
        assert!(words.contains(&format!("  {}  ", effect.name)), "{words}");
        assert!(words.contains(&effect.title), "{words}");
        assert_eq!(value["name"], effect.name);
    }
}

#[test]
fn show_tells_all_of_an_effect() {
    let folder = tempfile::tempdir().unwrap();
    let words = quiet_success(run(&folder, &["effects", "show", "depth_scale"]));
    for part in [
        "depth_scale: Positions scaled about the camera",
        "position  camera + s * (p - camera)",
        "  s  1  null 1, 0.5 to 2\n    1.02 where the body is 2 % smaller",
        "each body",
        "the camera's position",
        "Looks like",
        "gravity_scale, constant_force, gravity_tilt",
        "Hartley",
        "smash reconstruct SCENE --with depth_scale",
    ] {
        assert!(words.contains(part), "no {part:?} in {words}");
    }
    let text = quiet_success(run(&folder, &["effects", "show", "depth_scale", "--json"]));
    let json: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["law"]["position"], "camera + s * (p - camera)");
    assert_eq!(json["parameters"]["s"]["null"], 1.0);
    let message = failure(run(&folder, &["effects", "show", "depht_scale"]));
    assert!(message.contains("did you mean `depth_scale`?"), "{message}");
}

#[test]
fn a_file_of_ones_own_is_checked_and_shown() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("wind.toml"), with_acceleration("k * up", "m/s^2")).unwrap();
    let words = quiet_success(run(&folder, &["effects", "check", "wind.toml"]));
    assert!(words.starts_with("wind.toml: `mine` is good: acceleration\n"), "{words}");
    assert!(words.contains("smash reconstruct SCENE --with wind.toml"), "{words}");
    let text = quiet_success(run(&folder, &["effects", "check", "wind.toml", "--json"]));
    assert_eq!(serde_json::from_str::<Value>(&text).unwrap()["name"], "mine");
    let words = quiet_success(run(&folder, &["effects", "show", "./wind.toml"]));
    assert!(words.contains("k * up"), "{words}");
}

/// The file, the field, the caret and the mend.
#[test]
fn a_mistake_is_shown_where_it_is() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("wind.toml"), with_acceleration("k * upp", "m/s^2")).unwrap();
    assert_eq!(
        failure(run(&folder, &["effects", "check", "wind.toml"])),
        "error: wind.toml: law.acceleration: `upp` is unknown\n    \
         k * upp\n    \
         \x20   ^^^\n  \
         hint: did you mean `up`?\n"
    );
    let message = failure(run(&folder, &["effects", "check", "none.toml"]));
    assert!(message.contains("none.toml: can't be read"), "{message}");
    let message = failure(run(&folder, &["effects", "check", "magnus"]));
    assert!(message.contains("hint: magnus is built in"), "{message}");
}

#[test]
fn wrong_usage_ends_with_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [&["effects"][..], &["effects", "lost"], &["effects", "show"]] {
        assert_eq!(run(&folder, arguments).status.code(), Some(2), "{arguments:?}");
    }
}
