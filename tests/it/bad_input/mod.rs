//! No input, however broken, may abort, panic, hang or leave half an output: the program runs as
//! a child process on each.

mod absurd;
mod cut;
mod hints;
mod outputs;
mod scenes;

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::scenes::{box_on_floor, two_boxes};

/// Only an endless loop takes so long.
const LIMIT: Duration = Duration::from_secs(120);
/// A message is a problem and a hint: more is a flood.
const LONGEST_MESSAGE: usize = 1000;

/// What a run of the program left behind.
struct Run {
    status: ExitStatus,
    stdout: String,
    stderr: String,
}

/// Runs `smash` to its end, with its streams in files so that no pipe can fill up.
fn smash(folder: &Path, arguments: &[&str]) -> Run {
    let stream = |name: &str| folder.join(name);
    let mut child = Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(File::create(stream("stdout")).unwrap())
        .stderr(File::create(stream("stderr")).unwrap())
        .spawn()
        .unwrap();
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if start.elapsed() > LIMIT {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{arguments:?} hangs");
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let text = |name: &str| String::from_utf8_lossy(&fs::read(stream(name)).unwrap()).into_owned();
    let run = Run { status, stdout: text("stdout"), stderr: text("stderr") };
    fs::remove_file(stream("stdout")).unwrap();
    fs::remove_file(stream("stderr")).unwrap();
    run
}

/// The message of a run that must fail in good order: exit code 1 and one error that says what.
fn refusal(name: &str, run: &Run) -> String {
    let Run { status, stdout, stderr } = run;
    assert_eq!(status.code(), Some(1), "{name}: {status}: {stderr}");
    assert_eq!(stderr.matches("error: ").count(), 1, "{name}: {stderr}");
    assert!(!stderr.contains("panicked"), "{name}: {stderr}");
    assert!(stderr.contains("\n  hint: "), "{name}: no mend in {stderr}");
    assert!(stderr.len() < LONGEST_MESSAGE, "{name}: {} letters", stderr.len());
    let controls = stderr.chars().filter(|c| c.is_control() && *c != '\n').count();
    assert_eq!(controls, 0, "{name}: control characters in {stderr:?}");
    assert_eq!(stdout, "", "{name}");
    stderr.clone()
}

/// A folder that holds a scene of these bytes.
fn folder_with(bytes: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.json"), bytes).unwrap();
    folder
}

fn names_in(folder: &TempDir) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.path()).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into()).collect()
}

/// A good scene's text with one part of it replaced.
fn with(part: &str, other: &str) -> Vec<u8> {
    replaced(&two_boxes(), part, other)
}

fn replaced(scene: &Value, part: &str, other: &str) -> Vec<u8> {
    let text = scene.to_string();
    assert!(text.contains(part), "{part} isn't in {text}");
    text.replacen(part, other, 1).into_bytes()
}

const SPEC: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/boxes.spec.json");
const TABLE: &str = "time,x,y,z\n0,0,0,0.3\n0.1,0,0,0.2\n0.2,0,0,0.1\n0.3,0,0,0.2\n0.4,0,0,0.3\n";

const FALL: [&str; 6] = ["--length-unit", "m", "--up", "z", "--sphere", "ball=0.1"];

/// A folder with an input of each command, under several names.
fn folder_of_inputs() -> TempDir {
    let folder = folder_with(two_boxes().to_string().as_bytes());
    let path = |name: &str| folder.path().join(name);
    fs::copy(SPEC, path("spec.json")).unwrap();
    fs::write(path("poses.csv"), TABLE).unwrap();
    for name in ["scene.json", "spec.json", "poses.csv"] {
        symlink(name, path(&format!("symbolic-{name}"))).unwrap();
        fs::hard_link(path(name), path(&format!("hard-{name}"))).unwrap();
    }
    folder
}

