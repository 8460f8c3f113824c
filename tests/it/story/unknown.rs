//! Laws that the catalogue doesn't hold: no confident wrong name, and the right one once it is tried.

use smash::diagnose::Verdict;
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
