//! What was made is saved before it is answered, and opened again as it was.

use std::fs;
use std::process::Command;

use serde_json::{Value, json};

use super::Running;

const BALL: &str = "thrown_ball_drag.json";
const LAW: &str = "name = \"lift\"\n[parameters.a]\nunit = \"m/s^2\"\nnull = 0.0\n[law]\nacceleration = \"a * up\"\n";

/// A session with one of everything.
fn busy(studio: &Running) -> Value {
    studio.add("quadratic_drag@ball");
    studio.act(json!({"do": "mark", "body": "ball", "observation": 3, "wrong": true}));
    studio.act(json!({"do": "time", "body": "ball", "observation": 5, "time": 0.13}));
    studio.act(json!({"do": "undo"}));
    studio.act(json!({"do": "noise", "position": 0.002, "orientation": 0.01}));
    studio.act(json!({"do": "law", "text": LAW, "effect": "lift@ball"}));
    studio.act(json!({"do": "remove", "effect": "quadratic_drag@ball"}));
    studio.act(json!({"do": "undo"}));
    studio.act(json!({"do": "compare", "variant": 1, "shown": true}));
    studio.post("api/law", &json!({"draft": "name = \"half a la"}).to_string()).json();
    studio.state()
}

/// But for the number that only counts what happened, and where it did.
fn timeless(mut state: Value) -> Value {
    state["revision"] = Value::Null;
    state["session"] = Value::Null;
    state
}

#[test]
fn a_killed_studio_loses_nothing() {
    let studio = Running::of(BALL);
    let before = busy(&studio);
    let after = studio.again().state();
    assert_eq!(timeless(after), timeless(before));
}

