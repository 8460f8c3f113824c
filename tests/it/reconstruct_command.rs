//! `smash reconstruct` as a person or a script meets it: a child process, its streams, its files.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use smash::Reconstruction;
use smash::reconstruct::{Preset, SegmentCriterion};
use tempfile::TempDir;

use crate::scenes::{edited, two_boxes};

/// A folder that holds `scene` as scene.json.
fn folder_with(scene: &Value) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
    folder
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
    command.arg("reconstruct").args(arguments).current_dir(folder).stdin(Stdio::null());
    command
}

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    command(folder.path(), arguments).output().unwrap()
}

/// Standard output of a run that must succeed without a word on standard error.
fn quiet_success(output: Output) -> String {
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

fn result(text: &str) -> Reconstruction {
    serde_json::from_str(text).unwrap()
}

#[test]
fn the_main_job_writes_the_result_and_tells_it_in_words() {
    let folder = folder_with(&two_boxes());
    let words = quiet_success(run(&folder, &["scene.json", "-o", "result.json"]));
    let text = fs::read_to_string(folder.path().join("result.json")).unwrap();
    let result = result(&text);
    assert_eq!(result.schema, "smash.result/1");
    let mass_ratio = format!("{:.2}", result.mass_ratio.unwrap().value.unwrap());
    let speed = format!("{:.3}", result.bodies[0].velocity_before[0]);
    let millimetres = format!("{:.2} mm", 1e3 * result.fit.position_rmse);
    for expected in [
        "two boxes",
        "mass ratio m_b/m_a",
        &mass_ratio,
        "restitution",
        "collision time",
        "velocity (m/s)",
        "spin (rad/s)",
        "before",
        "after",
        &speed,
        &millimetres,
        "°",
        "\nNext\n",
        "result.json",
        "smash compare scene.json result.json",
    ] {
        assert!(words.contains(expected), "no {expected:?} in\n{words}");
    }
    for flag in &result.flags {
        assert!(words.contains(flag.meaning()) && words.contains(flag.advice()), "{words}");
    }
}

/// The same numbers by every road; only the seconds differ.
#[test]
fn json_goes_where_it_is_wanted() {
    let folder = folder_with(&two_boxes());
    let as_value = |text: &str| {
        let mut value: Value = serde_json::from_str(text).unwrap();
        for phase in value["phases"].as_array_mut().unwrap() {
            phase["seconds"] = json!(0);
        }
        value
    };
    let printed = quiet_success(run(&folder, &["scene.json", "--json"]));
    let to_dash = quiet_success(run(&folder, &["scene.json", "-o", "-"]));
    let both = quiet_success(run(&folder, &["scene.json", "--json", "-o", "result.json"]));
    let written = fs::read_to_string(folder.path().join("result.json")).unwrap();
    assert_eq!(both, written);
    let mut from_stdin = command(folder.path(), &["-", "--json"]);
    from_stdin.stdin(File::open(folder.path().join("scene.json")).unwrap());
    let from_stdin = quiet_success(from_stdin.output().unwrap());
    for text in [to_dash, written, from_stdin] {
        assert_eq!(as_value(&text), as_value(&printed));
    }
}

#[test]
fn without_an_output_nothing_is_left_behind() {
    let folder = folder_with(&two_boxes());
    assert!(quiet_success(run(&folder, &["scene.json"])).contains("mass ratio"));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// A longer old result leaves no tail.
#[test]
fn an_existing_output_is_replaced_whole() {
    let folder = folder_with(&two_boxes());
    let path = folder.path().join("result.json");
    fs::write(&path, "old ".repeat(100_000)).unwrap();
    quiet_success(run(&folder, &["scene.json", "-o", "result.json"]));
    result(&fs::read_to_string(path).unwrap());
}

/// The paper's preset goes by distance unless told; the refined one by cost.
#[test]
fn presets_and_criteria_choose_the_segment() {
    let folder = folder_with(&two_boxes());
    for (options, preset, criterion) in [
        (&[][..], Preset::Refined, SegmentCriterion::Cost),
        (&["--segment-by", "cost"], Preset::Refined, SegmentCriterion::Cost),
        (&["--preset", "paper"], Preset::Paper, SegmentCriterion::Distance),
        (&["--preset", "paper", "--segment-by", "cost"], Preset::Paper, SegmentCriterion::Cost),
    ] {
        let arguments = [&["scene.json", "--json"], options].concat();
        let result = result(&quiet_success(run(&folder, &arguments)));
        assert_eq!(result.preset, preset, "{options:?}");
        assert_eq!(result.segment_by, criterion, "{options:?}");
    }
}

/// What one method hasn't is wrong usage, with the mend.
#[test]
fn options_of_the_other_method_are_refused() {
    let folder = folder_with(&two_boxes());
    for (options, mend) in [
        (&["--segment-by", "distance"][..], "--preset paper"),
        (&["--preset", "paper", "--robust"], "leave them out"),
        (&["--preset", "paper", "--intervals", "profile"], "leave them out"),
        (&["--preset", "paper", "--tilt-std", "1"], "leave them out"),
        (&["--robust", "--intervals", "profile"], "leave it or `--robust` out"),
        (&["--tilt-std", "0"], "above 0"),
        (&["--tilt-std", "NaN"], "above 0"),
    ] {
        let output = run(&folder, &[&["scene.json"], options].concat());
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains(mend), "{options:?}: {message}");
    }
}

#[test]
fn warnings_go_to_standard_error_and_into_the_result() {
    let unordered = edited(two_boxes(), |scene| {
        scene["bodies"][0]["observations"].as_array_mut().unwrap().swap(1, 2);
    });
    let folder = folder_with(&unordered);
    let output = run(&folder, &["scene.json", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.starts_with("warning: ") && stderr.contains("\n  hint: "), "{stderr}");
    let result = result(&String::from_utf8(output.stdout).unwrap());
    assert_eq!(result.warnings.len(), stderr.matches("warning: ").count());
    for warning in result.warnings {
        assert!(stderr.contains(&warning), "{warning} isn't in {stderr}");
    }
}

/// The paper chooses by a distance, which a lone body has from nothing: that is not offered next.
#[test]
fn a_lone_body_is_not_sent_into_an_error() {
    let lone = edited(two_boxes(), |scene| {
        scene["bodies"].as_array_mut().unwrap().truncate(1);
    });
    let folder = folder_with(&lone);
    let words = quiet_success(run(&folder, &["scene.json"]));
    assert!(words.contains("what it hit is not known"), "{words}");
    assert!(!words.contains("--preset paper"), "{words}");
    let output = run(&folder, &["scene.json", "--preset", "paper"]);
    assert_eq!(output.status.code(), Some(1));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains("scene.json") && stderr.contains("--segment-by cost"), "{stderr}");
}

#[test]
fn wrong_usage_ends_with_exit_code_2() {
    let folder = folder_with(&two_boxes());
    for arguments in [
        &[][..],
        &["scene.json", "--preset", "none"],
        &["scene.json", "--segment-by", "luck"],
        &["scene.json", "-o"],
        &["scene.json", "scene.json"],
        &["scene.json", "--sed"],
    ] {
        let output = run(&folder, arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert_eq!(output.stdout, b"", "{arguments:?}");
        assert!(String::from_utf8(output.stderr).unwrap().contains("--help"), "{arguments:?}");
    }
}

/// On a terminal a line of progress is drawn and taken away. `script` of util-linux lends one;
/// elsewhere there is nothing to test.
#[test]
fn a_terminal_shows_progress() {
    let lends_terminal = Command::new("script").arg("--version").output();
    if !lends_terminal.is_ok_and(|o| String::from_utf8_lossy(&o.stdout).contains("util-linux")) {
        return;
    }
    let folder = folder_with(&two_boxes());
    let line = format!(
        "{} reconstruct scene.json --preset paper --segment-by cost -o result.json",
        env!("CARGO_BIN_EXE_smash")
    );
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &line, "/dev/null"])
        .env("TERM", "xterm")
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let seen = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{seen}");
    // Nine segments for the ten times, but for the two with a single pose on a side.
    assert!(seen.contains("segment") && seen.contains(" of 7, cost "), "{seen}");
    let last_progress = seen.rfind(" of 7, cost ").unwrap();
    // Erase the line, in the terminal's own words, and then the result.
    let rest = &seen[last_progress..];
    assert!(rest.contains("\u{1b}[2K") && rest.contains("mass ratio"), "{rest:?}");
}

