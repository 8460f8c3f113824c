//! Laws of one's own: checked while they are typed, put in, changed, kept.

use serde_json::{Value, json};

use super::Running;

const TETHER: &str = include_str!("../../../examples/effects/tether.toml");
/// A law that finds the drag in the scene.
const MY_DRAG: &str = r#"name = "my_drag"
title = "A drag of my own"
[parameters.k]
unit = "1/m"
null = 0.0
bounds = [0.0, 10.0]
[law]
acceleration = "-k * norm(v) * v"
"#;

fn checked(studio: &Running, draft: &str) -> Value {
    studio.post("api/law", &json!({"draft": draft}).to_string()).json()
}

#[test]
fn a_mistake_has_its_line_and_column() {
    let studio = Running::of("boxes.json");
    // What is replaced by what, and where the mistake then is; the last line is the law.
    let cases = [
        ("* v\"", "* w\"", (8, 17, 16), "must be in m/s^2"),
        ("norm(v)", "nrom(v)", (8, 22, 4), "`nrom` is no function"),
        ("null = 0.0", "nul = 0.0", (5, 1, 9), "parameters.k.nul: is an unknown field"),
        ("\"1/m\"", "\"1/mm\"", (4, 11, 2), "`mm` is no unit"),
        ("unit = \"1/m\"", "unit = 1/m", (4, 8, 1), "isn't TOML"),
        ("[0.0, 10.0]", "[3.0, 1.0]", (6, 1, 19), "parameters.k.bounds: 3 isn't below 1"),
        ("my_drag", "quadratic_drag", (1, 1, 23), "is an effect of the catalogue"),
        ("title = ", "titel = ", (2, 1, 26), "titel: is an unknown field"),
        ("unit = \"1/m\"\n", "", (3, 13, 1), "the field `unit` is missing"),
        ("name = \"my_drag\"\n", "", (1, 1, 26), "the field `name` is missing"),
    ];
    for (from, to, place, problem) in cases {
        let draft = MY_DRAG.replace(from, to);
        let check = checked(&studio, &draft);
        let mistake = &check["mistakes"][0];
        let found = ["line", "column", "length"].map(|field| mistake[field].as_u64().unwrap());
        assert_eq!((found[0], found[1], found[2]), place, "{to}: {mistake}");
        let told = mistake["problem"].as_str().unwrap();
        assert!(told.contains(problem) && !told.contains('\n'), "{to}: {mistake}");
        assert_eq!(check["effect"], Value::Null, "{to}");
    }
}

#[test]
fn a_good_law_says_where_it_can_act() {
    let studio = Running::of("boxes.json");
    let check = checked(&studio, MY_DRAG);
    let effect = json!({"name": "my_drag", "title": "A drag of my own", "labels": ["my_drag@a", "my_drag@b"]});
    assert_eq!((&check["effect"], &check["mistakes"]), (&effect, &json!([])));
    // Typed is typed, also if it is no law yet.
    assert_eq!(studio.state()["draft"], MY_DRAG);
    assert_eq!(checked(&studio, "")["mistakes"], json!([]));
    assert_eq!(studio.state()["draft"], "");
    // Good, but not for this scene.
    let of_camera = MY_DRAG
        .replace("norm(v)", "norm(camera - p) / 1.0 * norm(v)")
        .replace("\"1/m\"", "\"1/m^2\"");
    let check = checked(&studio, &of_camera);
    assert_eq!(check["effect"], Value::Null);
    assert!(check["mistakes"][0]["problem"].as_str().unwrap().contains("camera"), "{check}");
}

#[test]
fn a_law_is_put_in_and_replaced_and_the_old_one_stays_in_its_variant() {
    let studio = Running::of("thrown_ball_drag.json");
    let first = studio.act(json!({"do": "law", "text": MY_DRAG, "effect": "my_drag@ball"}));
    assert_eq!(first["variants"][1]["did"], "+ my_drag@ball, a law of your own");
    assert_eq!(first["laws"], json!([{"name": "my_drag", "text": MY_DRAG, "labels": []}]));
    let error = |state: &Value| {
        let current = state["current"].as_u64().unwrap() as usize;
        state["variants"][current]["position_rmse"].as_f64().unwrap()
    };
    assert!(error(&first) < 1.1e-3);
    let linear = MY_DRAG.replace("norm(v) * v", "v").replace("1/m", "1/s");
    let second = studio.act(json!({"do": "law", "text": linear, "effect": "my_drag@ball"}));
    assert_eq!(second["variants"][2]["did"], "my_drag@ball by another law");
    assert_eq!(second["variants"][2]["effects"], json!(["my_drag@ball"]));
    assert_eq!(second["laws"][0]["text"], linear);
    assert!(error(&second) > error(&first));
    let undone = studio.act(json!({"do": "undo"}));
    assert_eq!((error(&undone), &undone["laws"][0]["text"]), (error(&first), &json!(MY_DRAG)));
    // Taken out, it can be added by its name, as the catalogue's can.
    let without = studio.act(json!({"do": "go", "variant": 0}));
    assert_eq!(without["laws"][0]["labels"], json!(["my_drag@ball"]));
    let added = studio.add("my_drag@ball");
    assert_eq!(added["laws"][0]["text"], linear, "the one that was written last");
    assert_eq!(error(&added), error(&second));
}

