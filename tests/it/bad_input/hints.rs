//! Slips of the hand, and the hint that leads out.

use super::*;

/// An exponential that grows beyond all numbers at everyday speeds.
const BOOM: &str = r#"
name = "boom"
title = "a drag that explodes"
[parameters.k]
unit = "1/s"
null = 0
bounds = [-10, 10]
[parameters.speed]
unit = "m/s"
null = 0.001
bounds = [0.001, 10]
[law]
acceleration = "k * exp(norm(v) / speed) * v"
"#;

#[test]
fn a_slip_gets_the_hint_that_leads_out() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    fs::create_dir(folder.path().join("my scenes")).unwrap();
    put("scene.json", &two_boxes().to_string());
    put("other.json", r#"{"a": 1}"#);
    put("boom.toml", BOOM);
    put("mydrag.toml", "");
    put("mylift", "");
    let made = smash(folder.path(), &["reconstruct", "scene.json", "-o", "result.json"]);
    assert!(made.status.success(), "{}", made.stderr);
    for (arguments, code, words) in [
        (&["export", "result.json", "-o", "x.glb", "--fps", "1e12"][..], 2, "to 10000000"),
        (&["export", "result.json", "-o", "x.csv", "--fps", "1e7"], 1, "300000 are the most"),
        (&["reconstruct", "my scenes"], 1, "smash batch 'my scenes' -o RESULTS"),
        (&["diagnose", "my scenes"], 1, "my scenes: is a folder\n  hint: name a file in it"),
        (&["reconstruct", "other.json"], 1, "add `schema`, here \"smash.scene/1\""),
        (&["compare", "scene.json", "other.json"], 1, "add `schema`, here \"smash.result/1\""),
        (&["effects", "check", "boom.toml"], 1, "exp(x) overflows for x above 700"),
        (&["reconstruct", "scene.json", "--with", "mydrag@a:k=1"], 1, "write ./mydrag.toml"),
        (&["reconstruct", "scene.json", "--with", "mylift"], 1, "write ./mylift"),
    ] {
        let run = smash(folder.path(), arguments);
        assert_eq!(run.status.code(), Some(code), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stdout, "", "{arguments:?}");
    }
}
