//! `smash diagnose` and `smash improve` as a person or a script meets them.

use std::fs;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

const SMASH: &str = env!("CARGO_BIN_EXE_smash");

/// With a scene in which a drag is hidden, under a name that a shell would split.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let root = env!("CARGO_MANIFEST_DIR");
    for (from, to) in [
        ("scenes/thrown_ball_drag.json", "a throw.json"),
        ("examples/effects/tether.toml", "tether.toml"),
    ] {
        fs::copy(format!("{root}/{from}"), folder.path().join(to)).unwrap();
    }
    folder
}

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(SMASH)
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

/// Runs a command that was printed.
fn typed(folder: &TempDir, line: &str) -> String {
    let path = std::path::Path::new(SMASH).parent().unwrap().display().to_string();
    let path = format!("{path}:{}", std::env::var("PATH").unwrap());
    let mut shell = Command::new("bash");
    let shell = shell.args(["-c", line]).current_dir(folder.path()).env("PATH", path);
    success(shell.output().unwrap())
}

/// The printed commands that start so.
fn commands(words: &str, start: &str) -> Vec<String> {
    let from_start = |line: &str| line.find(start).map(|at| line[at..].to_string());
    let found: Vec<String> = words.lines().filter_map(from_start).collect();
    assert!(!found.is_empty(), "{words}");
    found
}

#[test]
fn the_diagnosis_names_the_drag_and_its_commands_can_be_typed() {
    let folder = folder();
    let words = success(run(&folder, &["diagnose", "a throw.json"]));
    assert!(words.starts_with("quadratic_drag@ball is missing: Air drag"), "{words}");
    assert!(!words.contains("SCENE "), "{words}");
    // No number that isn't one.
    assert!(!words.contains("0.0e0") && !words.contains(" 0.000 "), "{words}");
    for command in commands(&words, "smash reconstruct ") {
        assert!(command.contains("'a throw.json'"), "{command}");
        assert!(typed(&folder, &command).contains("quadratic_drag@ball"));
    }
    for command in commands(&words, "smash improve ") {
        assert!(typed(&folder, &command).contains("+ quadratic_drag@ball"));
    }
}

/// What is in the model already isn't named again.
#[test]
fn with_the_drag_nothing_is_missing() {
    let folder = folder();
    let with = ["a throw.json", "--with", "quadratic_drag@ball"];
    let words = success(run(&folder, &[&["diagnose"], &with[..]].concat()));
    assert!(words.starts_with("The model explains the poses to their noise"), "{words}");
    assert!(!words.contains("quadratic_drag@ball"), "{words}");
    let words = success(run(&folder, &[&["improve"], &with[..]].concat()));
    assert!(words.contains("Nothing is missing"), "{words}");
    let again = commands(&words, "smash reconstruct ");
    assert_eq!(again, ["smash reconstruct 'a throw.json' --with quadratic_drag@ball"]);
}

/// The same data on all ways out.
#[test]
fn json_is_the_same_wherever_it_goes() {
    let folder = folder();
    for (command, schema) in [("diagnose", "smash.diagnosis/1"), ("improve", "smash.improvement/1")]
    {
        // Seconds differ from run to run.
        let timeless = |text: &str| {
            let mut value: Value = serde_json::from_str(text).unwrap();
            if let Some(phases) = value.pointer_mut("/result/phases") {
                phases.as_array_mut().unwrap().iter_mut().for_each(|p| p["seconds"] = Value::Null);
            }
            value
        };
        let printed = timeless(&success(run(&folder, &[command, "a throw.json", "--json"])));
        assert_eq!(printed["schema"], schema);
        let dashed = success(run(&folder, &[command, "a throw.json", "-o", "-"]));
        assert_eq!(timeless(&dashed), printed);
        let words = success(run(&folder, &[command, "a throw.json", "-o", "out.json"]));
        assert!(serde_json::from_str::<Value>(&words).is_err(), "words, not data: {words}");
        let file = fs::read_to_string(folder.path().join("out.json")).unwrap();
        assert_eq!(timeless(&file), printed);
    }
}

