//! A result with effects needs nothing beside itself: it is read back, compared, told.

use serde_json::{Value, json};
use smash::effect::{Effect, EffectRequest};
use smash::{Reconstruction, Scene, compare};

use super::{example, fit, noisy, own, scene, with};
use crate::scenes::edited;

fn compared(scene: &Scene, result: &Reconstruction) -> smash::Comparison {
    compare(scene, &[("one".to_string(), result.clone())]).unwrap()
}

/// The law of a user's file travels in the result: the file may be gone when it is compared.
#[test]
fn a_result_carries_the_laws_of_the_users_effects() {
    let scene = noisy(1);
    for name in ["tether.toml", "thrust.toml", "coriolis.toml"] {
        let effect = Effect::read(example(name)).unwrap();
        let request =
            EffectRequest { effect: effect.clone(), body: None, fixed: Default::default() };
        let result = fit(&scene, &[request]).unwrap();
        assert_eq!(result.effects[0].definition.as_ref(), Some(&effect), "{name}");
        let read = Reconstruction::parse(&result.to_json(), "result.json").unwrap();
        assert_eq!(read, result, "{name}");
        let found = compared(&scene, &read).results[0].position_rmse.unwrap();
        let expected = result.fit.position_rmse;
        // A cord that grows taut within a step costs the integrator some of its order.
        assert!((found - expected).abs() <= 1e-4 * expected, "{name}: {found}, not {expected}");
    }
}

/// A user's effect may have a catalogue's name, and is then no less the user's.
#[test]
fn a_definition_goes_before_the_catalogue() {
    let scene = noisy(2);
    let text = "name = \"linear_drag\"\n[parameters.k]\nunit = \"m/s^2\"\nnull = 0\n\
                bounds = [-100, 100]\n[law]\nacceleration = \"k * up\"\n";
    let result = fit(&scene, &[own(text, "b")]).unwrap();
    assert!(result.effects[0].definition.is_some());
    let rmse = compared(&scene, &result).results[0].position_rmse.unwrap();
    assert!((rmse - result.fit.position_rmse).abs() <= 1e-5 * rmse);
    let mut undefined = result.clone();
    undefined.effects[0].definition = None;
    let other = compared(&scene, &undefined).results[0].position_rmse.unwrap();
    assert!((other - rmse).abs() > 1e-3 * rmse, "the catalogue's law is another");
}

/// With the effect the residuals look random where without it they don't.
#[test]
fn residuals_are_tested_with_the_effects_own_bend() {
    let scene = noisy(3);
    let result = with(&scene, &["quadratic_drag", "constant_force", "gravity_scale"]).unwrap();
    let told = &compared(&scene, &result).results[0];
    assert!(told.structure.iter().all(|channel| !channel.fails), "{:?}", told.findings);
    assert!(told.structure.iter().all(|channel| channel.p_value.is_finite()));
}

#[test]
fn results_whose_effects_cannot_be_the_scenes_are_refused() {
    let boxes = scene("boxes");
    let good = serde_json::to_value(with(&boxes, &["depth_scale@a"]).unwrap()).unwrap();
    type Case = (fn(&mut Value), &'static str, &'static str);
    let cases: [Case; 8] = [
        (|r| r["effects"][0]["name"] = json!("depth_scal"), "effects[0].name", "depth_scale"),
        (|r| r["effects"][0]["body"] = json!("c"), "effects[0].body", "`c`"),
        (|r| r["effects"][0]["parameters"] = json!({}), "effects[0].parameters.s.value", "number"),
        (
            |r| r["effects"][0]["parameters"]["s"]["value"] = json!([1, 2, 3]),
            "effects[0].parameters.s.value",
            "a number",
        ),
        (
            |r| r["effects"][0]["parameters"]["s"]["value"] = Value::Null,
            "effects[0].parameters.s.value",
            "number",
        ),
        (|r| r["effects"][0]["name"] = json!("friction"), "effects[0]", "no static body"),
        (|r| r["gravity"] = json!([0, 9.81, 0]), "gravity", "upwards"),
        (|r| r["effects"][0]["parameters"]["s"]["value"] = json!(1e99), "", ""),
    ];
    for (edit, place, word) in cases {
        let text = edited(good.clone(), edit).to_string();
        let read = Reconstruction::parse(&text, "result.json").unwrap();
        match compare(&boxes, &[("result.json".to_string(), read)]) {
            Err(error) => {
                let message = error.to_string();
                assert_eq!(error.place(), Some(place), "{message}");
                assert!(message.contains(word) && error.hint().is_some(), "{message}");
            }
            Ok(_) => assert_eq!(place, "", "no refusal of {word}"),
        }
    }
    let dark = Scene::parse(&super::scene_value("boxes").to_string(), "boxes").unwrap();
    let read = Reconstruction::parse(&good.to_string(), "result.json").unwrap();
    let error = compare(&dark, &[("result.json".to_string(), read)]).unwrap_err();
    assert!(error.to_string().contains("no camera"), "{error}");
}

/// A definition in a result is checked as a file is: an outsider's law can't do more than a file's.
#[test]
fn a_bad_definition_is_refused_when_the_result_is_read() {
    let scene = noisy(1);
    let effect = Effect::read(example("tether.toml")).unwrap();
    let request = EffectRequest { effect, body: Some("a".to_string()), fixed: Default::default() };
    let good = serde_json::to_value(fit(&scene, &[request]).unwrap()).unwrap();
    type Case = (fn(&mut Value), &'static str);
    let cases: [Case; 5] = [
        (|d| d["law"]["acceleration"] = json!("-stiffness * v"), "law.acceleration"),
        (|d| d["law"]["acceleration"] = json!("(("), "law.acceleration"),
        (|d| d["law"] = json!({}), "law"),
        (|d| d["extra"] = json!(1), "unknown field"),
        (|d| d["parameters"]["stiffness"]["null"] = json!([1, 2]), "three"),
    ];
    for (edit, word) in cases {
        let text = edited(good.clone(), |result| edit(&mut result["effects"][0]["definition"]))
            .to_string();
        let error = Reconstruction::parse(&text, "result.json").unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("result.json: effects[0].definition"), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}
