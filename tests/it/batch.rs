//! `smash batch` as a person or a script meets it: what it leaves in its folder, and what it keeps
//! when it is started again.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, SystemTime};

use serde_json::{Value, json};
use smash::{Reconstruction, SchemaKind};
use tempfile::TempDir;

use crate::scenes::{box_on_floor, edited, two_boxes};

/// A folder that holds three scenes in `scenes/`.
fn three_scenes() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("scenes")).unwrap();
    put(&folder, "scenes/boxes.json", &two_boxes());
    put(&folder, "scenes/floor.json", &box_on_floor());
    put(&folder, "scenes/slow.json", &slow());
    folder
}

/// A scene like the other boxes, filmed slower.
fn slow() -> Value {
    edited(two_boxes(), |scene| scene["fps"] = json!(50))
}

fn put(folder: &TempDir, name: &str, scene: &Value) {
    let path = folder.path().join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, scene.to_string()).unwrap();
}

fn command(folder: &TempDir, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
    command.arg("batch").args(arguments).current_dir(folder.path()).stdin(Stdio::null());
    command
}

/// Runs a batch that may fail scenes; returns its summary and its message.
fn batch(folder: &TempDir, arguments: &[&str]) -> (Value, String) {
    let Output { status, stdout, stderr } =
        command(folder, &[arguments, &["--json"]].concat()).output().unwrap();
    let message = String::from_utf8(stderr).unwrap();
    let summary: Value = serde_json::from_slice(&stdout).expect(&message);
    let failed = summary["failed"] != json!(0);
    assert_eq!(status.code(), Some(i32::from(failed)), "{message}");
    assert_eq!(message.is_empty(), !failed, "{message}");
    (summary, message)
}

/// How many scenes were reconstructed, kept, and failed.
fn counts(summary: &Value) -> [u64; 3] {
    ["reconstructed", "kept", "failed"].map(|count| summary[count].as_u64().unwrap())
}

/// All files of a folder, with their bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    entries
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .collect()
}

fn names(folder: &Path) -> Vec<String> {
    files(folder).into_keys().collect()
}

