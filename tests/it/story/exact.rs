//! Scenes whose poses are exact and state no noise: what is left of them is rounding, never physics.

use smash::diagnose::Verdict;
use smash::reconstruct::RefinedOptions;
use smash::simulate::{EffectSpec, SimulationSpec};

use super::*;

fn exact(mut spec: SimulationSpec, effects: &[EffectSpec]) -> Simulation {
    spec.noise = NoiseSpec::None;
    with(spec, effects)
}

/// A force on the path alone leaves the orientations of the base model exact; one that is of both
/// doesn't.
#[test]
fn an_effect_is_found_to_rounding() {
    let hidden = [
        ("magnus@a", effect("magnus", Some("a"), &[("k", &[0.03])])),
        ("gravity_scale", effect("gravity_scale", None, &[("s", &[1.03])])),
        ("spin_drag@a", effect("spin_drag", Some("a"), &[("kappa", &[0.3])])),
    ];
    for (label, hidden) in hidden {
        let simulation = exact(boxes(1), std::slice::from_ref(&hidden));
        let scene = &simulation.scene;
        let diagnosis = smash::diagnose(scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.verdict, Verdict::Missing, "{label}: {}", diagnosis.explanation);
        assert_eq!(diagnosis.candidates[0].label(), label, "{}", diagnosis.explanation);
        assert!(!diagnosis.stays_structured, "{label}: {}", diagnosis.explanation);

        let result = fit(scene, &[label.to_string()]);
        let near = |found: f64, truth: f64| assert!((found / truth - 1.0).abs() < 1e-5, "{label}");
        near(result.mass_ratio.unwrap().value.unwrap(), simulation.truth.mass_ratio.unwrap());
        near(result.restitution.value.unwrap(), simulation.truth.restitution);
        let (name, value) = hidden.parameters.iter().next().unwrap();
        let found = result.effects[0].parameters[name].value.unwrap();
        near(found.components()[0], value.components()[0]);
    }
}

#[test]
fn nothing_is_found_where_nothing_is_hidden() {
    for spec in [boxes(2), box_on_floor(3), plain_balls(4)] {
        let scene = exact(spec, &[]).scene;
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(improvement.verdict, Verdict::NothingMissing, "{}", scene.name());
        assert!(!is_structured(&scene, &improvement.result), "{}", scene.name());
    }
}
