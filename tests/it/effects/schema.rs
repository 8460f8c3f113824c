//! The published schema of effect files, and what is read and written.

use serde_json::{Value, json};
use smash::effect::catalogue;
use smash::{SchemaKind, schema};

fn validator() -> jsonschema::Validator {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Effect)).unwrap();
    jsonschema::validator_for(&schema).unwrap()
}

#[test]
fn what_is_written_fits_the_schema() {
    for effect in catalogue() {
        let written = serde_json::to_value(effect).unwrap();
        assert_eq!(validator().validate(&written).map_err(|e| e.to_string()), Ok(()));
    }
}

#[test]
fn the_schema_refuses_what_the_reader_refuses() {
    let good = serde_json::to_value(&catalogue()[0]).unwrap();
    let edits: [fn(&mut Value); 9] = [
        |e| e["titel"] = json!("x"),
        |e| e["name"] = json!("no name"),
        |e| e["scope"] = json!("bodies"),
        |e| e["needs"] = json!(["a camera"]),
        |e| e["law"]["accelration"] = json!("-k * v"),
        |e| e["law"] = json!({}),
        |e| e["parameters"]["k"]["null"] = json!([0, 0]),
        |e| e["parameters"]["k"]["scale"] = json!(0),
        |e| e["parameters"] = json!({}),
    ];
    assert!(validator().is_valid(&good));
    for (index, edit) in edits.into_iter().enumerate() {
        let mut value = good.clone();
        edit(&mut value);
        assert!(!validator().is_valid(&value), "edit {index}");
    }
}
