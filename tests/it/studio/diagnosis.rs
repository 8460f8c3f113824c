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