#[test]
fn a_law_that_is_none_is_refused() {
    let studio = Running::of("thrown_ball_drag.json");
    let cases = [
        (MY_DRAG.replace("norm(v)", "norm(u)"), "my_drag@ball", "law.acceleration"),
        (MY_DRAG.to_string(), "your_drag@ball", "effect"),
        (MY_DRAG.to_string(), "my_drag@bell", "effect"),
        (MY_DRAG.replace("my_drag", "magnus"), "magnus@ball", "name"),
        ("x".repeat(70_000), "x@ball", ""),
        (TETHER.replace("tether", "my law"), "my law@ball", "name"),
    ];
    for (text, effect, place) in cases {
        let error = studio.refused(json!({"do": "law", "text": text, "effect": effect}));
        assert!(
            error["place"].as_str().unwrap_or_default().starts_with(place),
            "{effect}: {error}"
        );
        assert!(error["mend"].is_string(), "{error}");
    }
}

/// Where the old one acted, the new one can't: it acts where it was asked for, and once.
#[test]
fn a_law_of_another_scope_takes_the_place_of_the_old_one() {
    let studio = Running::of("thrown_ball_drag.json");
    let of_scene = MY_DRAG.replacen("title", "scope = \"scene\"\ntitle", 1);
    studio.act(json!({"do": "law", "text": of_scene, "effect": "my_drag"}));
    let state = studio.act(json!({"do": "law", "text": MY_DRAG, "effect": "my_drag@ball"}));
    assert_eq!(state["variants"][2]["effects"], json!(["my_drag@ball"]));
    let state = studio.act(json!({"do": "law", "text": of_scene, "effect": "my_drag"}));
    assert_eq!(state["variants"][3]["effects"], json!(["my_drag"]));
}

/// Earlier versions left the old one in the model, too, and let it be taken out: it is gone already.
#[test]
fn a_session_that_takes_a_double_out_opens() {
    let studio = Running::of("thrown_ball_drag.json");
    let of_scene = MY_DRAG.replacen("title", "scope = \"scene\"\ntitle", 1);
    studio.act(json!({"do": "law", "text": of_scene, "effect": "my_drag"}));
    studio.act(json!({"do": "law", "text": MY_DRAG, "effect": "my_drag@ball"}));
    let state = studio.add("gravity_scale");
    let mut saved: Value = serde_json::from_str(&studio.get("api/session").body).unwrap();
    let variants = saved["variants"].as_array_mut().unwrap();
    let mut removed = variants[3].clone();
    removed["change"] = json!({"do": "remove", "effect": "my_drag"});
    variants.insert(3, removed);
    (variants[2]["redo"], variants[3]["redo"]) = (json!(3), json!(4));
    (variants[3]["parent"], variants[4]["parent"]) = (json!(2), json!(3));
    saved["current"] = json!(4);
    let other = Running::of("thrown_ball_drag.json");
    let opened = other.post("api/session", &saved.to_string()).json();
    assert_eq!(opened["variants"][3]["did"], "− my_drag");
    assert_eq!(opened["variants"][3]["effects"], json!(["my_drag@ball"]));
    assert_eq!(opened["report"]["models"][0]["result"], state["report"]["models"][0]["result"]);
    // What was never there can't be taken out.
    saved["variants"][3]["change"]["effect"] = json!("your_drag");
    assert_eq!(other.post("api/session", &saved.to_string()).status, 409);
}

/// What another one has typed meanwhile isn't overwritten by who doesn't know of it.
#[test]
fn a_draft_takes_the_place_of_the_one_that_it_names() {
    let studio = Running::of("thrown_ball_drag.json");
    let send = |draft: &str, known: &str| {
        let typed = json!({"draft": draft, "instead_of": known}).to_string();
        studio.post("api/law", &typed)
    };
    assert_eq!(send("a", "").status, 200);
    assert_eq!(send("ab", "a").status, 200);
    let late = send("x", "a");
    assert_eq!((late.status, &late.value()["error"]["place"]), (409, &json!("instead_of")));
    assert_eq!(studio.state()["draft"], "ab");
    // What is there already takes nobody's place.
    assert_eq!(send("ab", "whatever").status, 200);
}