#[test]
fn unreadable_inputs_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("folder")).unwrap();
    for (name, words) in [("nothing.json", "no such file"), ("folder", "is a folder")] {
        let run = smash(folder.path(), &["reconstruct", name, "-o", "result.json"]);
        let message = refusal(name, &run);
        assert!(message.contains(name) && message.contains(words), "{message}");
    }
    let secret = folder.path().join("secret.json");
    fs::write(&secret, two_boxes().to_string()).unwrap();
    fs::set_permissions(&secret, fs::Permissions::from_mode(0o000)).unwrap();
    // Root may read everything: then there is nothing to test.
    if File::open(&secret).is_err() {
        let run = smash(folder.path(), &["reconstruct", "secret.json", "-o", "result.json"]);
        assert!(refusal("unreadable", &run).contains("permission denied"));
    }
    // An endless file is cut at the limit.
    let run = smash(folder.path(), &["reconstruct", "/dev/zero", "-o", "result.json"]);
    assert!(refusal("endless", &run).contains("larger than"));
}

/// A command that is proposed can be pasted, and can work.
#[test]
fn the_next_steps_are_words_of_a_shell() {
    let folder = folder_of_inputs();
    let told = smash(folder.path(), &["simulate", "spec.json", "-o", "it's new.json"]).stdout;
    assert!(told.contains(r"smash reconstruct 'it'\''s new.json'"), "{told}");
    let by_paper = ["reconstruct", "it's new.json", "--preset", "paper"];
    let told = smash(folder.path(), &by_paper).stdout;
    assert!(told.contains(r"smash reconstruct 'it'\''s new.json' --preset"), "{told}");
    // Standard input is gone when the next command runs.
    let output = Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(["reconstruct", "-"])
        .stdin(File::open(folder.path().join("scene.json")).unwrap())
        .output()
        .unwrap();
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && !told.contains("smash reconstruct"), "{told}");
}

/// Two texts for one stream: neither is dropped in silence.
#[test]
fn json_has_no_place_beside_a_scene_on_standard_output() {
    let folder = folder_of_inputs();
    let import: Vec<&str> = ["import", "poses.csv"].into_iter().chain(FALL).collect();
    for command in [vec!["simulate", "spec.json"], import] {
        let arguments = [command, vec!["-o", "-", "--json"]].concat();
        let message = refusal("json", &smash(folder.path(), &arguments));
        assert!(message.contains("leave `--json` out"), "{message}");
    }
}

/// A negative value isn't taken for an option: it gets the message of its own rule.
#[test]
fn options_with_impossible_values_are_explained() {
    let folder = folder_of_inputs();
    let import = |more: [&'static str; 2]| {
        let command = ["import", "poses.csv", "-o", "new.json"].into_iter().chain(FALL);
        smash(folder.path(), &command.chain(more).collect::<Vec<_>>())
    };
    assert!(refusal("gravity", &import(["--gravity", "-9.81"])).contains("--gravity: -9.81"));
    assert!(refusal("fps", &import(["--fps", "-60"])).contains("--fps: -60"));
    let axis = smash(
        folder.path(),
        &["import", "poses.csv", "-o", "new.json", "--length-unit", "m", "--up", "w"],
    );
    assert_eq!(axis.status.code(), Some(2));
    assert!(axis.stderr.contains("x, y, z, -x, -y, -z"), "{}", axis.stderr);
    let seed = smash(folder.path(), &["simulate", "spec.json", "-o", "new.json", "--seed", "-1"]);
    assert_eq!(seed.status.code(), Some(2));
    assert!(seed.stderr.contains("a whole number from 0"), "{}", seed.stderr);
}

/// All that was tried stands in it: one is told how to go on without losing it.
#[test]
fn a_damaged_session_is_kept_and_the_way_on_is_told() {
    if !smash::report::has_page() {
        return;
    }
    let folder = folder_with(two_boxes().to_string().as_bytes());
    let session = folder.path().join("tried.session.json");
    for damaged in ["", "{", "{\"schema\": \"smash.session/1\"}", "[1, 2]"] {
        fs::write(&session, damaged).unwrap();
        let run = smash(
            folder.path(),
            &["studio", "scene.json", "--no-open", "--session", "tried.session.json"],
        );
        let message = refusal(damaged, &run);
        assert!(message.starts_with("error: tried.session.json: "), "{message}");
        assert!(message.contains("move it away, or give `--session OTHER`"), "{message}");
        assert_eq!(fs::read_to_string(&session).unwrap(), damaged);
    }
}
