//! The diagnosis: on demand, of the variant that is seen.

use serde_json::{Value, json};

use super::Running;

#[test]
fn the_diagnosis_names_what_the_variant_lacks() {
    let studio = Running::of("thrown_ball_drag.json");
    let found = studio.get("api/diagnosis").json();
    assert_eq!(found["schema"], "smash.diagnosis/1");
    assert_eq!(found["verdict"], "missing");
    assert_eq!(found["candidates"][0]["effect"], "quadratic_drag");
    assert_eq!(studio.get("api/diagnosis").json(), found, "it is kept");
    studio.add("quadratic_drag@ball");
    assert_eq!(studio.get("api/diagnosis").json()["verdict"], "nothing_missing");
    studio.act(json!({"do": "undo"}));
    assert_eq!(studio.get("api/diagnosis").json(), found);
    // It goes into the report to keep.
    assert!(studio.get("api/report").body.contains("\"schema\":\"smash.diagnosis/1\""));
    assert_eq!(studio.state()["report"]["diagnosis"], json!(null));
}

/// A law of the same name and number that says something else is another candidate.
#[test]
fn a_diagnosis_is_asked_again_after_a_law_changed() {
    let law = "name = \"mine\"\n[parameters.k]\nunit = \"1/s\"\nnull = 0.0\n[law]\nacceleration = \"-k * v\"\n";
    let studio = Running::of("thrown_ball_drag.json");
    studio.act(json!({"do": "law", "text": law, "effect": "mine@ball"}));
    studio.act(json!({"do": "undo"}));
    let gain = |diagnosis: Value| {
        let candidates = diagnosis["candidates"].as_array().unwrap();
        candidates.iter().find(|one| one["effect"] == "mine").cloned().unwrap()
    };
    let first = gain(studio.get("api/diagnosis").json());
    let other = law.replace("-k * v", "-k * norm(v) * v").replace("1/s", "1/m");
    studio.act(json!({"do": "law", "text": other, "effect": "mine@ball"}));
    studio.act(json!({"do": "undo"}));
    // Not the old one in a report, either.
    assert!(!studio.get("api/report").body.contains("\"schema\":\"smash.diagnosis/1\""));
    assert_ne!(gain(studio.get("api/diagnosis").json()), first);
}

/// All else goes on.
#[test]
fn a_scene_of_too_many_poses_is_not_diagnosed() {
    let folder = tempfile::tempdir().unwrap();
    let observations: Vec<Value> = (0..40_001)
        .map(|index| {
            let time = f64::from(index) / 20_000.0 - 1.0;
            let height = if time < 0.0 { -time } else { 0.7 * time } - 0.5 * 9.81 * time * time;
            json!({"time": time, "position": [time, 0.1 + height, 0.0]})
        })
        .collect();
    let scene = json!({
        "schema": "smash.scene/1",
        "noise": {"position": 0.001, "orientation": 0.01},
        "bodies": [
            {"name": "ball", "shape": {"type": "sphere", "radius": 0.1}, "observations": observations},
            {"name": "floor", "static": true, "normal": [0, 1, 0], "height": 0},
        ],
    });
    std::fs::write(folder.path().join("long.json"), scene.to_string()).unwrap();
    let studio = Running::in_folder(folder, "long.json");
    let answer = studio.get("api/diagnosis");
    assert_eq!(answer.status, 409);
    let mend = answer.value()["error"]["mend"].clone();
    assert!(mend.as_str().unwrap().contains("every n-th"), "{mend}");
    let marked = json!({"do": "mark", "body": "ball", "observation": 0, "wrong": true});
    assert_eq!(studio.act(marked)["current"], 1);
}
