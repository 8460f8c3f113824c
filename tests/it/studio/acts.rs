//! Every act, what it leads to, and what is said where it can't be done.

use serde_json::{Value, json};
use smash::reconstruct::RefinedOptions;
use smash::{Options, Scene};

use super::Running;

const BALL: &str = "thrown_ball_drag.json";
const DRAG: &str = "quadratic_drag@ball";

/// A number of the current variant.
fn current<'a>(state: &'a Value, field: &str) -> &'a Value {
    &state["variants"][state["current"].as_u64().unwrap() as usize][field]
}

fn rmse(state: &Value) -> f64 {
    current(state, "position_rmse").as_f64().unwrap()
}

/// The scene's error falls to its noise, with the numbers of the command line.
#[test]
fn an_effect_is_added_as_the_command_line_does() {
    let studio = Running::of(BALL);
    let first = studio.state();
    assert_eq!(first["schema"], "smash.studio/1");
    assert_eq!(first["current"], 0);
    assert_eq!(current(&first, "did"), "base model");
    let state = studio.add(DRAG);
    assert_eq!(
        (&state["current"], &state["undo"], &state["redo"]),
        (&json!(1), &json!(0), &Value::Null)
    );
    assert_eq!(current(&state, "did"), &json!(format!("+ {DRAG}")));
    assert_eq!(current(&state, "effects"), &json!([DRAG]));
    assert!(rmse(&state) < 0.2 * rmse(&first));
    assert!(state["revision"].as_u64() > first["revision"].as_u64());
    assert_eq!(studio.get("api/revision").json(), json!({"revision": state["revision"]}));
    // The same as by `smash reconstruct`, to the last bit.
    let scene = Scene::read(studio.folder.path().join(BALL)).unwrap();
    let effect = smash::effect::EffectRequest::parse(DRAG).unwrap();
    let options = RefinedOptions { effects: vec![effect], ..RefinedOptions::default() };
    let result = smash::reconstruct(&scene, &Options::Refined(options)).unwrap();
    let base = smash::reconstruct(&scene, &Options::default()).unwrap();
    let flags = |state: &Value| state["report"]["models"][0]["result"]["flags"].clone();
    assert_eq!((flags(&first), flags(&state)), (json!(base.flags), json!(result.flags)));
    assert_eq!(flags(&first), json!(["poor_fit"]));
    assert_eq!(rmse(&state), result.fit.position_rmse);
    assert_eq!(current(&state, "restitution"), &json!(result.restitution.value));
    // The report is of this variant.
    let report = &state["report"];
    assert_eq!(report["models"][0]["name"], format!("1: {DRAG}"));
    assert_eq!(report["models"][0]["result"]["effects"][0]["name"], "quadratic_drag");
    // What can be added: not what is in the model, nor what the scene can't show.
    let of = |name: &str| {
        let mut all = state["catalogue"].as_array().unwrap().iter();
        all.find(|effect| effect["name"] == name).unwrap()["labels"].clone()
    };
    assert_eq!(of("quadratic_drag"), json!([]));
    assert_eq!(of("magnus"), json!([]), "the ball's spin isn't seen");
    assert_eq!(of("linear_drag"), json!(["linear_drag@ball"]));
    assert_eq!(of("gravity_scale"), json!(["gravity_scale"]));
    assert_eq!(of("outlier"), json!(["outlier@ball"]));
}

#[test]
fn nothing_is_deleted_by_undo_redo_and_go() {
    let studio = Running::of(BALL);
    studio.add(DRAG);
    studio.add("gravity_scale");
    let removed = studio.act(json!({"do": "remove", "effect": DRAG}));
    assert_eq!(current(&removed, "effects"), &json!(["gravity_scale"]));
    let where_to = |state: &Value| ["current", "undo", "redo"].map(|field| state[field].as_u64());
    assert_eq!(where_to(&removed), [Some(3), Some(2), None]);
    assert_eq!(where_to(&studio.act(json!({"do": "undo"}))), [Some(2), Some(1), Some(3)]);
    assert_eq!(where_to(&studio.act(json!({"do": "undo"}))), [Some(1), Some(0), Some(2)]);
    // A branch: redo leads to where one came from last.
    assert_eq!(where_to(&studio.add("gravity_tilt")), [Some(4), Some(1), None]);
    assert_eq!(where_to(&studio.act(json!({"do": "undo"}))), [Some(1), Some(0), Some(4)]);
    assert_eq!(where_to(&studio.act(json!({"do": "go", "variant": 3}))), [Some(3), Some(2), None]);
    assert_eq!(where_to(&studio.act(json!({"do": "go", "variant": 0}))), [Some(0), None, Some(1)]);
    assert_eq!(where_to(&studio.act(json!({"do": "redo"}))), [Some(1), Some(0), Some(2)]);
    assert_eq!(studio.state()["variants"].as_array().unwrap().len(), 5);
    let end = studio.act(json!({"do": "go", "variant": 0}));
    assert_eq!(studio.refused(json!({"do": "undo"}))["problem"], "this is the first variant");
    assert_eq!(end["report"]["models"][0]["name"], "0: base model");
}

