//! Whatever is null says why.

use serde_json::Value;
use smash::scene::{Noise, SceneFile};
use smash::simulate::{NoiseSpec, SimulationSpec, Truth};
use smash::{Reconstruction, SchemaKind, schema};

use super::{simulated, six_of_a_drop, six_of_balls, six_of_cuboids, six_poses, solved};

/// Whatever isn't known is null with a reason beside it; only a static partner's mass ratio is null
/// by nature.
#[test]
fn every_result_fits_its_schema_and_explains_its_nulls() {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Result)).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let lone = |(mut file, _): (SceneFile, Truth)| {
        file.bodies.truncate(1);
        file
    };
    let mut noisy = six_poses(SimulationSpec::random_balls(2));
    noisy.noise = NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 });
    for file in [
        six_of_cuboids(2).0,
        six_of_a_drop(0).0,
        six_of_balls(0).0,
        simulated(&noisy).0,
        lone(six_of_cuboids(2)),
        lone(six_of_balls(1)),
    ] {
        let result = solved(&file);
        let written: Value = serde_json::from_str(&result.to_json()).unwrap();
        assert_eq!(schema.validate(&written).map_err(|e| e.to_string()), Ok(()));
        let read: Reconstruction = serde_json::from_value(written.clone()).unwrap();
        assert_eq!(read, result);
        assert_eq!(
            written["mass_ratio"].is_null(),
            file.bodies.len() < 2 || written["bodies"][1].is_null()
        );
        assert_explained(&written, &result.scene);
        for field in FIELDS {
            assert!(written.get(field).is_some(), "no {field}");
        }
    }
}

/// The contract's.
const FIELDS: [&str; 14] = [
    "schema",
    "scene",
    "preset",
    "mass_ratio",
    "restitution",
    "collision_time",
    "contact_point",
    "impulse",
    "normal",
    "bodies",
    "effects",
    "fit",
    "phases",
    "flags",
];

fn assert_explained(value: &Value, place: &str) {
    match value {
        Value::Array(values) => values.iter().for_each(|v| assert_explained(v, place)),
        Value::Object(fields) => {
            for (name, value) in fields {
                let place = format!("{place}.{name}");
                let is_explained = name == "mass_ratio" || fields.contains_key("reason");
                assert!(!value.is_null() || is_explained, "{place} is null");
                assert_explained(value, &place);
            }
        }
        _ => {}
    }
}

/// What isn't measured is named in the reason, whatever else is known.
#[test]
fn unmeasured_orientations_are_the_reason_of_their_nulls() {
    let (mut file, _) = six_of_balls(0);
    file.noise = Some(Noise { position: 0.001, orientation: 0.01 });
    let result = solved(&file);
    assert!(result.fit.reduced_chi2.is_some());
    assert!(result.fit.reason.unwrap().contains("orientation"));
    let body = &result.bodies[0];
    assert_eq!((body.orientation, body.angular_velocity_before), (None, None));
    assert!(body.reason.as_ref().unwrap().contains("orientations"));
}
