//! `smash batch` as a person or a script meets it: what it leaves in its folder, and what it keeps
//! when it is started again.

mod again;
mod inputs;
mod outputs;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
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