#[test]
fn variants_are_shown_side_by_side() {
    let studio = Running::of(BALL);
    studio.add(DRAG);
    let state = studio.act(json!({"do": "compare", "variant": 0, "shown": true}));
    assert_eq!(state["compared"], json!([0]));
    let names = |state: &Value| -> Vec<String> {
        let models = state["report"]["models"].as_array().unwrap();
        models.iter().map(|model| model["name"].as_str().unwrap().to_string()).collect()
    };
    assert_eq!(names(&state), [format!("1: {DRAG}"), "0: base model".to_string()]);
    // Gone to, it isn't beside itself.
    let state = studio.act(json!({"do": "undo"}));
    assert_eq!((state["compared"].clone(), names(&state).len()), (json!([]), 1));
    let state = studio.act(json!({"do": "compare", "variant": 1, "shown": true}));
    let hidden = studio.act(json!({"do": "compare", "variant": 1, "shown": false}));
    assert_eq!((names(&state).len(), names(&hidden).len()), (2, 1));
}

#[test]
fn a_wrong_pose_is_left_out_of_the_fit_but_seen() {
    let studio = Running::of(BALL);
    let before = studio.add(DRAG);
    let marked = studio.act(json!({"do": "mark", "body": "ball", "observation": 7, "wrong": true}));
    assert_eq!(current(&marked, "did"), "pose 7 of ball marked wrong");
    assert_eq!(marked["edits"]["marked"], json!([{"body": "ball", "observation": 7}]));
    assert_ne!(rmse(&marked), rmse(&before));
    let poses = |state: &Value| {
        let report = &state["report"];
        let model = &report["models"][0];
        let seen = report["scene"]["bodies"][0]["observations"].as_array().unwrap().len();
        let drawn = model["series"][0]["points"].as_array().unwrap().len();
        let tested: u64 = model["residuals"]["channels"]
            .as_array()
            .unwrap()
            .iter()
            .map(|channel| channel["poses"].as_u64().unwrap())
            .sum();
        (seen, drawn, tested as usize)
    };
    let (seen, drawn, tested) = poses(&before);
    assert_eq!(poses(&marked), (seen, drawn, tested - 1));
    // Marked again it stays so, without a variant; taken back, all is as it was.
    let again = studio.act(json!({"do": "mark", "body": "ball", "observation": 7, "wrong": true}));
    assert_eq!(again["current"], marked["current"]);
    let back = studio.act(json!({"do": "mark", "body": "ball", "observation": 7, "wrong": false}));
    assert_eq!(current(&back, "did"), "pose 7 of ball taken back in");
    assert_eq!((rmse(&back), &back["edits"]), (rmse(&before), &before["edits"]));
}

#[test]
fn a_pose_moves_in_time_and_noise_is_stated() {
    let studio = Running::of(BALL);
    let before = studio.add(DRAG);
    let seen = &before["report"]["scene"]["bodies"][0]["observations"];
    let time = |index: usize| seen[index]["time"].as_f64().unwrap();
    let middle = 0.5 * (time(3) + time(4));
    let moved = studio.act(json!({"do": "time", "body": "ball", "observation": 3, "time": middle}));
    assert_eq!(
        moved["edits"]["times"],
        json!([{"body": "ball", "observation": 3, "time": middle}])
    );
    assert_eq!(moved["report"]["scene"]["bodies"][0]["observations"][3]["time"], json!(middle));
    assert_ne!(rmse(&moved), rmse(&before));
    let beyond = json!({"do": "time", "body": "ball", "observation": 3, "time": time(5)});
    let error = studio.refused(beyond);
    assert_eq!(error["place"], "time");
    assert!(error["mend"].as_str().unwrap().contains(&format!("before {} s", time(4))), "{error}");
    let back = studio.act(json!({"do": "time", "body": "ball", "observation": 3, "time": time(3)}));
    assert_eq!((rmse(&back), &back["edits"]["times"]), (rmse(&before), &json!([])));

    let noisy = studio.act(json!({"do": "noise", "position": 0.004, "orientation": 0.02}));
    let ratio =
        current(&back, "chi2").as_f64().unwrap() / current(&noisy, "chi2").as_f64().unwrap();
    assert!((ratio - 16.0).abs() < 0.1, "{ratio}");
    assert_eq!(noisy["report"]["scene"]["noise"]["position"], 0.004);
    let own = studio.act(json!({"do": "noise"}));
    assert_eq!(current(&own, "did"), "noise as in the scene");
    assert_eq!(current(&own, "chi2"), current(&before, "chi2"));
    // No orientation is measured: there is none to speak of.
    let alone = studio.act(json!({"do": "noise", "position": 0.004}));
    assert_eq!(current(&alone, "did"), "noise 4 mm");
    assert_eq!(current(&alone, "chi2"), current(&noisy, "chi2"));
    assert_eq!(studio.again().state()["edits"], alone["edits"]);
}