/// A fit that no flag catches may still miss the poses by more than chance.
#[test]
fn no_flags_is_no_praise_where_residuals_are_beyond_chance() {
    let scene = format!("{}/scenes/boxes.json", env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    let told = |options: &[&str]| {
        let arguments = [&[scene.as_str()], options].concat();
        quiet_success(run(&folder, &arguments))
    };
    assert!(told(&[]).contains("No flags: the fit shows none"));
    let paper = told(&["--preset", "paper"]);
    assert!(paper.contains("No flags; but the residuals are 1.29 times"), "{paper}");
}

/// What is proposed next is of the model that was asked for.
#[test]
fn the_next_steps_keep_the_options() {
    let scene = format!("{}/scenes/thrown_ball_drag.json", env!("CARGO_MANIFEST_DIR"));
    let folder = tempfile::tempdir().unwrap();
    let with = "gravity_scale:s=1.2";
    let arguments = [&scene, "--with", with, "--tilt-std", "0.5", "--intervals", "profile"];
    let words = quiet_success(run(&folder, &arguments));
    for expected in [
        format!("smash diagnose {scene} --tilt-std 0.5 --intervals profile --with {with} "),
        format!("smash reconstruct {scene} --tilt-std 0.5 --robust --with {with} "),
    ] {
        assert!(words.contains(&expected), "no {expected} in\n{words}");
    }
}

/// The impulse is on the scene's first body, whatever it is called.
#[test]
fn the_first_body_has_its_own_name() {
    let folder = tempfile::tempdir().unwrap();
    let scenes = format!("{}/scenes", env!("CARGO_MANIFEST_DIR"));
    let made = quiet_success(run(&folder, &[&format!("{scenes}/thrown_ball_drag.json")]));
    let spec = format!("{scenes}/thrown_ball_drag.spec.json");
    let simulated = Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(["simulate", &spec, "-o", "scene.json"])
        .current_dir(folder.path())
        .output();
    for words in [made, quiet_success(simulated.unwrap())] {
        assert!(words.contains("\n  impulse on ball      (0.000, 6."), "{words}");
        assert!(words.contains("N·s per kg of ball\n"), "{words}");
    }
}

/// What the poses leave open is no flag, but no reason for praise either.
#[test]
fn no_flags_is_no_praise_where_parameters_are_open() {
    let root = env!("CARGO_MANIFEST_DIR");
    let scene = format!("{root}/scenes/boxes.json");
    let folder = tempfile::tempdir().unwrap();
    // Air that doesn't drag may move as it likes.
    let idle = format!("{root}/examples/effects/wind.toml@a:k=0");
    let words = quiet_success(run(&folder, &[&scene, "--with", &idle]));
    assert!(words.contains("(the poses don't determine it)"), "{words}");
    assert!(words.contains("But these poses don't determine all\nparameters above"), "{words}");
    // What was given is no open question.
    let given = format!("{root}/examples/effects/wind.toml@a:k=0,wind=[0,0,0]");
    let words = quiet_success(run(&folder, &[&scene, "--with", &given]));
    assert!(words.ends_with("none of the known signs of failure.\n"), "{words}");
}