/// The fields that scripts rely on.
#[test]
fn the_contract_s_fields_are_there() {
    let folder = folder();
    let told = |command| -> Value {
        let json = success(run(&folder, &[command, "a throw.json", "--json"]));
        serde_json::from_str(&json).unwrap()
    };
    let has = |value: &Value, fields: &[&str]| {
        let object = value.as_object().unwrap();
        for field in fields {
            assert!(object.contains_key(*field), "{field} isn't in {object:?}");
        }
    };
    let diagnosis = told("diagnose");
    has(&diagnosis, &["schema", "verdict", "channels", "candidates", "explanation", "advice"]);
    assert_eq!(diagnosis["verdict"], "missing");
    has(
        &diagnosis["channels"][0],
        &["body", "segment", "channel", "rmse", "z", "p_value", "pattern"],
    );
    let best = &diagnosis["candidates"][0];
    let evidence = ["delta_chi2", "parameters_added", "p_value", "probability"];
    has(best, &["effect", "body", "parameters", "indistinguishable_from"]);
    has(best, &evidence);
    has(best, &["heldout_rmse_before", "heldout_rmse_after"]);
    has(&best["parameters"]["k"], &["value", "std", "unit"]);

    let improvement = told("improve");
    has(&improvement, &["schema", "ladder", "verdict", "result"]);
    let ladder = improvement["ladder"].as_array().unwrap();
    assert_eq!(ladder[0]["added"], Value::Null);
    assert_eq!(ladder[1]["added"], "quadratic_drag@ball");
    for rung in ladder {
        has(rung, &["added", "position_rmse", "orientation_rmse", "reduced_chi2"]);
        has(rung, &["heldout_position_rmse", "p_value"]);
    }
    assert_eq!(improvement["result"]["schema"], "smash.result/1");
    assert_eq!(improvement["result"]["effects"][0]["name"], "quadratic_drag");
}

/// A law of the user's is a candidate like the others, and is called by its file.
#[test]
fn further_candidates_are_typed_again_by_their_file() {
    let folder = folder();
    let anchored = "./tether.toml@ball:anchor=[0.2,1.5,0],length=0.4";
    let words = success(run(&folder, &["improve", "a throw.json", "--with", anchored]));
    let again = commands(&words, "smash reconstruct ");
    for command in &again {
        assert!(command.contains("--with './tether.toml@ball:anchor=[0.2,1.5,0],length=0.4'"));
        typed(&folder, command);
    }
    let words = success(run(&folder, &["diagnose", "a throw.json", "--try", anchored]));
    assert!(words.starts_with("quadratic_drag@ball is missing"), "{words}");
}

#[test]
fn what_is_broken_is_told_and_nothing_is_written() {
    let folder = folder();
    fs::write(folder.path().join("broken.json"), "{\"schema\": \"smash.scene/1\"").unwrap();
    fs::write(folder.path().join("law.toml"), "name = \"law\"\n[law]\nacceleration = \"q\"\n")
        .unwrap();
    let drag = "name = \"quadratic_drag\"\n[parameters.k]\nunit = \"1/s\"\nnull = 0.0\n\
                [law]\nacceleration = \"-k * v\"\n";
    fs::write(folder.path().join("namesake.toml"), drag).unwrap();
    fs::copy(folder.path().join("a throw.json"), folder.path().join("copy.json")).unwrap();
    let cases: [(&[&str], i32, &str); 11] = [
        (&["a throw.json", "copy.json"], 1, "hold the same poses"),
        (&["a throw.json", "--try", "./namesake.toml"], 1, "give yours another name"),
        (&["broken.json"], 1, "broken.json"),
        (&["nowhere.json"], 1, "nowhere.json"),
        (&["a throw.json", "--try", "./tehter.toml"], 1, "tehter.toml"),
        (&["a throw.json", "--try", "quadratic_darg"], 1, "did you mean `quadratic_drag`?"),
        (&["a throw.json", "--try", "./law.toml"], 1, "law.toml"),
        (&["a throw.json", "--try", "./tether.toml@bal"], 1, "ball"),
        (&["a throw.json", "--with", "quadratic_drag@bal"], 1, "ball"),
        (&["a throw.json", "--preset", "paper"], 2, "leave `--preset paper` out"),
        (&["a throw.json", "--tri", "magnus"], 2, "--try"),
    ];
    for command in ["diagnose", "improve"] {
        for (arguments, code, words) in &cases {
            let output = run(&folder, &[&[command], *arguments, &["-o", "out.json"]].concat());
            let error = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(*code), "{arguments:?}: {error}");
            assert_eq!(output.stdout, b"");
            assert!(error.contains(words), "{arguments:?}: {error}");
            assert!(!folder.path().join("out.json").exists(), "{arguments:?}");
        }
        let output = run(&folder, &[command, "a throw.json", "-o", "a throw.json"]);
        assert_eq!(output.status.code(), Some(1), "the scene isn't overwritten");
    }
}
