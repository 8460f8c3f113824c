//! A law that came through a pipe is in no file: the commands that go on with it write one.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};

use tempfile::TempDir;

const SMASH: &str = env!("CARGO_BIN_EXE_smash");
const ROOT: &str = env!("CARGO_MANIFEST_DIR");
/// Standard input, with what else the tether must be told.
const PIPED: &str = "=-:anchor=[0.2,1.5,0],length=0.4";

/// A folder with a scene, in which a drag is hidden, and no law.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    fs::copy(format!("{ROOT}/scenes/thrown_ball_drag.json"), scene).unwrap();
    folder
}

/// What is printed by a command that reads the tether's law from standard input.
fn told(folder: &TempDir, arguments: &[&str]) -> String {
    let law = File::open(format!("{ROOT}/examples/effects/tether.toml")).unwrap();
    let mut command = Command::new(SMASH);
    let output = command.args(arguments).current_dir(folder.path()).stdin(law).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs what was printed, as it is but for the words about it, in a shell that finds this program.
fn type_in(folder: &TempDir, script: &str) -> String {
    let bin = Path::new(SMASH).parent().unwrap().display().to_string();
    let path = format!("{bin}:{}", std::env::var("PATH").unwrap());
    let mut shell = Command::new("bash");
    let shell = shell.args(["-e", "-c", script]).current_dir(folder.path()).env("PATH", path);
    let output = shell.stdin(Stdio::null()).output().unwrap();
    assert!(output.status.success(), "{script}\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn after<'a>(text: &'a str, title: &str) -> &'a str {
    text.split_once(title).unwrap_or_else(|| panic!("no {title:?} in\n{text}")).1
}

#[test]
fn each_rung_can_be_made_again() {
    let folder = folder();
    let words = told(&folder, &["improve", "scene.json", &format!("--with{PIPED}")]);
    let again = type_in(&folder, after(&words, "Each rung again\n"));
    assert_eq!(again.matches("tether@ball").count(), 2, "{again}");
    assert!(again.contains("quadratic_drag@ball"), "{again}");
    // The law is there by now: it needs no command.
    let words = told(&folder, &["improve", "scene.json", &format!("--with{PIPED}")]);
    assert!(!words.contains("printf") && words.contains("tether.toml"), "{words}");
}

#[test]
fn the_advice_of_a_diagnosis_can_be_typed() {
    let folder = folder();
    let words = told(&folder, &["diagnose", "scene.json", &format!("--with{PIPED}")]);
    let keep = after(&words, "keep the law, which no file holds: ");
    let (keep, rest) = keep.split_once("\n  add it: ").unwrap();
    let (add, _) = rest.split_once('\n').unwrap();
    let added = type_in(&folder, &format!("{keep}\n{add}"));
    assert!(added.contains("tether@ball") && added.contains("quadratic_drag@ball"), "{added}");
    // A candidate that isn't part of the advice needs no file.
    fs::remove_file(folder.path().join("tether.toml")).unwrap();
    let words = told(&folder, &["diagnose", "scene.json", &format!("--try{PIPED}")]);
    assert!(words.starts_with("quadratic_drag@ball is missing"), "{words}");
    assert!(!words.contains("keep the law"), "{words}");
}

/// Also where a file of the name that it would get says something else.
#[test]
fn the_next_steps_can_be_typed() {
    let folder = folder();
    fs::write(folder.path().join("tether.toml"), "mine").unwrap();
    let words = told(&folder, &["reconstruct", "scene.json", "--with", "-"]);
    let next = after(&words, "\nNext\n");
    let script: Vec<&str> = next
        .lines()
        .filter(|line| !line.starts_with("  look at"))
        // The words about a command stand after a gap.
        .map(|line| line.split_once("    ").map_or(line, |(command, _)| command))
        .collect();
    let again = type_in(&folder, &script.join("\n"));
    assert!(again.contains("tether@ball"), "{again}");
    assert_eq!(fs::read_to_string(folder.path().join("tether.toml")).unwrap(), "mine");
    assert!(folder.path().join("tether-2.toml").exists());
}
