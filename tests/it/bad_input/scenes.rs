//! Scenes that break a rule.

use super::*;

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
