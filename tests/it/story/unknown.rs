//! Laws that the catalogue doesn't hold: no confident wrong name, and the right one once it is tried.

use smash::diagnose::Verdict;
use smash::effect::Effect;
use smash::reconstruct::RefinedOptions;
use smash::simulate::{EffectSpec, SimulationSpec};

use super::*;

/// Laws that are told here.
const LAWS: f64 = 3.0;

fn example(name: &str) -> String {
    format!("{}/examples/effects/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// `known`: what is typed after the file's path.
fn tell(spec: SimulationSpec, hidden: EffectSpec, known: &str) {
    let simulation = with(spec, std::slice::from_ref(&hidden));
    let scene = &simulation.scene;
    let base = RefinedOptions::default();
    let diagnosis = smash::diagnose(scene, &base, &[]).unwrap();
    let told = &diagnosis.explanation;
    match diagnosis.verdict {
        Verdict::UnknownEffect => {}
        Verdict::Missing => {
            assert!(diagnosis.stays_structured || !diagnosis.other_laws.is_empty(), "{told}");
        }
        Verdict::NothingMissing => panic!("{told}"),
    }

    let typed = format!("{}{known}", hidden.name);
    let result = fit(scene, std::slice::from_ref(&typed));
    assert!(is_in_band(&result, LAWS), "{typed}: {:?}", result.fit);
    assert_right(&simulation, &result, &typed);

    let further = requests(&[typed]);
    let improvement = smash::improve(scene, &base, &further).unwrap();
    assert_eq!(names(&last(&improvement).with), [&further[0].effect.name]);
    assert!(is_in_band(&improvement.result, LAWS), "{:?}", improvement.result.fit);
}

/// The cord is slack on one side of the collision.
#[test]
fn a_tether() {
    let anchor: &[f64] = &[0.3, 2.2, -0.4];
    let tether = effect(
        &example("tether"),
        Some("a"),
        &[("stiffness", &[12.0]), ("length", &[0.9]), ("anchor", anchor)],
    );
    tell(boxes(3), tether, "@a:anchor=[0.3,2.2,-0.4]");
}

#[test]
fn a_frame_that_turns() {
    let coriolis = effect(&example("coriolis"), None, &[("turning", &[0.3, 0.5, -0.2])]);
    tell(boxes(3), coriolis, "");
}

#[test]
fn a_rocket() {
    let thrust = effect(&example("thrust"), Some("a"), &[("thrust", &[1.0, 0.5, -0.8])]);
    tell(boxes(3), thrust, "@a");
}

/// The model without it is bent far: sizes that slopes foretell would be of that, and what the bend does to the
/// other body would look like a force on it.
#[test]
fn a_strong_rocket_is_told_with_its_thrust() {
    let thrust = [4.0, -3.0, 5.0];
    let hidden = effect(&example("thrust"), Some("a"), &[("thrust", &thrust)]);
    let scene = with(boxes(4), &[hidden]).scene;
    let base = RefinedOptions::default();
    let diagnosis = smash::diagnose(&scene, &base, &[]).unwrap();
    let told = &diagnosis.explanation;
    assert_eq!(diagnosis.verdict, Verdict::UnknownEffect, "{told}");
    assert!(diagnosis.reduced_chi2.unwrap() > 10.0 && diagnosis.unexplained.is_empty(), "{told}");
    let law = &diagnosis.other_laws[0];
    assert!(!law.leaves_more && law.effect.body.as_deref() == Some("a"), "{told}");
    let force = &law.effect.parameters["f"];
    let (value, std) = (force.value.as_ref().unwrap(), force.std.as_ref().unwrap());
    // One of some 16 000 such numbers is farther off.
    for ((value, std), truth) in value.components().iter().zip(std.components()).zip(thrust) {
        assert!((value - truth).abs() < 4.0 * std, "{value} ± {std}, not {truth}");
    }
    assert!(diagnosis.advice.iter().any(|line| line.contains("--with ./like_a_thrust.toml@a")));

    // Effects of the catalogue would but imitate it.
    let improvement = smash::improve(&scene, &base, &[]).unwrap();
    assert_eq!((improvement.ladder.len(), improvement.other_laws.len()), (1, 1));
    // As the advice has it kept in a file.
    let effect = law.effect.definition.clone().unwrap();
    let kept = Effect::parse(&effect.to_toml(), "like_a_thrust.toml").unwrap();
    let request =
        EffectRequest { effect: kept, body: law.effect.body.clone(), fixed: BTreeMap::new() };
    let options = RefinedOptions { effects: vec![request], ..base };
    let improvement = smash::improve(&scene, &options, &[]).unwrap();
    assert_eq!(improvement.verdict, Verdict::NothingMissing);
    assert!(is_in_band(&improvement.result, LAWS), "{:?}", improvement.result.fit);
}

/// Nothing is missing from the physics: one body's quaternions are in another order.
#[test]
fn a_scene_that_is_misread_in_part_is_told_to_be_checked() {
    let file = simulate(&boxes(5)).unwrap().scene_file.to_json();
    let mut scene: Value = serde_json::from_str(&file).unwrap();
    for pose in scene["bodies"][0]["observations"].as_array_mut().unwrap() {
        pose["orientation"].as_array_mut().unwrap().rotate_left(1);
    }
    let scene = Scene::parse(&scene.to_string(), "misread").unwrap();
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(diagnosis.advice[0], smash::diagnose::MISREAD, "{:?}", diagnosis.advice);
}
