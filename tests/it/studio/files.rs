//! Schemas of what the studio writes and says.

use serde_json::{Value, json};
use smash::{SchemaKind, schema};

use super::Running;

fn assert_fits(kind: SchemaKind, value: &Value) {
    let schema: Value = serde_json::from_str(&schema(kind)).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    assert_eq!(validator.validate(value).map_err(|error| error.to_string()), Ok(()));
}

#[test]
fn the_page_s_schema_is_that_of_the_types() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/web/schemas/studio.json");
    let kept = std::fs::read_to_string(path).unwrap();
    let mend = "write it anew: smash schema studio -o web/schemas/studio.json";
    assert!(kept == schema(SchemaKind::Studio), "{mend}");
}

#[test]
fn state_and_session_fit_their_schemas() {
    let studio = Running::of("boxes.json");
    studio.add("quadratic_drag@a");
    studio.act(json!({"do": "mark", "body": "b", "observation": 2, "wrong": true}));
    studio.act(json!({"do": "noise", "position": 0.003, "orientation": 0.01}));
    studio.act(json!({"do": "pose_noise", "body": "a", "observation": 1, "scale": 3}));
    studio.act(json!({"do": "compare", "variant": 1, "shown": true}));
    assert_fits(SchemaKind::Studio, &studio.state());
    assert_fits(SchemaKind::Session, &studio.get("api/session").json());
}

/// The page, and the report to keep, hold the same data as the API.
#[test]
fn pages_carry_their_data() {
    let studio = Running::of("thrown_ball_drag.json");
    let state = studio.add("quadratic_drag@ball");
    let data = |page: &str| -> Value {
        let start = page.find("id=\"smash-data\"").unwrap();
        let start = start + page[start..].find('>').unwrap() + 1;
        let end = start + page[start..].find("</script>").unwrap();
        serde_json::from_str(&page[start..end]).unwrap()
    };
    let page = studio.get("");
    assert_eq!(page.header("content-type"), Some("text/html; charset=utf-8"));
    assert_eq!(data(&page.body), state);
    let report = studio.get("api/report");
    let disposition = report.header("content-disposition").unwrap();
    assert_eq!(disposition, "attachment; filename=\"thrown_ball_drag.report.html\"");
    assert_eq!(data(&report.body), state["report"]);
    let command = state["report"]["commands"][0].as_str().unwrap();
    assert_eq!(
        command,
        "smash studio thrown_ball_drag.json --session thrown_ball_drag.session.json"
    );
}