/// After any act, not only at the end.
#[test]
fn each_act_is_in_the_file_when_it_is_answered() {
    let studio = Running::of(BALL);
    assert!(!studio.session_path().exists(), "nothing was tried yet");
    let saved = || -> Value {
        serde_json::from_str(&fs::read_to_string(studio.session_path()).unwrap()).unwrap()
    };
    studio.add("quadratic_drag@ball");
    assert_eq!(
        (saved()["variants"].as_array().unwrap().len(), &saved()["current"]),
        (2, &json!(1))
    );
    studio.act(json!({"do": "undo"}));
    assert_eq!((&saved()["current"], &saved()["variants"][0]["redo"]), (&json!(0), &json!(1)));
    studio.act(json!({"do": "compare", "variant": 1, "shown": true}));
    assert_eq!(saved()["compared"], json!([1]));
    studio.post("api/law", r#"{"draft": "a"}"#).json();
    assert_eq!(saved()["draft"], "a");
    // The download is the file.
    let download = studio.get("api/session");
    assert_eq!(download.body, fs::read_to_string(studio.session_path()).unwrap());
    let disposition = download.header("content-disposition").unwrap();
    assert_eq!(disposition, "attachment; filename=\"thrown_ball_drag.session.json\"");
    let left: Vec<_> = fs::read_dir(studio.folder.path()).unwrap().collect();
    assert_eq!(left.len(), 3, "a scene, a session, and its lock: {left:?}");
}

#[test]
fn a_saved_session_opens_in_another_studio_and_adds_to_one() {
    let studio = Running::of(BALL);
    let before = busy(&studio);
    let saved = studio.get("api/session").body;
    let other = Running::of(BALL);
    let opened = other.post("api/session", &saved).json();
    let but_for_the_root = |mut state: Value| {
        // The base model was fitted here, too, in a time of its own.
        state["variants"][0]["milliseconds"] = Value::Null;
        timeless(state)
    };
    assert_eq!(but_for_the_root(opened.clone()), but_for_the_root(before));
    // Again: nothing is doubled.
    let twice = other.post("api/session", &saved).json();
    assert_eq!(timeless(twice), timeless(opened.clone()));
    // What was there stays.
    let third = Running::of(BALL);
    third.add("gravity_scale");
    third.post("api/law", r#"{"draft": "mine"}"#).json();
    let both = third.post("api/session", &saved).json();
    let count = |state: &Value| state["variants"].as_array().unwrap().len();
    assert_eq!(count(&both), count(&opened) + 1);
    assert_eq!(both["variants"][1]["did"], "+ gravity_scale");
    assert_eq!(both["draft"], "mine");
    let numbers = |state: &Value| {
        let current = state["current"].as_u64().unwrap() as usize;
        state["variants"][current]["position_rmse"].clone()
    };
    assert_eq!(numbers(&both), numbers(&opened));
    assert_eq!(timeless(third.again().state()), timeless(both));
}

#[test]
fn another_scene_s_session_is_refused() {
    let studio = Running::of(BALL);
    studio.add("quadratic_drag@ball");
    let saved = studio.get("api/session").body;
    let other = Running::of("ball_on_floor.json");
    let answer = other.post("api/session", &saved);
    assert_eq!(answer.status, 409);
    let error = &answer.value()["error"];
    assert_eq!(error["place"], "scene");
    assert!(error["mend"].as_str().unwrap().contains("its own scene"), "{error}");
}

/// What was changed is told, and what to do; what changes no fit is no reason to stop.
#[test]
fn a_scene_that_was_changed_since_is_told_by_what_was_changed() {
    let studio = Running::of(BALL);
    let before = studio.add("quadratic_drag@ball");
    let folder = studio.killed();
    let path = folder.path().join(BALL);
    let own = fs::read_to_string(&path).unwrap();
    fs::write(&path, own.replace("a light ball", "another name") + "\n").unwrap();
    let same = Running::in_folder(folder, BALL);
    assert_eq!(same.state()["variants"], before["variants"]);
    let folder = same.killed();
    fs::write(&path, own.replace("9.81", "9.8").replace("0.001", "0.002")).unwrap();
    let told = Running::refusal(folder, BALL);
    assert!(told.contains("thrown_ball_drag.session.json: scene: isn't as it was"), "{told}");
    assert!(told.contains("`gravity` is 9.8, and was 9.81; `noise.position` is 0.002"), "{told}");
    assert!(told.contains("move or remove the session"), "{told}");
}

/// What an editor or a copy put there is somebody's work, too.
#[test]
fn what_another_program_saved_is_not_overwritten() {
    let studio = Running::of(BALL);
    studio.add("quadratic_drag@ball");
    let others = fs::read_to_string(studio.session_path())
        .unwrap()
        .replace("\"draft\": \"\"", "\"draft\": \"x\"");
    fs::write(studio.session_path(), &others).unwrap();
    let error = studio.refused(json!({"do": "undo"}));
    assert!(error["problem"].as_str().unwrap().contains("another program"), "{error}");
    assert_eq!(error["place"], "thrown_ball_drag.session.json");
    assert_eq!(fs::read_to_string(studio.session_path()).unwrap(), others);
    // One that was taken away is made again.
    fs::remove_file(studio.session_path()).unwrap();
    studio.act(json!({"do": "undo"}));
    assert!(studio.session_path().exists());
}

#[test]
fn an_act_that_cannot_be_saved_changes_nothing() {
    let studio = Running::of(BALL);
    studio.add("quadratic_drag@ball");
    fs::remove_file(studio.session_path()).unwrap();
    fs::create_dir(studio.session_path()).unwrap();
    let error = studio.refused(json!({"do": "undo"}));
    assert_eq!(error["place"], "thrown_ball_drag.session.json");
    assert!(error["mend"].is_string(), "{error}");
}

/// The folder is gone: which file can't be saved, and what to do.
#[test]
fn a_folder_that_is_gone_is_told() {
    let studio = Running::of(BALL);
    let moved = studio.folder.path().with_extension("moved");
    fs::rename(studio.folder.path(), &moved).unwrap();
    let error = studio.refused(json!({"do": "add", "effect": "quadratic_drag@ball"}));
    fs::rename(&moved, studio.folder.path()).unwrap();
    assert_eq!(error["place"], "thrown_ball_drag.session.json");
    assert!(error["mend"].as_str().unwrap().contains("make the folder"), "{error}");
    // It is there again: all goes on.
    studio.add("quadratic_drag@ball");
}

/// The second one says so before anything is tried in it; a killed one locks nobody out.
#[test]
fn a_session_is_open_in_one_studio() {
    let studio = Running::of(BALL);
    let told = Running::second(&studio);
    assert!(told.contains("thrown_ball_drag.session.json: is open in another studio"), "{told}");
    assert!(told.contains("--session FILE"), "{told}");
    studio.add("quadratic_drag@ball");
    assert_eq!(studio.again().state()["current"], 1);
}

/// A browser keeps things by address and port: what was typed while the studio was away is there again.
#[test]
fn a_session_has_its_own_port() {
    // Another studio may have it by chance; not thrice.
    let is_kept = |_| {
        let studio = Running::of(BALL);
        let port = studio.port;
        studio.again().port == port
    };
    assert!((0..3).any(is_kept));
}

/// Ctrl-C ends it at once, with nothing left undone.
#[test]
fn an_interrupt_ends_it_cleanly() {
    let mut studio = Running::of(BALL);
    studio.add("quadratic_drag@ball");
    let pid = studio.pid().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    assert_eq!(studio.ended(), Some(0));
    let left: Vec<_> = fs::read_dir(studio.folder.path()).unwrap().collect();
    assert_eq!(left.len(), 2, "a scene and a session: {left:?}");
}

/// Two variants of the session are one where it is opened.
#[test]
fn an_opened_session_with_doubled_siblings_starts_again() {
    let studio = Running::of(BALL);
    studio.add("quadratic_drag@ball");
    studio.act(json!({"do": "undo"}));
    studio.add("quadratic_drag@ball");
    studio.act(json!({"do": "compare", "variant": 1, "shown": true}));
    let saved = studio.get("api/session").body;
    let other = Running::of(BALL);
    other.act(json!({"do": "compare", "variant": 0, "shown": true}));
    let opened = other.post("api/session", &saved).json();
    assert_eq!((&opened["current"], &opened["compared"]), (&json!(1), &json!([])));
    assert_eq!(timeless(other.again().state()), timeless(opened));
}

/// A file with too many laws is refused when it is opened, and not by every act after that.
#[test]
fn a_session_with_too_many_laws_is_refused_at_once() {
    let studio = Running::of(BALL);
    studio.act(json!({"do": "law", "text": LAW, "effect": "lift@ball"}));
    let mut saved: Value = serde_json::from_str(&studio.get("api/session").body).unwrap();
    let variants = saved["variants"].as_array_mut().unwrap();
    for index in 2..=52 {
        let mut one = variants[1].clone();
        one["change"]["text"] = json!(LAW.replace("lift", &format!("lift_{index}")));
        one["change"]["effect"] = json!(format!("lift_{index}@ball"));
        variants.push(one);
    }
    let with = |laws: usize| {
        let mut some = saved.clone();
        some["variants"].as_array_mut().unwrap().truncate(1 + laws);
        some.to_string()
    };
    let other = Running::of(BALL);
    let error = other.post("api/session", &with(51));
    assert_eq!((error.status, &error.value()["error"]["place"]), (409, &json!("variants")));
    // As many as may be: all goes on, but for a further one.
    assert_eq!(other.post("api/session", &with(50)).status, 200);
    other.add("quadratic_drag@ball");
    let law = LAW.replace("lift", "further");
    let error = other.refused(json!({"do": "law", "text": law, "effect": "further@ball"}));
    assert_eq!(error["place"], "text");
    other
        .act(json!({"do": "law", "text": LAW.replace("a * up", "-a * up"), "effect": "lift@ball"}));
}
