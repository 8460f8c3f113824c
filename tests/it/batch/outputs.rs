//! What a batch writes, and what it shows on the way.

use std::fs;
use std::process::{Command, Stdio};

use serde_json::{Value, json};
use smash::{Reconstruction, SchemaKind};

use super::{batch, command, files, put, rows, three_scenes};
use crate::scenes::{edited, two_boxes};

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

/// A spreadsheet must not compute a name of a file; and a negative number is no text.
#[test]
fn texts_in_the_csv_table_stay_texts_and_numbers_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let early = edited(two_boxes(), |scene| {
        for body in scene["bodies"].as_array_mut().unwrap() {
            for pose in body["observations"].as_array_mut().unwrap() {
                pose["frame"] = json!(pose["frame"].as_i64().unwrap() - 60);
            }
        }
    });
    for name in ["=1+1.json", "@sum.json"] {
        put(&folder, name, &early);
    }
    fs::write(folder.path().join("-x.json"), "{").unwrap();
    // The last one fails.
    let inputs = ["-o", "out", "--", "=1+1.json", "@sum.json", "-x.json"];
    assert_eq!(command(&folder, &inputs).output().unwrap().status.code(), Some(1));
    let mut table = csv::Reader::from_path(folder.path().join("out/results.csv")).unwrap();
    let columns = table.headers().unwrap().clone();
    let place = |column: &str| columns.iter().position(|one| one == column).unwrap();
    let records: Vec<csv::StringRecord> = table.records().map(|record| record.unwrap()).collect();
    for (record, name) in records.iter().zip(["'=1+1", "'@sum", "'-x"]) {
        assert_eq!(&record[place("name")], name);
        assert_eq!(&record[place("file")], format!("{name}.json"));
    }
    let time_s: f64 = records[0][place("collision_time")].parse().unwrap();
    assert!((time_s + 1.0).abs() < 0.1, "{time_s}");
    // The other table is for programs.
    assert_eq!(rows(&folder)[0]["name"], "=1+1");
}
