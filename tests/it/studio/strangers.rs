//! Sessions from strangers: by the same checks as acts, with places and mends, whole or not at all.

use std::fs;

use serde_json::{Value, json};

use super::Running;

const BALL: &str = "thrown_ball_drag.json";

fn saved(studio: &Running) -> Value {
    studio.add("quadratic_drag@ball");
    studio.act(json!({"do": "mark", "body": "ball", "observation": 3, "wrong": true}));
    studio.get("api/session").json()
}

type Edit = fn(&mut Value);

/// What is broken, and a part of what is then said.
const CASES: [(Edit, &str, &str); 28] = [
    (|s| s["schema"] = json!("smash.session/2"), "the file", "smash.session/1"),
    (|s| s["schema"] = json!("smash.result/1"), "the file", "smash report SCENE RESULT"),
    (|s| s["extra"] = json!(1), "extra", "known here"),
    (|s| s["drafts"] = json!(""), "drafts", "did you mean `draft`?"),
    (|s| drop(s.as_object_mut().unwrap().remove("variants")), "the session", "add `variants`"),
    (|s| s["variants"] = json!([]), "variants", "the base model"),
    (|s| s["variants"] = json!({}), "variants", "a list"),
    (|s| s["current"] = json!(9), "current", "there are 0 to 2"),
    (|s| s["current"] = json!(-1), "current", "0 or more"),
    (|s| s["compared"] = json!([1, 1]), "compared[1]", "once"),
    (|s| s["compared"] = json!([2]), "compared[0]", "once"),
    (|s| s["compared"] = json!([7]), "compared[0]", "there are 0 to 2"),
    (|s| s["compared"] = json!([0, 1, 2, 0, 1, 2]), "compared", "keep 4"),
    (|s| s["draft"] = json!("x".repeat(300_000)), "draft", "a page of text"),
    (|s| s["scene"] = json!({"name": "ball", "sha256": "0"}), "scene", "its own scene"),
    (
        |s| {
            s["scene"]["sha256"] = json!("0");
            s["scene"]["content"] = json!({"bodies": [{"observations": {"checks": 1}}], "é": []});
        },
        "scene",
        "its own scene",
    ),
    (|s| s["variants"][0]["parent"] = json!(1), "variants[0]", "the first variant"),
    (|s| s["variants"][2]["parent"] = json!(2), "variants[2].parent", "before their children"),
    (|s| s["variants"][1]["parent"] = json!(null), "variants[1].parent", "only the first"),
    (|s| s["variants"][1]["change"] = json!(null), "variants[1].change", "only the first"),
    (|s| s["variants"][1]["redo"] = json!(0), "variants[1].redo", "whose `parent` it is"),
    (|s| s["variants"][1]["change"]["do"] = json!("undo"), "variants[1].change", ""),
    (
        |s| s["variants"][1]["change"]["effect"] = json!("/etc/passwd@ball"),
        "variants[1].change.effect",
        "known here",
    ),
    (
        |s| s["variants"][1]["change"]["effect"] = json!("magnus@bat"),
        "variants[1].change.effect: magnus",
        "",
    ),
    (
        |s| s["variants"][2]["change"]["observation"] = json!(999),
        "variants[2].change.observation",
        "has 0 to",
    ),
    (
        |s| s["variants"][2]["change"]["wrong"] = json!(false),
        "variants[2].change",
        "take the variant out",
    ),
    (
        |s| s["variants"][1]["numbers"]["position_rmse"] = json!(1e300),
        "variants[1].numbers.position_rmse",
        "",
    ),
    (
        |s| s["variants"][1]["numbers"]["position_rmse"] = json!("small"),
        "variants[1].numbers.position_rmse",
        "a number",
    ),
];

