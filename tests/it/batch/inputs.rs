//! Which scenes a batch takes, what it calls them, and what it refuses.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use serde_json::json;
use tempfile::TempDir;

use super::{batch, command, counts, put, rows, slow, three_scenes};
use crate::scenes::{box_on_floor, two_boxes};

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
