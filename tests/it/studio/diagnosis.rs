//! The diagnosis: on demand, of the variant that is seen.

use serde_json::json;

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

/// An act in between is answered; the diagnosis then is of a variant that nobody looks at, and says so.
#[test]
fn acts_do_not_wait_for_a_diagnosis() {
    let studio = Running::of("boxes.json");
    std::thread::scope(|scope| {
        let asked = scope.spawn(|| studio.get("api/diagnosis"));
        while studio.add("quadratic_drag@a")["current"] != 1 {}
        let answer = asked.join().unwrap();
        assert!(matches!(answer.status, 200 | 409), "{answer:?}");
        if answer.status == 409 {
            assert_eq!(answer.value()["error"]["mend"], "ask again");
        }
    });
}
