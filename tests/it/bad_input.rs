//! No input, however broken, may abort, panic, hang or leave half an output: the program runs as
//! a child process on each.

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

/// A good scene with some observations of its first body.
fn observed(observations: Value) -> Vec<u8> {
    let mut scene = two_boxes();
    scene["bodies"][0]["observations"] = observations;
    scene.to_string().into_bytes()
}

fn poses(count: usize, frame: impl Fn(usize) -> Value) -> Value {
    (0..count).map(|i| json!({"frame": frame(i), "position": [i, 0, 0]})).collect()
}

/// Broken scenes, and words of the message that each must get.
fn broken_scenes() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let size = "\"size\":[0.1,0.2,0.3]";
    let up = "\"up\":[0,1,0]";
    let fps = "\"fps\":60";
    let a_name = "\"name\":\"a\"";
    let turn = "\"orientation\":[1.0,0.0,0.0,0.0]";
    let resting = |orientation: &str| {
        let pose = json!({"frame": 0, "position": [0, 0, 0], "orientation": [1.0, 0.0, 0.0, 0.0]});
        let text = String::from_utf8(observed(json!([pose]))).unwrap();
        text.replacen(turn, &format!("\"orientation\":{orientation}"), 1).into_bytes()
    };
    let deep = |open: &str, close: &str| {
        let nested = format!("{}1{}", open.repeat(10_000), close.repeat(10_000));
        with(fps, &format!("\"source\":{{\"k\":{nested}}}"))
    };
    let cut = |length: usize| two_boxes().to_string().into_bytes()[..length].to_vec();
    vec![
        // Not JSON.
        ("empty", vec![], "is empty"),
        ("blank", b" \n\t ".to_vec(), "is empty"),
        ("zeros", vec![0; 1000], "isn't JSON"),
        ("not UTF-8", vec![0xff, 0xfe, 0x7b, 0x00], "UTF-8"),
        ("prose", b"the ball flew".to_vec(), "isn't JSON"),
        ("CSV", b"frame,x,y,z\n0,1,2,3\n".to_vec(), "isn't JSON"),
        ("YAML", b"schema: smash.scene/1\n".to_vec(), "isn't JSON"),
        ("cut after a brace", cut(1), "too early"),
        ("cut within a word", cut(20), "too early"),
        ("cut in the middle", cut(500), "too early"),
        ("two objects", [cut(0), b"{} {}".to_vec()].concat(), "follows the end"),
        ("trailing comma", with(fps, "\"fps\":60,"), "isn't JSON"),
        ("comment", with(fps, "\"fps\":60 // film"), "isn't JSON"),
        ("single quotes", with(fps, "'fps':60"), "isn't JSON"),
        ("control character", with("two boxes", "two\u{1}boxes"), "control character"),
        ("lone surrogate", with("two boxes", "\\ud800"), "isn't JSON"),
        ("key twice", with(fps, "\"fps\":60,\"fps\":30"), "`fps` again"),
        ("key twice, escaped", with(fps, "\"fps\":60,\"\\u0066ps\":30"), "`fps` again"),
        (
            "key twice, of many words",
            with(fps, "\"a at line 1\":1,\"a at line 1\":1"),
            "`a at line 1` again",
        ),
        ("key twice in source", with(fps, "\"source\":{\"k\":1,\"k\":1}"), "`k` again"),
        // Deep and long.
        ("10,000 lists deep", deep("[", "]"), "nested deeper"),
        ("10,000 objects deep", deep("{\"k\":", "}"), "nested deeper"),
        ("a million brackets", vec![b'['; 1_000_000], "nested deeper"),
        ("millions of values", with("\"name\"", &millions_of_values()), "more than 5000000"),
        ("scene name of a megabyte", with("two boxes", &"n".repeat(1 << 20)), "1048576 letters"),
        ("body name of a megabyte", with(a_name, &long_field("name")), "1048576 letters"),
        (
            "field name of a megabyte",
            with(fps, &format!("\"{}\":1", "f".repeat(1 << 20))),
            "unknown field",
        ),
        ("word of a megabyte", with(fps, &long_field("fps")), "a number"),
        ("200,000 observations", observed(poses(200_000, |i| json!(i))), "200000 observations"),
        ("1e6 observations", observed(poses(1_000_000, |i| json!(i))), "more than 5000000 values"),
        (
            "number of a megabyte",
            with(fps, &format!("\"fps\":{}", "9".repeat(1 << 20))),
            "too large",
        ),
        // Wrong kinds of values.
        ("a list", b"[]".to_vec(), "an object"),
        ("null", b"null".to_vec(), "an object"),
        ("a number", b"17".to_vec(), "an object"),
        ("no fields", b"{}".to_vec(), "`schema` is missing"),
        ("another schema", with("smash.scene/1", "smash.scene/9"), "smash.scene/9"),
        ("text for a number", with(fps, "\"fps\":\"60\""), "a number"),
        ("text for a list", with(up, "\"up\":\"y\""), "a list of 3"),
        ("null for a list", with(up, "\"up\":null"), "a list of 3"),
        ("two coordinates", with(up, "\"up\":[0,1]"), "a list of 3"),
        ("four coordinates", with(up, "\"up\":[0,1,0,0]"), "a list of 3"),
        ("nested coordinates", with(up, "\"up\":[[0],[1],[0]]"), "a number"),
        ("misspelt field", with("\"gravity\"", "\"gravty\""), "did you mean `gravity`?"),
        ("unknown shape", with("\"type\":\"box\"", "\"type\":\"cone\""), "\"cone\""),
        // NaN, infinities, and numbers out of hand.
        ("NaN", with(fps, "\"fps\":NaN"), "`NaN` is no JSON number"),
        ("nan", with(up, "\"up\":[0,nan,0]"), "`nan` is no JSON number"),
        ("Infinity", with(fps, "\"fps\":Infinity"), "`Infinity`"),
        ("-Infinity", with(up, "\"up\":[0,-Infinity,0]"), "`-Infinity`"),
        ("\"NaN\"", with(fps, "\"fps\":\"NaN\""), "a number"),
        ("1e999", with(fps, "\"fps\":1e999"), "too large"),
        ("-1e999", with(up, "\"up\":[0,-1e999,0]"), "too large"),
        ("1e308 m", with(size, "\"size\":[1e308,1,1]"), "1e308"),
        ("1e308 in gravity", with("9.81", "1e308"), "1e308"),
        ("1e308 frames per second", with(fps, "\"fps\":1e308"), "1e308"),
        ("5e-324 frames per second", with(fps, "\"fps\":5e-324"), "5e-324"),
        ("1e308 in an up", with(up, "\"up\":[0,1e308,0]"), "1e308"),
        ("1e308 in a quaternion", resting("[1e308,1e308,0,0]"), "1e308"),
        (
            "noise of 1e-300",
            with(fps, "\"fps\":60,\"noise\":{\"position\":1e-300,\"orientation\":1}"),
            "1e-300",
        ),
        // Geometry.
        ("zero quaternion", resting("[0,0,0,0]"), "length 0"),
        ("long quaternion", resting("[2,0,0,0]"), "length 2"),
        ("quaternion of three", resting("[1,0,0]"), "a list of 4"),
        ("negative size", with(size, "\"size\":[0.1,-0.2,0.3]"), "-0.2"),
        ("no size", with(size, "\"size\":[0,0,0]"), "0.0"),
        ("zero up", with(up, "\"up\":[0,0,0]"), "length 0"),
        ("negative gravity", with("9.81", "-9.81"), "-9.81"),
        (
            "zero normal",
            replaced(&box_on_floor(), "\"normal\":[0,1,0]", "\"normal\":[0,0,0]"),
            "length 0",
        ),
        (
            "floor at 1e308",
            replaced(&box_on_floor(), "\"height\":-0.1", "\"height\":1e308"),
            "1e308",
        ),
        // Bodies and times.
        ("no bodies", b"{\"schema\":\"smash.scene/1\",\"bodies\":[]}".to_vec(), "is empty"),
        ("one name for two", with("\"name\":\"b\"", a_name), "name of its own"),
        ("no observations", observed(json!([])), "0 observations"),
        ("one observation", observed(poses(1, |i| json!(i))), "1 observation\n"),
        ("all on one side", observed(poses(10, |i| json!(1000 + i))), "no moment"),
        ("identical times", observed(poses(10, |_| json!(0))), "another pose"),
        (
            "ten times one pose",
            observed(json!(vec![json!({"frame": 0, "position": [0, 0, 0]}); 10])),
            "1 observation\n",
        ),
        ("no fps", with("\"fps\":60,", ""), "add `fps`"),
        (
            "frame and time",
            observed(json!([{"frame": 0, "time": 0, "position": [0, 0, 0]}])),
            "both",
        ),
        ("neither frame nor time", observed(json!([{"position": [0, 0, 0]}])), "neither"),
        ("no position", observed(json!([{"frame": 0}])), "`position` is missing"),
        ("aeons", observed(poses(10, |i| json!(i as f64 * 1e10))), "more than a day"),
    ]
}

