//! `smash demo`: the whole story, from nothing.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use smash::Reconstruction;

const SMASH: &str = env!("CARGO_BIN_EXE_smash");

fn smash(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(SMASH);
    command.args(arguments).current_dir(folder).stdin(Stdio::null());
    command.output().unwrap()
}

fn said(output: Output) -> String {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// The result without wall times, which alone differ from run to run.
fn untimed(path: &Path) -> Reconstruction {
    let mut result = Reconstruction::read(path).unwrap();
    result.phases.iter_mut().for_each(|phase| phase.seconds = None);
    result
}

/// Told once in words and once, over the first one's files, in numbers.
#[test]
fn the_story_ends_with_what_was_hidden() {
    let folder = tempfile::tempdir().unwrap();
    let words = said(smash(folder.path(), &["demo"]));
    let files = folder.path().join("smash-demo");
    let (before, after) = words.split_once("Which effect is missing?").unwrap();
    assert!(!before.to_lowercase().contains("magnus"), "told too early:\n{before}");
    for expected in ["magnus@ball is missing", "+ magnus@ball", "truth", "k of magnus@ball"] {
        assert!(after.contains(expected), "no {expected:?} in\n{words}");
    }
    assert!(before.contains("ball, before the collision, is off along ω × v"), "{before}");
    assert!(words.lines().count() < 60, "a screen or two:\n{words}");
    assert_eq!(words.contains("report.html in a browser"), smash::report::has_page(), "{words}");
    assert_eq!(files.join("report.html").exists(), smash::report::has_page());

    // The commands do what was told.
    let commands = words.lines().filter_map(|line| line.trim_start().strip_prefix("$ smash "));
    let commands: Vec<&str> = commands.collect();
    assert_eq!(commands.len(), 6);
    let results = ["base.json", "better.json"].map(|name| files.join(name));
    let made = results.each_ref().map(|path| untimed(path));
    for command in commands.iter().filter(|line| line.starts_with("reconstruct")) {
        said(smash(folder.path(), &command.split(' ').collect::<Vec<_>>()));
    }
    assert_eq!(results.each_ref().map(|path| untimed(path)), made);

    let told: Value =
        serde_json::from_str(&said(smash(folder.path(), &["demo", "--json"]))).unwrap();
    let ladder = told["ladder"].as_array().unwrap();
    assert_eq!((told["verdict"].as_str(), ladder.len()), (Some("missing"), 2));
    let missed_m = |rung: &Value| rung["position_rmse"].as_f64().unwrap();
    assert!(missed_m(&ladder[0]) > 0.01 && missed_m(&ladder[1]) < 0.0022);
    let (truth, better) = (&told["truth"], &made[1]);
    let ratio = better.mass_ratio.as_ref().unwrap();
    for (found, truth) in [
        (ratio, &truth["mass_ratio"]),
        (&better.restitution, &truth["restitution"]),
        (&better.collision_time, &truth["collision_time"]),
    ] {
        let apart = found.value.unwrap() - truth.as_f64().unwrap();
        assert!(apart.abs() < 2.0 * found.std.unwrap(), "{found:?} {truth}");
    }
}

/// Nothing of the user's is written over; other files in the folder are no matter.
#[test]
fn files_of_others_are_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("mine");
    fs::create_dir(&own).unwrap();
    for name in ["scene.json", "report.html"] {
        fs::write(own.join(name), "mine").unwrap();
        let output = smash(folder.path(), &["demo", "-o", "mine"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(message.contains(&format!("mine/{name}: ")) && message.contains("-o FOLDER"));
        assert_eq!(fs::read_to_string(own.join(name)).unwrap(), "mine");
        assert_eq!(fs::read_dir(&own).unwrap().count(), 1);
        fs::remove_file(own.join(name)).unwrap();
    }
    fs::write(folder.path().join("file"), "").unwrap();
    assert_eq!(smash(folder.path(), &["demo", "-o", "file"]).status.code(), Some(1));
}

/// That a page is open is said when its opener says so.
#[test]
fn a_browser_that_cannot_be_opened_is_told_of() {
    if !smash::report::has_page() {
        return;
    }
    for (ends, opens) in [("exit 3", false), ("exit 0", true)] {
        let folder = tempfile::tempdir().unwrap();
        let opener = folder.path().join("xdg-open");
        fs::write(&opener, format!("#!/bin/sh\n{ends}\n")).unwrap();
        fs::set_permissions(&opener, fs::Permissions::from_mode(0o755)).unwrap();
        let mut command = Command::new(SMASH);
        command.args(["demo", "--open"]).current_dir(folder.path()).stdin(Stdio::null());
        let output = command.env("PATH", folder.path()).output().unwrap();
        let words = String::from_utf8(output.stdout).unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{errors}");
        assert_eq!(words.contains("is open in the browser"), opens, "{words}");
        assert_eq!(errors.contains("warning: no browser could be opened"), !opens, "{errors}");
    }
}
