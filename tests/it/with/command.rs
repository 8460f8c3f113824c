//! `--with` as a person or a script meets it.

use std::fs;
use std::process::{Command, Output, Stdio};

use smash::Reconstruction;
use tempfile::TempDir;

use super::{example, scene_value};

fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("boxes.json"), scene_value("boxes").to_string()).unwrap();
    fs::write(path.join("box_on_floor.json"), scene_value("box_on_floor").to_string()).unwrap();
    fs::copy(example("tether.toml"), path.join("tether.toml")).unwrap();
    folder
}

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn success(output: Output) -> String {
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

fn failure(output: Output, code: i32) -> String {
    assert_eq!(output.status.code(), Some(code));
    assert_eq!(output.stdout, b"");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn the_summary_tells_the_effects_with_their_deviations_or_why_there_are_none() {
    let folder = folder();
    let arguments = ["--with", "constant_force@a", "--with", "quadratic_drag@b:k=0.1"];
    let words = success(run(&folder, &[&["reconstruct", "boxes.json"], &arguments[..]].concat()));
    let told = words.split("Effects beyond the base model:\n").nth(1).unwrap();
    let lines: Vec<&str> = told.lines().collect();
    assert_eq!(lines[0].trim(), "constant_force@a");
    assert!(lines[1].contains(" ± (") && lines[1].ends_with("m/s^2"), "{}", lines[1]);
    assert_eq!(lines[2].trim(), "quadratic_drag@b");
    assert!(lines[3].contains("0.1000 1/m    (it was given)"), "{}", lines[3]);
    let plain = success(run(&folder, &["reconstruct", "boxes.json"]));
    assert!(!plain.contains("Effects"), "{plain}");
}

/// The file is needed to reconstruct, and not to compare.
#[test]
fn a_users_effect_is_only_needed_once() {
    let folder = folder();
    let arguments = ["reconstruct", "boxes.json", "--with", "./tether.toml@a", "-o", "r.json"];
    success(run(&folder, &arguments));
    fs::remove_file(folder.path().join("tether.toml")).unwrap();
    let words = success(run(&folder, &["compare", "boxes.json", "r.json"]));
    assert!(words.contains("r.json"), "{words}");
    let result = Reconstruction::read(folder.path().join("r.json")).unwrap();
    assert_eq!(result.effects[0].label(), "tether@a");
    let error = failure(run(&folder, &arguments), 1);
    assert!(error.contains("tether.toml") && error.contains("hint"), "{error}");
}

#[test]
fn a_batch_takes_effects_and_its_table_tells_them() {
    let folder = folder();
    let arguments =
        ["batch", "boxes.json", "box_on_floor.json", "-o", "out", "--with", "friction:mu=0.25"];
    let output = run(&folder, &arguments);
    // Between two boxes there is no plane to rub on: that scene fails, the other doesn't.
    assert_eq!(output.status.code(), Some(1));
    let table = fs::read_to_string(folder.path().join("out/results.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert!(rows[0].contains(",effects,"), "{}", rows[0]);
    assert!(rows[1].contains("failed") && rows[1].contains("no static body"), "{}", rows[1]);
    assert!(rows[2].contains(",friction@box:mu=0.25,"), "{}", rows[2]);
    let result = Reconstruction::read(folder.path().join("out/box_on_floor.result.json")).unwrap();
    assert_eq!(result.phases[3].name, "4 friction@box");
    assert_eq!(result.phases[3].seconds, None);
}

#[test]
fn effects_of_the_paper_and_broken_requests_are_refused() {
    let folder = folder();
    let paper = ["reconstruct", "boxes.json", "--preset", "paper", "--with", "linear_drag"];
    let error = failure(run(&folder, &paper), 2);
    assert!(error.contains("the paper's method has no `--with`"), "{error}");
    for (effect, words) in [
        ("linear_drga", "did you mean `linear_drag`?"),
        ("./nowhere.toml", "nowhere.toml"),
        ("linear_drag@c", "no dynamic body `c`"),
        ("friction", "no static body"),
    ] {
        let error = failure(run(&folder, &["reconstruct", "boxes.json", "--with", effect]), 1);
        assert!(error.contains(words) && error.contains("hint: "), "{error}");
    }
}