fn long_field(name: &str) -> String {
    format!("\"{name}\":\"{}\"", "n".repeat(1 << 20))
}

fn millions_of_values() -> String {
    format!("\"source\":{{\"k\":[{}0]}},\"name\"", "0,".repeat(6_000_000))
}

#[test]
fn broken_scenes_get_one_clear_message_and_no_output() {
    let scenes = broken_scenes();
    assert!(scenes.len() >= 60, "{} scenes", scenes.len());
    for (name, bytes, words) in scenes {
        let folder = folder_with(&bytes);
        let run = smash(folder.path(), &["reconstruct", "scene.json", "-o", "result.json"]);
        let message = refusal(name, &run);
        assert!(message.contains("error: scene.json: "), "{name}: no file in {message}");
        assert!(message.contains(words), "{name}: {words:?} isn't in {message}");
        assert_eq!(names_in(&folder), [Path::new("scene.json")], "{name}: something was left");
    }
}

/// Legal, but far from any physics: a result or a message, and nothing in between.
#[test]
fn absurd_scenes_end_in_a_result_or_a_message() {
    let still = |scene: &mut Value, body: usize| {
        for pose in scene["bodies"][body]["observations"].as_array_mut().unwrap() {
            pose["position"] = json!([0, 0, 0]);
            pose["orientation"] = json!([1, 0, 0, 0]);
        }
    };
    type Edit<'a> = &'a dyn Fn(&mut Value);
    let edits: [(&str, Edit); 8] = [
        ("all at rest in one point", &|s| {
            s["gravity"] = json!(0);
            (0..2).for_each(|body| still(s, body));
        }),
        ("one at rest in the air", &|s| still(s, 1)),
        ("the world's ends", &|s| {
            for (index, pose) in
                s["bodies"][0]["observations"].as_array_mut().unwrap().iter_mut().enumerate()
            {
                pose["position"] = json!([if index % 2 == 0 { 1e6 } else { -1e6 }, 1e6, -1e6]);
            }
        }),
        ("grains", &|s| s["bodies"][0]["shape"]["size"] = json!([1e-6, 1e-6, 1e-6])),
        ("a needle of a mountain", &|s| s["bodies"][0]["shape"]["size"] = json!([1e-6, 1e4, 1e-6])),
        ("ten million frames per second", &|s| s["fps"] = json!(1e7)),
        ("a frame in a quarter of an hour", &|s| s["fps"] = json!(1e-3)),
        ("gravity of a star", &|s| s["gravity"] = json!(1e5)),
    ];
    for (name, edit) in edits {
        let mut scene = two_boxes();
        edit(&mut scene);
        let folder = folder_with(scene.to_string().as_bytes());
        let run = smash(folder.path(), &["reconstruct", "scene.json", "-o", "result.json"]);
        let stderr = &run.stderr;
        assert!(matches!(run.status.code(), Some(0 | 1)), "{name}: {}: {stderr}", run.status);
        assert!(!stderr.contains("panicked"), "{name}: {stderr}");
        let is_written = folder.path().join("result.json").exists();
        assert_eq!(is_written, run.status.success(), "{name}: {stderr}");
    }
}

