//! Several throws, and several candidates: what must be the same, and what must not.

use std::fs;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use tempfile::TempDir;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Two throws of a ball with a hidden drag.
fn throws() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let spec = format!("{ROOT}/scenes/thrown_ball_drag.spec.json");
    for seed in ["1", "2"] {
        let scene = format!("{seed}.json");
        let made = run(&folder, &["simulate", &spec, "-o", &scene, "--seed", seed]);
        assert!(made.status.success(), "{}", stderr(&made));
    }
    folder
}

/// `2.json` after `edit` of its ball.
fn edit(folder: &TempDir, edit: impl Fn(&mut Value)) {
    let path = folder.path().join("2.json");
    let mut scene: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
    edit(&mut scene["bodies"][0]);
    fs::write(path, scene.to_string()).unwrap();
}

/// In the sentence the effect has its name; all digits stand in the commands, which need them.
#[test]
fn throws_of_one_ball_are_taken_together_without_a_word() {
    let folder = throws();
    let output = run(&folder, &["improve", "1.json", "2.json"]);
    assert_eq!((output.status.code(), stderr(&output)), (Some(0), String::new()));
    let words = String::from_utf8(output.stdout).unwrap();
    let sentence = words.lines().find(|line| line.starts_with("With ")).unwrap();
    assert!(sentence.contains("quadratic_drag@ball nothing more is missing"), "{sentence}");
    assert!(words.contains("--with quadratic_drag@ball:k=0.1"), "{words}");
}

/// Scenes of different things may be given together by mistake: it is told what differs, and where.
#[test]
fn throws_of_different_objects_are_warned_of() {
    let throws = throws();
    edit(&throws, |ball| ball["shape"]["radius"] = json!(0.06));
    let output = run(&throws, &["diagnose", "1.json", "2.json"]);
    let warning = stderr(&output);
    assert_eq!(output.status.code(), Some(0), "{warning}");
    let told =
        "warning: 2.json: `ball` is a sphere of radius 0.06 m, but in 1.json a sphere of radius";
    assert!(warning.starts_with(told) && warning.contains("\n  hint: "), "{warning}");
    edit(&throws, |ball| ball["name"] = json!("stone"));
    let warning = stderr(&run(&throws, &["improve", "1.json", "2.json"]));
    assert!(warning.starts_with("warning: 2.json: moves `stone`, but 1.json `ball`"), "{warning}");
    // A ruler's last digit is no other ball.
    let again = self::throws();
    let radius_m = |ball: &Value| ball["shape"]["radius"].as_f64().unwrap();
    edit(&again, |ball| ball["shape"]["radius"] = json!(1.005 * radius_m(ball)));
    assert_eq!(stderr(&run(&again, &["diagnose", "1.json", "2.json"])), "");
}

/// Answers tell laws by their names: two of one name would be one and the same row.
#[test]
fn candidates_of_one_name_are_refused() {
    let folder = throws();
    let law = fs::read_to_string(format!("{ROOT}/examples/effects/wind.toml")).unwrap();
    fs::write(folder.path().join("wind.toml"), &law).unwrap();
    fs::write(folder.path().join("gust.toml"), law.replace("breeze", "gust")).unwrap();
    let both = "wind.toml and gust.toml both hold a law `wind`";
    for (options, words) in [
        (&["--try", "wind.toml", "--try", "gust.toml"][..], both),
        (&["--with", "wind.toml", "--try", "gust.toml@ball"], both),
        (&["--try", "wind.toml", "--try", "wind.toml@ball"], "is a candidate already"),
        (&["--try", "magnus"], "is a candidate already"),
        (&["--try", "linear_drag@ball:k=0.3"], "goes with `--with`"),
        (&["--try", "wind.toml:k=0.1,wind=[1,0,0]"], "leaves nothing to be found"),
    ] {
        for command in ["diagnose", "improve"] {
            let output = run(&folder, &[&[command, "1.json"], options].concat());
            let message = stderr(&output);
            assert_eq!(output.status.code(), Some(1), "{options:?}: {message}");
            assert!(message.contains(words) && message.contains("\n  hint: "), "{message}");
            assert_eq!(output.stdout, b"");
        }
    }
}
