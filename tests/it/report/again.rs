//! The commands in a report make its results again, to the last bit.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use smash::reconstruct::Options;
use smash::{Reconstruction, Scene, reconstruct};

use super::{ROOT, SMASH, assert_done, data, smash};

const WIND: &str = r#"
name = "wind"
title = "it's a side wind"
[parameters.k]
unit = "1/s"
null = 0
bounds = [0, 10]
scale = 0.01
[parameters.air]
unit = "m/s"
null = [0, 0, 0]
bounds = [-20, 20]
[law]
acceleration = "k * (air - v)"
"#;

/// A result but for the wall time of its phases.
fn untimed(path: &Path) -> Reconstruction {
    let mut result = Reconstruction::read(path).unwrap();
    result.phases.iter_mut().for_each(|phase| phase.seconds = None);
    result
}

/// The commands of the report of `result`, which `options` made in `folder`.
fn commands(folder: &Path, scene: &str, options: &[&str]) -> Vec<String> {
    let arguments = [&["reconstruct", scene, "-o", "result 1.json"], options].concat();
    assert_done(&smash(folder, &arguments));
    report_commands(folder, scene)
}

fn report_commands(folder: &Path, scene: &str) -> Vec<String> {
    assert_done(&smash(folder, &["report", scene, "result 1.json", "-o", "report.html"]));
    let data = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    data["commands"].as_array().unwrap().iter().map(|one| one.as_str().unwrap().into()).collect()
}

/// Runs `commands` in a shell that finds this program.
fn type_in(folder: &Path, commands: &[String]) {
    let bin = Path::new(SMASH).parent().unwrap().display().to_string();
    let path = format!("{bin}:{}", std::env::var("PATH").unwrap_or_default());
    let output = Command::new("sh")
        .args(["-e", "-c", &commands.join("\n")])
        .current_dir(folder)
        .env("PATH", path)
        .output()
        .unwrap();
    assert_done(&output);
}

/// Runs the commands that make the result: all but the last three, which ask and report.
fn assert_made_again(folder: &Path, commands: &[String]) {
    let path = folder.join("result 1.json");
    let before = untimed(&path);
    fs::remove_file(&path).unwrap();
    let (made, rest) = commands.split_at(commands.len() - 3);
    type_in(folder, made);
    assert!(untimed(&path) == before, "{commands:#?}");
    let starts = ["smash diagnose ", "smash improve ", "smash report "];
    for (command, start) in rest.iter().zip(starts) {
        assert!(command.starts_with(start), "{command}");
    }
}

#[test]
fn the_commands_make_the_same_result_again_whatever_its_options() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("my wind.toml"), WIND).unwrap();
    let scenes = format!("{ROOT}/scenes");
    for (scene, options) in [
        ("boxes", &["--preset", "paper"][..]),
        ("boxes", &["--preset", "paper", "--segment-by", "cost"]),
        ("boxes", &["--tilt-std", "0.7", "--intervals", "profile"]),
        ("thrown_ball_drag", &["--robust", "--with", "quadratic_drag@ball:k=0.123456789012345"]),
        ("thrown_ball_drag", &["--with", "./my wind.toml@ball:air=[0.5,-1e-5,2]"]),
        ("boxes", &["--with", "gravity_tilt", "--with", "linear_drag", "--tilt-std", "1e-6"]),
    ] {
        let scene = format!("{scenes}/{scene}.json");
        assert_made_again(folder, &commands(folder, &scene, options));
    }
}

/// The file of a law may be gone or changed by the time that one looks at the report.
#[test]
fn a_law_whose_file_is_gone_or_changed_is_written_again() {
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    for changed in [None, Some(WIND.replace("air - v", "air - 2 * v"))] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        fs::write(folder.join("wind.toml"), WIND).unwrap();
        commands(folder, &scene, &["--with", "wind.toml"]);
        match &changed {
            None => fs::remove_file(folder.join("wind.toml")).unwrap(),
            Some(text) => fs::write(folder.join("wind.toml"), text).unwrap(),
        }
        let commands = report_commands(folder, &scene);
        // Another path in the options is the only difference that may be.
        let path = folder.join("result 1.json");
        let before = untimed(&path);
        type_in(folder, &commands);
        let after = untimed(&path);
        assert_eq!(after.made_with().unwrap(), before.made_with().unwrap());
        assert_eq!(
            Reconstruction { options: None, ..after },
            Reconstruction { options: None, ..before }
        );
        if let Some(text) = changed {
            assert_eq!(fs::read_to_string(folder.join("wind.toml")).unwrap(), text);
        }
    }
}

