//! Scenes that keep every rule and are absurd.

use super::*;

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