/// Of a pose that is as good as not there, nothing is left in the fit; its bar is in the plots.
#[test]
fn a_pose_has_a_noise_of_its_own() {
    let studio = Running::of(BALL);
    let before = studio.add(DRAG);
    let pose = json!({"do": "pose_noise", "body": "ball", "observation": 7, "scale": 1000});
    let noisy = studio.act(pose.clone());
    assert_eq!(current(&noisy, "did"), "noise of pose 7 of ball × 1000");
    assert_eq!(
        noisy["edits"]["noise_scales"],
        json!([{"body": "ball", "observation": 7, "scale": 1000.0}])
    );
    let point = |state: &Value, at: usize| {
        state["report"]["models"][0]["series"][0]["points"][at]["noise_scale"].clone()
    };
    assert_eq!((point(&noisy, 7), point(&noisy, 8)), (json!(1000.0), Value::Null));
    let restitution = |state: &Value| current(state, "restitution").as_f64().unwrap();
    let marked = json!({"do": "mark", "body": "ball", "observation": 7, "wrong": true});
    let left_out = studio.act(marked);
    let moved = (restitution(&noisy) - restitution(&before)).abs();
    assert!((restitution(&noisy) - restitution(&left_out)).abs() < 1e-3 * moved);
    studio.act(json!({"do": "undo"}));
    assert_eq!(studio.act(pose)["current"], noisy["current"], "said again it makes no variant");
    let again = studio.again();
    assert_eq!(again.state()["edits"], noisy["edits"]);
    let back = again.act(json!({"do": "pose_noise", "body": "ball", "observation": 7, "scale": 1}));
    assert_eq!((rmse(&back), &back["edits"]), (rmse(&before), &before["edits"]));
}

/// Each is refused with a place or a mend, and changes nothing.
#[test]
fn what_cannot_be_done_is_said_with_its_mend() {
    let studio = Running::of(BALL);
    studio.add(DRAG);
    let cases = [
        (json!({"do": "add", "effect": "quadratic_darg@ball"}), "did you mean `quadratic_drag`?"),
        (json!({"do": "add", "effect": DRAG}), "take it out first"),
        (json!({"do": "add", "effect": "linear_drag@bull"}), "did you mean `ball`?"),
        (json!({"do": "add", "effect": "linear_drag@ball:k=-3"}), "0 to "),
        (
            json!({"do": "add", "effect": "depth_scale@ball"}),
            "leave the effect out, or complete the scene",
        ),
        (json!({"do": "remove", "effect": "magnus@ball"}), "it has `quadratic_drag@ball`"),
        (
            json!({"do": "mark", "body": "bal", "observation": 1, "wrong": true}),
            "did you mean `ball`?",
        ),
        (json!({"do": "mark", "body": "ball", "observation": 99, "wrong": true}), "has 0 to 32"),
        (
            json!({"do": "pose_noise", "body": "ball", "observation": 1, "scale": 0}),
            "how many times as noisy",
        ),
        (json!({"do": "pose_noise", "body": "ball", "observation": 1}), "add `scale`"),
        (json!({"do": "noise", "orientation": 0.01}), "give both"),
        (json!({"do": "noise", "position": 0, "orientation": 1}), "above 0"),
        (json!({"do": "go", "variant": 17}), "there are 0 to 1"),
        (json!({"do": "redo"}), "choose a variant of the tree"),
        (json!({"do": "compare", "variant": 2, "shown": true}), "there are 0 to 1"),
        (json!({"do": "frobnicate"}), "known here: `add`"),
        (json!({"do": "add"}), "add `effect`"),
        (json!({"do": "undo", "variant": 1}), "leave `variant` out"),
        (json!({"do": "go", "variant": -1}), "0 or more"),
        (json!({"do": "go", "variant": "x"}), "0 or more"),
        (json!([1]), "an object"),
    ];
    for (action, mend) in cases {
        let error = studio.refused(action.clone());
        let told = error["mend"].as_str().unwrap_or_default();
        assert!(told.contains(mend), "{action}: {error}");
    }
    let error = Running::of("boxes.json").refused(json!({"do": "noise", "position": 0.001}));
    assert!(error["mend"].as_str().unwrap().contains("give both"), "{error}");
    // So many that too few are left for a collision.
    let last = (0..40).find_map(|observation| {
        let action =
            json!({"do": "mark", "body": "ball", "observation": observation, "wrong": true});
        let answer = studio.post("api/act", &action.to_string());
        (answer.status != 200).then(|| answer.value())
    });
    assert!(last.unwrap()["error"]["problem"].as_str().unwrap().contains("observation"));
}

/// No act opens a file: names are of the catalogue, or of the session's own laws.
#[test]
fn no_act_reads_a_file() {
    let studio = Running::of(BALL);
    let law = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/effects/tether.toml");
    let own = studio.folder.path().join("law.toml");
    std::fs::copy(law, &own).unwrap();
    for name in [law, "law.toml", "./law.toml", "-", "/etc/passwd", own.to_str().unwrap()] {
        let error = studio.refused(json!({"do": "add", "effect": format!("{name}@ball")}));
        assert!(error["problem"].as_str().unwrap().contains("there is no effect"), "{error}");
        assert!(!error["mend"].as_str().unwrap().contains("to read a file"), "{error}");
    }
}