/// Older results don't state their options; most can be told from the rest.
#[test]
fn older_results_are_made_again_as_far_as_they_tell() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    let options = ["--with", "quadratic_drag@ball:k=0.1", "--intervals", "profile"];
    let stated = commands(folder, &scene, &options);
    let path = folder.join("result 1.json");
    let mut old: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    old.as_object_mut().unwrap().remove("options").unwrap();
    fs::write(&path, old.to_string()).unwrap();
    assert_eq!(report_commands(folder, &scene), stated);
}

/// From Rust the options of a result are all that is needed.
#[test]
fn the_options_of_a_result_make_it_again() {
    let scene = Scene::read(format!("{ROOT}/scenes/boxes.json")).unwrap();
    let result = reconstruct(&scene, &Options::paper_by_cost()).unwrap();
    let again = Reconstruction::parse(&result.to_json(), "result").unwrap();
    let mut made = reconstruct(&scene, &again.made_with().unwrap()).unwrap();
    for (one, other) in made.phases.iter_mut().zip(&result.phases) {
        one.seconds = other.seconds;
    }
    assert_eq!(made, result);
}

/// What a result says of a file is a stranger's word: a shell must take it for one word.
#[test]
fn a_hostile_result_puts_no_command_of_its_own_into_the_report() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("wind.toml"), WIND).unwrap();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    commands(folder, &scene, &["--with", "wind.toml"]);
    let path = folder.join("result 1.json");
    let mut result: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    let evil = "'; touch evil; '\n$(touch evil)`touch evil`";
    result["options"]["effects"][0]["file"] = evil.into();
    result["options"]["effects"][0]["definition"]["help"]["source"] = evil.into();
    result["options"]["effects"][0]["body"] = evil.into();
    fs::write(&path, result.to_string()).unwrap();
    for command in report_commands(folder, &scene) {
        // It may well fail: the body isn't there.
        let run = Command::new("sh").args(["-c", &command]).current_dir(folder).output();
        run.unwrap();
    }
    assert!(!folder.join("evil").exists());
}

/// What was given of a law stays given where the law is a candidate: in the page's diagnosis, and in the
/// command that asks again.
#[test]
fn given_values_stay_given_in_what_is_tried() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("wind.toml"), WIND).unwrap();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    let commands = commands(folder, &scene, &["--with", "wind.toml@ball:air=[0.5,0,2]"]);
    let tried = " --try 'wind.toml:air=[0.5,0,2]'";
    let asked = &commands[commands.len() - 3..commands.len() - 1];
    for (command, ask) in asked.iter().zip(["diagnose", "improve"]) {
        assert_eq!(*command, format!("smash {ask} {scene}{tried}"));
    }
    let page = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    type_in(folder, &[format!("{} -o diagnosis.json", asked[0])]);
    let again = fs::read_to_string(folder.join("diagnosis.json")).unwrap();
    let again: Value = serde_json::from_str(&again).unwrap();
    let rows = |diagnosis: &Value| -> Vec<(Value, Value)> {
        let candidates = diagnosis["candidates"].as_array().unwrap().iter();
        candidates.map(|one| (one["effect"].clone(), one["parameters_added"].clone())).collect()
    };
    assert_eq!(rows(&page["diagnosis"]), rows(&again));
    // Of a law with four parameters one is left.
    assert!(rows(&again).contains(&("wind".into(), 1.into())), "{again}");
}

/// A law that was changed between two results has one name, and is two laws: both are made again, and the
/// main result's is tried.
#[test]
fn two_versions_of_a_law_are_made_again_each_by_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    for (law, result) in [(WIND.to_string(), "1"), (WIND.replace("air - v", "air - 2 * v"), "2")] {
        fs::write(folder.join("wind.toml"), law).unwrap();
        let result = format!("{result}.json");
        assert_done(&smash(folder, &["reconstruct", &scene, "--with", "wind.toml", "-o", &result]));
    }
    assert_done(&smash(folder, &["report", &scene, "1.json", "2.json", "-o", "report.html"]));
    let page = data(&fs::read_to_string(folder.join("report.html")).unwrap());
    let commands: Vec<String> = serde_json::from_value(page["commands"].clone()).unwrap();
    let laws = |result: &str| {
        let result = untimed(&folder.join(result));
        result.effects.iter().map(|effect| effect.definition.clone().unwrap()).collect::<Vec<_>>()
    };
    let before = [laws("1.json"), laws("2.json")];
    type_in(folder, &commands);
    assert_eq!([laws("1.json"), laws("2.json")], before);
}