#[test]
fn unreadable_inputs_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("folder")).unwrap();
    for (name, words) in [("nothing.json", "no such file"), ("folder", "directory")] {
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

#[test]
fn outputs_that_cannot_be_written_are_named() {
    let folder = folder_with(two_boxes().to_string().as_bytes());
    fs::create_dir(folder.path().join("folder")).unwrap();
    for (output, words) in [
        ("folder", "is a folder"),
        ("missing/result.json", "make the folder"),
        ("/proc/result.json", "choose another folder"),
        ("/dev/full", "space"),
    ] {
        let run = smash(folder.path(), &["reconstruct", "scene.json", "-o", output]);
        let message = refusal(output, &run);
        assert!(message.contains(output) && message.contains(words), "{message}");
    }
}

/// A reader that goes away, as `head` does, is no reason to panic.
#[test]
fn a_closed_pipe_is_an_error_and_no_panic() {
    let folder = folder_with(two_boxes().to_string().as_bytes());
    for arguments in [&["reconstruct", "scene.json", "-o", "-"][..], &["schema", "scene"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_smash"))
            .args(arguments)
            .current_dir(folder.path())
            .stdout(writer)
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}: {stderr}", output.status);
        assert!(stderr.contains("(standard output)") && !stderr.contains("panicked"), "{stderr}");
    }
}

/// What was there before stays when the input is broken.
#[test]
fn a_failed_run_leaves_the_old_output() {
    let folder = folder_with(b"{}");
    let old = folder.path().join("result.json");
    fs::write(&old, "old").unwrap();
    refusal("broken", &smash(folder.path(), &["reconstruct", "scene.json", "-o", "result.json"]));
    assert_eq!(fs::read_to_string(old).unwrap(), "old");
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

/// A result in place of the annotations it was made of: they would be lost.
#[test]
fn no_input_is_overwritten() {
    let folder = folder_of_inputs();
    let import: Vec<&str> = ["import", "poses.csv"].into_iter().chain(FALL).collect();
    let commands = [
        ("scene.json", vec!["reconstruct", "scene.json"]),
        ("spec.json", vec!["simulate", "spec.json"]),
        ("spec.json", vec!["simulate", "spec.json", "-o", "new.json", "--truth"]),
        ("poses.csv", import),
    ];
    for (input, command) in commands {
        let old = fs::read(folder.path().join(input)).unwrap();
        for prefix in ["", "./", "symbolic-", "hard-"] {
            let output = format!("{prefix}{input}");
            let option = if command.last() == Some(&"--truth") { None } else { Some("-o") };
            let arguments: Vec<&str> =
                command.iter().copied().chain(option).chain([output.as_str()]).collect();
            let message = refusal(&output, &smash(folder.path(), &arguments));
            assert!(message.contains("choose another name"), "{message}");
            assert_eq!(fs::read(folder.path().join(input)).unwrap(), old, "{arguments:?}");
            assert!(!folder.path().join("new.json").exists(), "{arguments:?}");
        }
    }
}

#[test]
fn two_outputs_do_not_share_a_file() {
    let folder = folder_of_inputs();
    symlink("new.json", folder.path().join("link.json")).unwrap();
    for truth in ["new.json", "./new.json", "link.json"] {
        let arguments = ["simulate", "spec.json", "-o", "new.json", "--truth", truth];
        let message = refusal(truth, &smash(folder.path(), &arguments));
        assert!(message.contains("choose another name"), "{message}");
        assert!(!folder.path().join("new.json").exists());
    }
    let message =
        refusal("-", &smash(folder.path(), &["simulate", "spec.json", "-o", "-", "--truth", "-"]));
    assert!(message.contains("can't share"), "{message}");
}

/// The truth can't be written: then the old scene stays too.
#[test]
fn of_two_outputs_none_changes_if_one_fails() {
    let folder = folder_of_inputs();
    fs::write(folder.path().join("old.json"), "old").unwrap();
    let arguments = ["simulate", "spec.json", "-o", "old.json", "--truth", "/dev/full"];
    let message = refusal("full", &smash(folder.path(), &arguments));
    assert!(!message.contains("nothing was changed"), "a stream may hold a part: {message}");
    assert_eq!(fs::read_to_string(folder.path().join("old.json")).unwrap(), "old");
}

/// The link stays a link, and what it leads to keeps its mode.
#[test]
fn an_output_is_written_through_a_link() {
    let folder = folder_of_inputs();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("far")).unwrap();
    fs::write(path("far/old.json"), "old").unwrap();
    fs::set_permissions(path("far/old.json"), fs::Permissions::from_mode(0o640)).unwrap();
    for target in ["far/old.json", "far/new.json"] {
        symlink(target, path("link.json")).unwrap();
        let run = smash(folder.path(), &["simulate", "spec.json", "-o", "link.json"]);
        assert!(run.status.success(), "{}", run.stderr);
        assert!(path("link.json").is_symlink());
        assert!(fs::read_to_string(path(target)).unwrap().contains("smash.scene/1"));
        fs::remove_file(path("link.json")).unwrap();
    }
    assert_eq!(fs::metadata(path("far/old.json")).unwrap().permissions().mode() & 0o777, 0o640);
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