fn rows(folder: &TempDir) -> Vec<Value> {
    let text = fs::read_to_string(folder.path().join("out/results.jsonl")).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn any_number_of_threads_writes_the_same_files() {
    let folder = three_scenes();
    let with_threads = |threads: &str| {
        let out = format!("out{threads}");
        let mut command = command(&folder, &["scenes", "-o", &out]);
        assert!(command.env("RAYON_NUM_THREADS", threads).output().unwrap().status.success());
        files(&folder.path().join(out))
    };
    let files = with_threads("1");
    let expected = [
        "boxes.result.json",
        "floor.result.json",
        "results.csv",
        "results.jsonl",
        "slow.result.json",
    ];
    assert!(files.keys().eq(expected), "{:?}", files.keys());
    for threads in ["2", "5"] {
        assert_eq!(with_threads(threads), files, "{threads} threads");
    }
}

/// A result is the one that `smash reconstruct` gives, but for the wall times.
#[test]
fn a_result_is_a_valid_file_with_the_numbers_of_a_single_run() {
    let folder = three_scenes();
    batch(&folder, &["scenes", "-o", "out", "--preset", "paper"]);
    let text = fs::read_to_string(folder.path().join("out/slow.result.json")).unwrap();
    let schema = serde_json::from_str(&smash::schema(SchemaKind::Result)).unwrap();
    jsonschema::validate(&schema, &serde_json::from_str(&text).unwrap()).unwrap();
    let from_batch: Reconstruction = serde_json::from_str(&text).unwrap();
    let scene = smash::Scene::read(folder.path().join("scenes/slow.json")).unwrap();
    let mut single = smash::reconstruct(&scene, &smash::Options::paper()).unwrap();
    for phase in &mut single.phases {
        phase.seconds = None;
    }
    assert_eq!(from_batch, single);
}

#[test]
fn the_tables_hold_a_row_for_each_scene_in_the_order_of_the_inputs() {
    let folder = three_scenes();
    fs::write(folder.path().join("broken.json"), "{").unwrap();
    batch(&folder, &["scenes/slow.json", "broken.json", "scenes", "-o", "out"]);
    let rows = rows(&folder);
    // The folder's scenes come by name; one that was named before stays where it was.
    let order: Vec<&Value> = rows.iter().map(|row| &row["name"]).collect();
    assert_eq!(order, ["slow", "broken", "boxes", "floor"]);
    let text = fs::read_to_string(folder.path().join("out/floor.result.json")).unwrap();
    let result: Reconstruction = serde_json::from_str(&text).unwrap();
    let floor = &rows[3];
    assert_eq!(floor["file"], "scenes/floor.json");
    assert_eq!(floor["status"], "done");
    assert_eq!(floor["mass_ratio"], Value::Null);
    assert_eq!(floor["restitution"], json!(result.restitution.value));
    assert_eq!(floor["collision_time"], json!(result.collision_time.value));
    assert_eq!(floor["position_rmse"], json!(result.fit.position_rmse));
    assert_eq!(floor["flags"], json!(result.flags));
    assert_eq!(rows[1]["status"], "failed");
    assert!(rows[1]["error"].as_str().unwrap().starts_with("broken.json: line 1, "), "{}", rows[1]);

    let mut csv = csv::Reader::from_path(folder.path().join("out/results.csv")).unwrap();
    let columns = csv.headers().unwrap().clone();
    assert!(columns.iter().eq(rows[0].as_object().unwrap().keys()), "{columns:?}");
    let records: Vec<csv::StringRecord> = csv.records().map(|record| record.unwrap()).collect();
    assert_eq!(records.len(), rows.len());
    for (record, row) in records.iter().zip(&rows) {
        for (column, cell) in columns.iter().zip(record) {
            match &row[column] {
                Value::Null => assert_eq!(cell, ""),
                Value::String(text) => assert_eq!(cell, text),
                Value::Number(number) => assert_eq!(cell, number.to_string()),
                flags => assert_eq!(&json!(cell.split_whitespace().collect::<Vec<_>>()), flags),
            }
        }
    }
}

/// Long ago: what still bears this date wasn't written again.
const OLD: SystemTime = SystemTime::UNIX_EPOCH;

/// The results in `out/` that were written since the last call.
fn rewritten(folder: &TempDir) -> Vec<String> {
    let out = folder.path().join("out");
    let mut names = names(&out);
    names.retain(|name| {
        let file = File::options().write(true).open(out.join(name)).unwrap();
        let is_new = file.metadata().unwrap().modified().unwrap() != OLD;
        file.set_modified(OLD).unwrap();
        is_new && name.ends_with(".result.json")
    });
    names
}

#[test]
fn a_result_is_kept_while_it_stands_for_the_scene_the_options_and_the_version() {
    let folder = three_scenes();
    let run = |options: &[&str]| {
        let (summary, _) = batch(&folder, &[&["scenes", "-o", "out"], options].concat());
        (counts(&summary), rewritten(&folder))
    };
    let all = ["boxes.result.json", "floor.result.json", "slow.result.json"];
    let result = |name: &str| folder.path().join("out").join(name);
    assert_eq!(run(&[]), ([3, 0, 0], all.map(String::from).to_vec()));
    let first = files(&folder.path().join("out"));
    assert_eq!(run(&[]), ([0, 3, 0], vec![]));
    assert_eq!(files(&folder.path().join("out")), first);

    // Another content, be it of no meaning.
    fs::write(folder.path().join("scenes/slow.json"), format!("{}\n", slow())).unwrap();
    assert_eq!(run(&[]), ([1, 2, 0], vec!["slow.result.json".into()]));
    // Another version.
    let text = fs::read_to_string(result("floor.result.json")).unwrap();
    let version = format!("\"smash\": \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(text.contains(&version));
    let older = text.replace(&version, "\"smash\": \"0.0.0\"");
    fs::write(result("floor.result.json"), older).unwrap();
    assert_eq!(run(&[]), ([1, 2, 0], vec!["floor.result.json".into()]));
    // A file that isn't whole, or isn't of a batch.
    fs::write(result("floor.result.json"), &text[..text.len() / 2]).unwrap();
    fs::write(result("boxes.result.json"), "{}").unwrap();
    let both = vec!["boxes.result.json".into(), "floor.result.json".into()];
    assert_eq!(run(&[]), ([2, 1, 0], both));
    // Other options.
    assert_eq!(run(&["--preset", "paper"]).0, [3, 0, 0]);
    let by_distance = ["--preset", "paper", "--segment-by", "distance"];
    assert_eq!(run(&by_distance).0, [0, 3, 0], "the same by another name");
}

#[test]
fn a_scene_that_fails_is_told_and_does_not_stop_the_rest() {
    let folder = three_scenes();
    let inputs = ["scenes", "-o", "out"];
    batch(&folder, &inputs);
    let broken = edited(slow(), |scene| scene["bodies"][1]["shape"]["radius"] = json!(-1));
    put(&folder, "scenes/slow.json", &broken);
    let (summary, message) = batch(&folder, &inputs);
    assert_eq!(counts(&summary), [0, 2, 1]);
    // What was there was the result of another content.
    assert!(!folder.path().join("out/slow.result.json").exists());
    let told = rows(&folder)[2]["error"].as_str().unwrap().to_owned();
    for part in ["scenes/slow.json: ", "radius", "-1", "hint: "] {
        assert!(told.contains(part), "{told}");
    }
    assert!(!told.contains('\n'), "{told}");
    assert!(message.starts_with("error: out/results.csv: 1 of 3 scenes failed"), "{message}");
    assert!(message.contains(&told), "{message}");
    // Failed scenes are tried again.
    let (summary, again) = batch(&folder, &inputs);
    assert_eq!((counts(&summary), again), ([0, 2, 1], message));
    // A file that no batch wrote isn't its to remove.
    fs::write(folder.path().join("out/slow.result.json"), "mine").unwrap();
    batch(&folder, &inputs);
    assert!(folder.path().join("out/slow.result.json").exists());
    put(&folder, "scenes/slow.json", &slow());
    assert_eq!(counts(&batch(&folder, &inputs).0), [1, 2, 0]);
}

/// A share that isn't mounted must not cost the results.
#[test]
fn a_scene_that_is_missing_fails_and_leaves_its_result() {
    let folder = three_scenes();
    let inputs = ["scenes/boxes.json", "scenes/floor.json", "-o", "out"];
    batch(&folder, &inputs);
    fs::rename(folder.path().join("scenes"), folder.path().join("away")).unwrap();
    let (summary, message) = batch(&folder, &inputs);
    assert_eq!(counts(&summary), [0, 0, 2]);
    assert!(message.contains("scenes/boxes.json: can't be read: no such file"), "{message}");
    fs::rename(folder.path().join("away"), folder.path().join("scenes")).unwrap();
    assert_eq!(counts(&batch(&folder, &inputs).0), [0, 2, 0]);
}

#[test]
fn other_json_in_a_folder_is_left_out_and_named_but_not_what_was_asked_for() {
    let folder = three_scenes();
    for (name, text) in [
        ("scenes/boxes.truth.json", r#"{"schema": "smash.truth/1"}"#),
        ("scenes/list.json", "[1, 2]"),
        ("scenes/notes.txt", "no scene"),
        // Half a file may have been a scene.
        ("scenes/torn.json", r#"{"schema": "smash.sce"#),
    ] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let (summary, message) = batch(&folder, &["scenes", "-o", "out"]);
    assert_eq!(counts(&summary), [3, 0, 1]);
    assert_eq!(summary["not_scenes"], json!(["scenes/boxes.truth.json", "scenes/list.json"]));
    assert!(message.contains("scenes/torn.json: line 1"), "{message}");
    let (summary, message) = batch(&folder, &["scenes/boxes.truth.json", "-o", "out"]);
    assert_eq!(counts(&summary), [0, 0, 1]);
    assert!(message.contains("smash.truth/1") && message.contains("smash.scene/1"), "{message}");
    let words = command(&folder, &["scenes", "-o", "out"]).output().unwrap().stdout;
    let words = String::from_utf8(words).unwrap();
    assert!(words.contains("scenes/boxes.truth.json and 1 more"), "{words}");
}

#[test]
fn scenes_of_one_name_are_told_apart_by_their_folders() {
    let folder = tempfile::tempdir().unwrap();
    put(&folder, "monday/1/scene.json", &two_boxes());
    put(&folder, "monday/2/scene.json", &box_on_floor());
    put(&folder, "friday/1/scene.json", &slow());
    let names = |inputs: &[&str]| {
        batch(&folder, &[inputs, &["-o", "out"]].concat());
        let names: Vec<String> =
            rows(&folder).iter().map(|row| row["name"].as_str().unwrap().to_owned()).collect();
        for name in &names {
            assert!(folder.path().join(format!("out/{name}.result.json")).exists(), "{name}");
        }
        names
    };
    let [first, second, third] = ["monday/1", "monday/2", "friday/1"];
    assert_eq!(names(&[first]), ["scene"]);
    assert_eq!(names(&[first, second]), ["1_scene", "2_scene"]);
    let all = names(&[first, second, third]);
    assert_eq!(all, ["monday_1_scene", "monday_2_scene", "friday_1_scene"]);
    // One file, twice named, is one scene.
    assert_eq!(names(&[first, "monday/../monday/1/scene.json"]), ["scene"]);
}

#[test]
fn names_that_can_not_be_told_apart_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    put(&folder, "scene.json", &two_boxes());
    put(&folder, "scene", &slow());
    let message = refusal(&folder, &["scene", "scene.json", "-o", "out"]);
    assert!(message.contains("scene.json: ") && message.contains("rename"), "{message}");
}

/// The message of a batch that must be refused before it writes a file.
fn refusal(folder: &TempDir, arguments: &[&str]) -> String {
    let before = all_paths(folder.path());
    let Output { status, stdout, stderr } = command(folder, arguments).output().unwrap();
    let message = String::from_utf8(stderr).unwrap();
    assert_eq!(status.code(), Some(1), "{arguments:?}: {message}");
    assert!(message.starts_with("error: ") && message.contains("\n  hint: "), "{message}");
    assert_eq!(stdout, b"");
    assert_eq!(all_paths(folder.path()), before, "{arguments:?}");
    message
}

fn all_paths(folder: &Path) -> Vec<PathBuf> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            paths.extend(all_paths(&path));
        }
        paths.push(path);
    }
    paths.sort();
    paths
}

