//! Each rule of a scene, broken once: the message says where, what was found, and the mend.

use serde_json::{Value, json};
use smash::{ErrorKind, Scene};

use crate::scenes::{box_on_floor, edited, two_boxes};

/// An edit that breaks a rule, the place in the message, and words of its problem and its hint.
type Rule = (fn(&mut Value), &'static str, &'static [&'static str]);

const RULES: &[Rule] = &[
    (|s| s["schema"] = json!("smash.result/1"), "schema", &["`smash.result/1`", "smash.scene/1"]),
    (|s| s["schema"] = json!(1), "schema", &["is 1", "text in double quotes"]),
    (|s| remove(s, "schema"), "", &["`schema` is missing", "add `schema`"]),
    (|s| remove(s, "bodies"), "", &["`bodies` is missing", "add `bodies`"]),
    (|s| s["name"] = json!(["x"]), "name", &["is a list", "text in double quotes"]),
    (|s| s["name"] = json!("x".repeat(1000)), "name", &["1000 letters", "shorten"]),
    (|s| s["fps"] = json!(0), "fps", &["0.0", "frames per second"]),
    (|s| s["fps"] = json!(-60), "fps", &["-60.0", "frames per second"]),
    (|s| s["fps"] = json!(1e308), "fps", &["1e308", "frames per second"]),
    (|s| s["fps"] = json!("60"), "fps", &["\"60\"", "a number"]),
    (|s| remove(s, "fps"), "bodies[0].observations[0]", &["no `fps`", "add `fps`"]),
    (|s| s["gravity"] = json!(-9.81), "gravity", &["-9.81", "m/s²"]),
    (|s| s["gravity"] = json!(1e300), "gravity", &["1e300", "m/s²"]),
    (|s| s["up"] = json!([0, 2, 0]), "up", &["length 2", "[0, 1, 0]"]),
    (|s| s["up"] = json!([0, 0, 0]), "up", &["length 0", "length 1"]),
    (|s| s["up"] = json!([0, 1]), "up", &["a list of 2", "a list of 3"]),
    (|s| s["up"] = json!("y"), "up", &["\"y\"", "a list of 3"]),
    (
        |s| s["noise"] = json!({"position": 0, "orientation": 0.1}),
        "noise.position",
        &["0.0", "in m"],
    ),
    (
        |s| s["noise"] = json!({"position": 1, "orientation": -1}),
        "noise.orientation",
        &["-1.0", "rad"],
    ),
    (|s| s["noise"] = json!({"position": 1}), "noise", &["`orientation` is missing"]),
    (
        |s| s["bodies"][0]["observations"][1]["noise_scale"] = json!(0),
        "bodies[0].observations[1].noise_scale",
        &["0.0", "how many times as noisy"],
    ),
    (
        |s| s["camera"] = json!({"position": [0, 0, 1e9]}),
        "camera.position[2]",
        &["1000000000.0", "in m"],
    ),
    (|s| s["camera"] = json!({"centre": [0, 0, 1]}), "camera", &["`position` is missing"]),
    (|s| s["source"] = json!("a film"), "source", &["\"a film\"", "an object"]),
    (|s| s["gravitiy"] = json!(9.81), "gravitiy", &["did you mean `gravity`?"]),
    (|s| s["bodies"] = json!([]), "bodies", &["is empty", "1 or 2 dynamic"]),
    (|s| s["bodies"] = json!({}), "bodies", &["an object", "a list"]),
    (|s| push(s, 0, "c"), "bodies", &["3 dynamic and 0 static", "1 or 2 dynamic"]),
    (|s| s["bodies"][1]["name"] = json!("a"), "bodies[1].name", &["`a`", "name of its own"]),
    (|s| s["bodies"][0]["name"] = json!(""), "bodies[0].name", &["empty", "such as `a`"]),
    (|s| s["bodies"][0]["name"] = json!("\u{1b}[31m"), "bodies[0].name", &["\\u{1b}", "letters"]),
    (|s| remove(&mut s["bodies"][0], "name"), "bodies[0]", &["`name` is missing"]),
    (|s| s["bodies"][0]["heigth"] = json!(1), "bodies[0].heigth", &["did you mean `height`?"]),
    (|s| remove(&mut s["bodies"][0], "shape"), "bodies[0]", &["`shape` is missing", "add `shape`"]),
    (|s| remove(&mut s["bodies"][0], "observations"), "bodies[0]", &["`observations` is missing"]),
    (
        |s| s["bodies"][0]["height"] = json!(1),
        "bodies[0].height",
        &["out of place", "remove `height`"],
    ),
    (
        |s| s["bodies"][0]["shape"]["size"][1] = json!(-0.2),
        "bodies[0].shape.size[1]",
        &["-0.2", "above 0"],
    ),
    (
        |s| s["bodies"][0]["shape"]["size"][1] = json!("2"),
        "bodies[0].shape.size[1]",
        &["\"2\"", "a number"],
    ),
    (
        |s| s["bodies"][0]["shape"]["size"] = json!(1),
        "bodies[0].shape.size",
        &["is 1", "a list of 3"],
    ),
    (|s| s["bodies"][0]["shape"]["radius"] = json!(1), "bodies[0].shape", &["radius", "remove"]),
    (
        |s| s["bodies"][0]["shape"] = json!(["box", [1, 1, 1]]),
        "bodies[0].shape",
        &["a list", "an object"],
    ),
    (
        |s| s["bodies"][0]["shape"]["type"] = json!("bxo"),
        "bodies[0].shape.type",
        &["\"bxo\"", "`box`?"],
    ),
    (
        |s| s["bodies"][1]["shape"]["radius"] = json!(0),
        "bodies[1].shape.radius",
        &["0.0", "above 0"],
    ),
    (
        |s| remove(&mut s["bodies"][1]["shape"], "radius"),
        "bodies[1].shape",
        &["`radius` is missing"],
    ),
    (
        |s| s["bodies"][1]["observations"] = json!([]),
        "bodies",
        &["`b` has 0 observations", "annotate"],
    ),
    (|s| keep(s, 0..3), "bodies", &["`b` has 3 observations", "annotate 2 or more"]),
    (|s| apart(s), "bodies", &["no moment has 2 poses", "both sides"]),
    (|s| pose(s)["frmae"] = json!(1), "bodies[1].observations[3].frmae", &["`frame`?"]),
    (
        |s| pose(s)["orientaton"] = json!([1, 0, 0, 0]),
        "bodies[1].observations[3].orientaton",
        &["did you mean `orientation`?"],
    ),
    (
        |s| pose(s)["time"] = json!(1),
        "bodies[1].observations[3]",
        &["both `frame` and `time`", "one of them"],
    ),
    (
        |s| remove(pose(s), "frame"),
        "bodies[1].observations[3]",
        &["neither `frame` nor", "add the frame"],
    ),
    (|s| pose(s)["frame"] = json!("6"), "bodies[1].observations[3].frame", &["\"6\"", "a number"]),
    (
        |s| pose(s)["frame"] = json!(1e300),
        "bodies[1].observations[3].frame",
        &["1e300", "number the frames"],
    ),
    (|s| pose(s)["frame"] = json!(1e9), "bodies[1].observations", &["more than a day", "fps"]),
    (
        |s| pose(s)["frame"] = json!(3),
        "bodies[1].observations[5]",
        &["[3]", "another pose", "keep the right one"],
    ),
    (|s| remove(pose(s), "position"), "bodies[1].observations[3]", &["`position` is missing"]),
    (
        |s| pose(s)["position"] = json!(null),
        "bodies[1].observations[3].position",
        &["null", "a list of 3"],
    ),
    (
        |s| pose(s)["position"][2] = json!(null),
        "bodies[1].observations[3].position[2]",
        &["null", "a number"],
    ),
    (
        |s| pose(s)["position"][2] = json!(1e308),
        "bodies[1].observations[3].position[2]",
        &["1e308", "in m"],
    ),
    (
        |s| pose(s)["orientation"] = json!([0, 0, 0, 0]),
        "bodies[1].observations[3].orientation",
        &["length 0", "leave `orientation` out"],
    ),
    (
        |s| pose(s)["orientation"] = json!([1, 1, 0, 0]),
        "bodies[1].observations[3].orientation",
        &["1.414", "0.707107"],
    ),
    (
        |s| pose(s)["orientation"] = json!([1e308, 1e308, 0, 0]),
        "bodies[1].observations[3].orientation",
        &["1e308", "length 1"],
    ),
    (
        |s| pose(s)["orientation"] = json!([1, 0, 0]),
        "bodies[1].observations[3].orientation",
        &["a list of 3", "a list of 4"],
    ),
    (
        |s| *pose(s) = json!([0, [0, 0, 0]]),
        "bodies[1].observations[3]",
        &["a list of 2", "an object"],
    ),
];

const PLANE_RULES: &[Rule] = &[
    (
        |s| s["bodies"][0] = floor("ground"),
        "bodies",
        &["0 dynamic and 2 static", "1 dynamic and 1"],
    ),
    (|s| s["bodies"] = json!([floor("ground")]), "bodies", &["0 dynamic and 1 static"]),
    (|s| push(s, 0, "c"), "bodies", &["2 dynamic and 1 static"]),
    (
        |s| remove(&mut s["bodies"][1], "normal"),
        "bodies[1]",
        &["`normal` is missing", "add `normal`"],
    ),
    (
        |s| remove(&mut s["bodies"][1], "height"),
        "bodies[1]",
        &["`height` is missing", "add `height`"],
    ),
    (
        |s| s["bodies"][1]["normal"] = json!([0, 0.9, 0]),
        "bodies[1].normal",
        &["length 0.9", "[0.0"],
    ),
    (|s| s["bodies"][1]["height"] = json!(1e7), "bodies[1].height", &["10000000.0", "in m"]),
    (
        |s| s["bodies"][1]["observations"] = json!([]),
        "bodies[1].observations",
        &["doesn't move", "remove"],
    ),
    (
        |s| s["bodies"][1]["shape"] = json!({"type": "sphere", "radius": 1}),
        "bodies[1].shape",
        &["is a plane", "remove"],
    ),
    (
        |s| s["bodies"][1]["static"] = json!("yes"),
        "bodies[1].static",
        &["\"yes\"", "true or false"],
    ),
    (
        |s| s["bodies"][1]["static"] = json!(false),
        "bodies[1].normal",
        &["out of place", "remove `normal`"],
    ),
];

fn remove(value: &mut Value, field: &str) {
    value.as_object_mut().unwrap().remove(field).unwrap();
}

/// Adds a copy of a body under another name.
fn push(scene: &mut Value, index: usize, name: &str) {
    let mut copy = scene["bodies"][index].clone();
    copy["name"] = json!(name);
    scene["bodies"].as_array_mut().unwrap().push(copy);
}

/// Keeps some observations of body `b` only.
fn keep(scene: &mut Value, range: std::ops::Range<usize>) {
    let poses = scene["bodies"][1]["observations"].as_array_mut().unwrap();
    *poses = poses[range].to_vec();
}

/// Leaves `a` the poses after the collision, and `b` those before it.
fn apart(scene: &mut Value) {
    keep(scene, 0..5);
    scene["bodies"][0]["observations"].as_array_mut().unwrap().drain(..5);
}

fn pose(scene: &mut Value) -> &mut Value {
    &mut scene["bodies"][1]["observations"][3]
}

fn floor(name: &str) -> Value {
    json!({"name": name, "static": true, "normal": [0, 1, 0], "height": 0})
}

fn check(scene: fn() -> Value, rules: &[Rule]) {
    for (index, (edit, place, words)) in rules.iter().enumerate() {
        let text = edited(scene(), edit).to_string();
        let error =
            Scene::parse(&text, "broken.json").expect_err(&format!("rule {index}: {place}"));
        let message = error.to_string();
        assert_eq!(error.place().unwrap_or(""), *place, "rule {index}: {message}");
        assert_eq!(error.kind(), ErrorKind::Invalid, "{message}");
        assert!(message.starts_with("broken.json: "), "{message}");
        assert!(error.hint().is_some(), "no mend: {message}");
        for word in *words {
            assert!(message.contains(word), "rule {index}: {word:?} is not in: {message}");
        }
        assert!(message.len() < 400, "{} letters: {message}", message.len());
    }
}

#[test]
fn each_rule_says_place_value_and_mend() {
    check(two_boxes, RULES);
    check(box_on_floor, PLANE_RULES);
}

#[test]
fn scenes_in_good_order_are_accepted_without_a_warning() {
    for value in [two_boxes(), box_on_floor()] {
        let scene = Scene::parse(&value.to_string(), "good.json").unwrap();
        assert_eq!(scene.warnings(), []);
    }
}

#[test]
fn json_that_does_not_parse_names_line_and_column() {
    let cases = [
        (" ", "line 1, column 1", "is empty"),
        ("{\n \"name\": NaN}", "line 2, column 10", "`NaN` is no JSON number"),
        ("{\"gravity\": -Infinity}", "line 1, column 14", "`-Infinity` is no JSON number"),
        ("{\"gravity\": 1e999}", "line 1, column 17", "too large"),
        ("{\"name\": \"x\",\n\"name\": \"y\"}", "line 2, column 6", "`name` again"),
        ("{\"source\": {\"k\": 1, \"k\": 1}}", "line 1, column 23", "`k` again"),
        ("{\"name\": \"x\"", "line 1, column 12", "ends too early"),
        ("{} {}", "line 1, column 4", "follows the end"),
        ("{'name': 1}", "line 1, column 2", "`'name'`"),
        ("{\"a\": [1,]}", "line 1, column 10", "trailing comma"),
    ];
    for (text, place, words) in cases {
        let error = Scene::parse(text, "broken.json").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Parse, "{error}");
        assert_eq!(error.place(), Some(place), "{error}");
        assert!(error.to_string().contains(words) && error.hint().is_some(), "{error}");
    }
}

#[test]
fn deep_nesting_is_an_error_and_no_overflow() {
    let deep = format!("{}{}", "[".repeat(1_000_000), "]".repeat(1_000_000));
    let error = Scene::parse(&deep, "deep.json").unwrap_err();
    assert!(error.to_string().contains("nested deeper than 127"), "{error}");
}

#[test]
fn a_byte_order_mark_is_skipped() {
    assert!(Scene::parse(&format!("\u{feff}{}", two_boxes()), "bom.json").is_ok());
}

#[test]
fn null_is_the_same_as_leaving_an_optional_field_out() {
    let text = edited(two_boxes(), |s| pose(s)["orientation"] = json!(null)).to_string();
    let scene = Scene::parse(&text, "null.json").unwrap();
    assert_eq!(scene.bodies()[1].observations[3].world_from_body, None);
}

#[test]
fn nearly_unit_quaternions_are_normalised() {
    let text =
        edited(two_boxes(), |s| pose(s)["orientation"] = json!([1.009, 0, 0, 0])).to_string();
    let scene = Scene::parse(&text, "rounded.json").unwrap();
    let length = scene.bodies()[1].observations[3].world_from_body.unwrap().norm();
    // One division: a few units in the last place.
    assert!((length - 1.0).abs() < 1e-15, "{length}");
}

#[test]
fn the_static_body_may_come_first() {
    let text =
        edited(box_on_floor(), |s| s["bodies"].as_array_mut().unwrap().reverse()).to_string();
    let scene = Scene::parse(&text, "floor first.json").unwrap();
    assert_eq!(scene.bodies()[0].name, "a");
    assert_eq!(scene.plane().map(|plane| plane.height_m), Some(-0.1));
}

#[test]
fn more_observations_than_the_limit_are_refused() {
    let many: Vec<Value> =
        (0..100_001).map(|i| json!({"frame": i, "position": [0, 0, 0]})).collect();
    let text = edited(two_boxes(), |s| s["bodies"][0]["observations"] = json!(many)).to_string();
    let error = Scene::parse(&text, "many.json").unwrap_err();
    assert!(error.to_string().contains("100001 observations"), "{error}");
}

#[test]
fn times_that_differ_by_rounding_make_no_gap() {
    // A collision between two annotations of the same instant would divide by nothing.
    let text = edited(two_boxes(), |s| {
        for pose in s["bodies"][1]["observations"].as_array_mut().unwrap() {
            let time = pose["frame"].as_f64().unwrap() / 60.0 + 1e-12;
            remove(pose, "frame");
            pose["time"] = json!(time);
        }
    });
    let scene = Scene::parse(&text.to_string(), "rounded.json").unwrap();
    assert!(scene.gaps().iter().all(|gap| gap.end_s - gap.start_s > 1e-3), "{:?}", scene.gaps());
}

#[test]
fn a_written_scene_reads_as_the_same_scene() {
    for value in [two_boxes(), box_on_floor()] {
        let value = edited(value, |s| s["source"] = json!({"film": "x", "take": [1, {"k": null}]}));
        let scene = Scene::parse(&value.to_string(), "first.json").unwrap();
        let text = scene.to_file().to_json();
        assert_eq!(Scene::parse(&text, "second.json").unwrap(), scene);
        assert!(text.ends_with("}\n"), "no final newline");
        let poses: usize = scene.bodies().iter().map(|body| body.observations.len()).sum();
        let lines = text.lines().filter(|line| line.contains("\"position\"")).count();
        assert_eq!(lines, poses, "one observation a line");
    }
}
