//! What is kept, tried again and redone when a batch is started again.

use std::fs::{self, File};
use std::process::{Command, Stdio};
use std::time::{Duration, SystemTime};

use serde_json::json;
use tempfile::TempDir;

use super::{batch, command, counts, files, names, put, rows, slow, three_scenes};
use crate::scenes::{box_on_floor, edited};

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

/// A share that isn't mounted, or a mistyped name, is told before the work, and costs no result.
#[test]
fn a_scene_that_is_missing_is_told_and_nothing_is_done() {
    let folder = three_scenes();
    let inputs = ["scenes/boxes.json", "scenes/floor.json", "-o", "out"];
    batch(&folder, &inputs);
    let before = files(&folder.path().join("out"));
    let refused = |arguments: &[&str], words: &str| {
        let output = command(&folder, arguments).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.starts_with(words) && message.contains("\n  hint: "), "{message}");
        assert_eq!(output.stdout, b"");
    };
    refused(&["nothere", "-o", "new"], "error: nothere: isn't there\n");
    let one_of_two = ["scenes/slow.json", "scenes/sloe.json", "-o", "new"];
    refused(&one_of_two, "error: scenes/sloe.json: isn't there\n");
    refused(&["a", "b", "scenes", "-o", "new"], "error: a: isn't there, nor is b\n");
    refused(&["a", "b", "c", "-o", "new"], "error: a: isn't there, nor are 2 others\n");
    assert!(!folder.path().join("new").exists());
    fs::rename(folder.path().join("scenes"), folder.path().join("away")).unwrap();
    refused(&inputs, "error: scenes/boxes.json: isn't there, nor is scenes/floor.json\n");
    assert_eq!(files(&folder.path().join("out")), before);
    fs::rename(folder.path().join("away"), folder.path().join("scenes")).unwrap();
    assert_eq!(counts(&batch(&folder, &inputs).0), [0, 2, 0]);
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