#[test]
fn what_can_not_work_is_refused_before_the_work() {
    let folder = three_scenes();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("empty")).unwrap();
    put(&folder, "truths/a.json", &json!({"schema": "smash.truth/1"}));
    fs::write(path("file"), "").unwrap();
    for (arguments, problem) in [
        (["empty", "-o", "out"], "empty: holds no scene"),
        (["truths", "-o", "out"], "truths: holds no scene"),
        (["scenes", "-o", "file"], "file: isn't a folder"),
        (["scenes", "-o", "-"], "-: isn't a folder"),
        (["scenes", "-o", "file/out"], "file/out: can't be written"),
        (["scenes", "-o", "/proc/out"], "/proc/out: can't be written"),
        (["scenes", "-o", "/proc"], "/proc: can't be written"),
    ] {
        let message = refusal(&folder, &arguments);
        assert!(message.contains(problem), "{arguments:?}: {message}");
    }
    fs::create_dir_all(path("taken/results.csv")).unwrap();
    let message = refusal(&folder, &["scenes", "-o", "taken"]);
    assert!(message.contains("taken/results.csv: is a folder"), "{message}");
    // Beside the scenes, yes; in the place of one, no.
    fs::rename(path("scenes/slow.json"), path("scenes/boxes.result.json")).unwrap();
    let message = refusal(&folder, &["scenes", "-o", "scenes"]);
    assert!(message.contains("boxes.result.json: is an input"), "{message}");
    fs::rename(path("scenes/boxes.result.json"), path("scenes/slow.json")).unwrap();
    for expected in [[3, 0, 0], [0, 3, 0]] {
        assert_eq!(counts(&batch(&folder, &["scenes", "-o", "scenes"]).0), expected);
    }
}

