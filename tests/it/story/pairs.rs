//! Two effects at once.

use smash::diagnose::Verdict;
use smash::reconstruct::RefinedOptions;
use smash::simulate::EffectSpec;

use super::*;

/// Pairs that are told here.
const PAIRS: f64 = 3.0;

/// Every fifth frame.
fn sparse(seed: u64) -> SimulationSpec {
    let regular = RegularSampling { interval: 5, frame_count: 90, gap: Some(5) };
    SimulationSpec { observations: Sampling::Regular(regular), ..boxes(seed) }
}

fn tell(spec: SimulationSpec, hidden: &[EffectSpec; 2]) {
    let simulation = with(spec, hidden);
    let scene = &simulation.scene;
    let what = format!("{} and {}", hidden[0].name, hidden[1].name);
    let improvement = smash::improve(scene, &RefinedOptions::default(), &[]).unwrap();
    let added = &last(&improvement).with;
    assert_eq!(improvement.verdict, Verdict::Missing, "{what}: {added:?}");
    let mut found = names(added);
    found.sort();
    let mut wanted: Vec<&str> = hidden.iter().map(|one| one.name.as_str()).collect();
    wanted.sort();
    assert_eq!(found, wanted, "{:?} dropped", improvement.dropped);
    assert!(is_in_band(&improvement.result, PAIRS), "{what}: {:?}", improvement.result.fit);
    assert_down_to_the_noise(scene, &improvement, &what);
    assert_right(&simulation, &improvement.result, &what);
    assert_replayed(scene, &improvement, &what);
}

/// The best single one isn't taken for all.
#[test]
fn a_diagnosis_says_that_it_is_not_alone() {
    let offset = effect("time_offset", Some("b"), &[("delay", &[0.02])]);
    let simulation = with(sparse(1), &[offset, effect("gravity_scale", None, &[("s", &[0.96])])]);
    let diagnosis = smash::diagnose(&simulation.scene, &RefinedOptions::default(), &[]).unwrap();
    assert!(diagnosis.explanation.contains("It isn't alone"), "{}", diagnosis.explanation);
}

#[test]
fn a_clock_and_a_wrong_scale() {
    let offset = effect("time_offset", Some("b"), &[("delay", &[0.02])]);
    tell(sparse(1), &[offset, effect("gravity_scale", None, &[("s", &[0.96])])]);
}

#[test]
#[ignore = "half a minute: run it after a change of the search"]
fn drag_on_the_path_of_one_and_on_the_spin_of_the_other() {
    let drag = effect("quadratic_drag", Some("b"), &[("k", &[0.3])]);
    tell(boxes(4), &[drag, effect("spin_drag", Some("a"), &[("kappa", &[0.4])])]);
}

#[test]
fn a_tilt_and_a_wrong_pose() {
    let time_s = stamp_s(&sparse(1), 0, 4);
    let tilt = effect("gravity_tilt", None, &[("tilt1", &[0.08]), ("tilt2", &[-0.05])]);
    let outlier = effect(
        "outlier",
        Some("a"),
        &[("time", &[time_s]), ("shift", &[0.0, 0.04, 0.03]), ("turn", &[0.0, 0.0, 0.0])],
    );
    tell(sparse(1), &[tilt, outlier]);
}