#[test]
fn a_broken_session_is_refused_with_its_place() {
    let studio = Running::of(BALL);
    let good = saved(&studio);
    let before = studio.state();
    for (index, (edit, place, mend)) in CASES.into_iter().enumerate() {
        let mut broken = good.clone();
        edit(&mut broken);
        let answer = studio.post("api/session", &broken.to_string());
        assert_eq!(answer.status, 409, "case {index}: {answer:?}");
        let error = answer.value()["error"].clone();
        assert_eq!(error["place"], place, "case {index}: {error}");
        let told = error["mend"].as_str().unwrap_or_default();
        assert!(told.contains(mend), "case {index}: {error}");
    }
    assert_eq!(studio.state(), before);
    assert_eq!(studio.post("api/session", &good.to_string()).status, 200);
}

/// The same from a file: the program ends with one message, and the file stays.
#[test]
fn a_broken_session_file_ends_the_program_and_stays() {
    let studio = Running::of(BALL);
    let mut broken = saved(&studio);
    broken["variants"][1]["change"]["effect"] = json!("./law.toml@ball");
    let folder = studio.killed();
    let path = folder.path().join("thrown_ball_drag.session.json");
    for (text, part) in [
        (broken.to_string(), "variants[1].change.effect"),
        ("{".to_string(), "the text ends too early"),
        (String::new(), "is empty"),
        (
            format!("{{\"schema\": \"smash.session/1\", \"x\": \"{}\"}}", "y".repeat(9 << 20)),
            "larger than",
        ),
    ] {
        fs::write(&path, &text).unwrap();
        let inner = tempfile::tempdir().unwrap();
        for entry in fs::read_dir(folder.path()).unwrap() {
            let entry = entry.unwrap();
            fs::copy(entry.path(), inner.path().join(entry.file_name())).unwrap();
        }
        let told = Running::refusal(inner, BALL);
        assert!(told.starts_with("error: thrown_ball_drag.session.json: "), "{told}");
        assert!(told.contains(part) && told.contains("hint: "), "{told}");
        assert_eq!(fs::read_to_string(&path).unwrap(), text);
    }
}

/// A law of a stranger's is held to what all laws are: it can't do anything but compute.
#[test]
fn a_stranger_s_law_is_checked_as_any() {
    let studio = Running::of(BALL);
    let good = saved(&studio);
    let with_law = |text: &str| {
        let mut session = good.clone();
        session["variants"][1]["change"] = json!({"do": "law", "text": text, "effect": "x@ball"});
        studio.post("api/session", &session.to_string())
    };
    let law = |expression: &str| {
        format!(
            "name = \"x\"\n[parameters.k]\nunit = \"1/s\"\nnull = 0.0\n[law]\nacceleration = \"{expression}\"\n"
        )
    };
    for (text, part) in [
        (law("-k * velocity"), "variants[1].change.law.acceleration"),
        (law("-k / 0 * v"), "variants[1].change.law.acceleration"),
        (law(&format!("{}k * v{}", "(".repeat(9_000), ")".repeat(9_000))), "variants[1].change"),
        (law("system('rm')"), "variants[1].change"),
        ("name = \"x\"".to_string(), "variants[1].change"),
        ("x".repeat(100_000), "variants[1].change"),
    ] {
        let answer = with_law(&text);
        assert_eq!(answer.status, 409, "{answer:?}");
        let error = answer.value()["error"].clone();
        assert!(error["place"].as_str().unwrap().starts_with(part), "{error}");
    }
    assert_eq!(with_law(&law("-k * v")).status, 200);
}

/// A name may hold anything that JSON can: it is data, and never ends the page's script.
#[test]
fn markup_in_names_stays_data() {
    let studio = Running::of(BALL);
    let folder = studio.killed();
    let path = folder.path().join(BALL);
    let scene = fs::read_to_string(&path).unwrap();
    let scene =
        scene.replace("a light ball, thrown on a floor", "</script><script>alert(1)</script>");
    fs::write(&path, scene).unwrap();
    let studio = Running::in_folder(folder, BALL);
    let page = studio.get("").body;
    assert!(page.contains("\\u003c/script>\\u003cscript>alert(1)"));
    assert!(!page.contains("<script>alert(1)"));
}