#[test]
fn wrong_usage_ends_with_exit_code_2() {
    let folder = three_scenes();
    for arguments in [&["scenes"][..], &["-o", "out"], &["scenes", "-o", "out", "--preset", "none"]]
    {
        let output = command(&folder, arguments).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!folder.path().join("out").exists());
    }
}

/// The batch is stopped by a scene that it can't get past, a pipe that nobody writes to, and is
/// killed there: so it is dead at the same point in every run of this test.
#[test]
fn killed_and_started_again_it_ends_with_the_same_files() {
    let folder = three_scenes();
    let inputs = ["scenes/boxes.json", "scenes/floor.json", "scenes/slow.json"];
    let whole = [&inputs[..], &["-o", "whole"]].concat();
    batch(&folder, &whole);

    let (pipe, out) = (folder.path().join("scenes/floor.json"), folder.path().join("out"));
    fs::remove_file(&pipe).unwrap();
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let interrupted = [&inputs[..], &["-o", "out"]].concat();
    // With one thread the scenes are solved in their order.
    let mut running = command(&folder, &interrupted)
        .env("RAYON_NUM_THREADS", "1")
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    while !out.join("boxes.result.json").exists() {
        assert_eq!(running.try_wait().unwrap(), None, "it ended before it could be killed");
        std::thread::sleep(Duration::from_millis(2));
    }
    running.kill().unwrap();
    running.wait().unwrap();
    assert_eq!(names(&out), ["boxes.result.json"]);
    // What a kill in the middle of a write leaves.
    fs::write(out.join(".smash-Xy12zW.tmp"), "{\"schema\": \"smash.res").unwrap();

    fs::remove_file(&pipe).unwrap();
    put(&folder, "scenes/floor.json", &box_on_floor());
    rewritten(&folder);
    let (summary, _) = batch(&folder, &interrupted);
    assert_eq!(counts(&summary), [2, 1, 0]);
    assert_eq!(rewritten(&folder), ["floor.result.json", "slow.result.json"]);
    assert_eq!(files(&out), files(&folder.path().join("whole")));
}

/// On a terminal a line of progress is drawn and taken away. `script` of util-linux lends one;
/// elsewhere there is nothing to test.
#[test]
fn a_terminal_shows_how_many_scenes_are_done_and_the_time_left() {
    let lends_terminal = Command::new("script").arg("--version").output();
    if !lends_terminal.is_ok_and(|o| String::from_utf8_lossy(&o.stdout).contains("util-linux")) {
        return;
    }
    let folder = three_scenes();
    let line = format!("{} batch scenes -o out", env!("CARGO_BIN_EXE_smash"));
    let output = Command::new("script")
        .args(["--quiet", "--return", "--command", &line, "/dev/null"])
        .env("TERM", "xterm")
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let seen = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{seen}");
    let (_, rest) = seen.split_once(" of 3 scenes, ").expect(&seen);
    assert!(rest.contains(" left") && rest.contains("\u{1b}[2K"), "{rest:?}");
}
