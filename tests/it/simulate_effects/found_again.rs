//! The reconstruction finds each effect again.

use super::*;

/// What one is told with noise-free poses: the effect's parameters come back, and with them the
/// collision, for each effect of the catalogue.
#[test]
fn each_effect_is_found_again() {
    let mut pair = SimulationSpec::random_cuboids(1);
    pair.observations = every_third();
    pair.camera = Some(Camera { position: [0.5, 1.0, 5.0], more: serde_json::Map::new() });
    let mut drop = SimulationSpec::random_box_drop(2);
    drop.observations = every_third();
    let frame = |spec: &SimulationSpec, body: usize, index: usize| {
        let simulation = simulate(spec).unwrap();
        simulation.scene.bodies()[body].observations[index].time_s
    };
    let (early, gap) = (frame(&pair, 1, 4), frame(&pair, 0, 20) + 0.02);
    let offset = Vector3::new(0.012, -0.02, 0.015);
    let cases = [
        (&pair, effect("linear_drag", Some("b"), &[("k", &[0.3])])),
        (&pair, effect("quadratic_drag", Some("a"), &[("k", &[0.15])])),
        (&pair, effect("magnus", Some("a"), &[("k", &[0.02])])),
        (&pair, effect("constant_force", Some("b"), &[("a", &[0.4, 0.0, -0.3])])),
        (&pair, effect("gravity_scale", None, &[("s", &[0.96])])),
        (&pair, effect("gravity_tilt", None, &[("tilt1", &[0.08]), ("tilt2", &[-0.05])])),
        (&pair, effect("spin_drag", Some("a"), &[("kappa", &[0.3])])),
        (&pair, effect("inertia", Some("a"), &[("factor", &[1.2, 0.9, 1.1])])),
        (&pair, loading(offset)),
        (&drop, effect("friction", None, &[("mu", &[0.06])])),
        (&pair, effect("external_impulse", Some("b"), &[("P", &[0.1, 0.15, -0.1])])),
        (&pair, effect("torsional_impulse", None, &[("M", &[0.004])])),
        (
            &pair,
            effect(
                "second_impact",
                Some("a"),
                &[("time", &[gap]), ("impulse", &[0.3, 0.2, 0.1]), ("spin", &[0.004, 0.0, 0.002])],
            ),
        ),
        (
            &pair,
            effect(
                "outlier",
                Some("b"),
                &[("time", &[early]), ("shift", &[0.05, -0.03, 0.0]), ("turn", &[0.2, 0.0, 0.1])],
            ),
        ),
        (&pair, effect("time_offset", Some("b"), &[("delay", &[0.02])])),
        (&pair, effect("depth_scale", Some("b"), &[("s", &[1.03])])),
    ];
    for (spec, effect) in cases {
        let is_loaded = effect.name == "com_offset";
        let spec = if is_loaded { loaded(spec.clone(), offset) } else { spec.clone() };
        let simulation = with(spec, std::slice::from_ref(&effect));
        let mut scene_file = simulation.scene_file.clone();
        scene_file.noise = Some(Noise { position: 1e-3, orientation: 5e-3 });
        let scene = Scene::from_file(scene_file).unwrap();
        let body = effect.body.as_ref().map_or(String::new(), |body| format!("@{body}"));
        let request = EffectRequest::parse(&format!("{}{body}", effect.name)).unwrap();
        let options = RefinedOptions { effects: vec![request], ..RefinedOptions::default() };
        let result = smash::reconstruct(&scene, &Options::Refined(options)).unwrap();
        let name = &effect.name;
        // Poses are exact: what is left of χ² is rounding and the prior on gravity's direction.
        let chi2 = result.fit.chi2.unwrap();
        assert!(chi2 < 1e-2, "{name}: χ² {chi2:e}");
        let truth = &simulation.truth;
        let restitution = result.restitution.value.unwrap();
        assert!((restitution - truth.restitution).abs() < 1e-3, "{name}: {restitution}");
        if let Some(mass_ratio) = truth.mass_ratio {
            let found = result.mass_ratio.unwrap().value.unwrap();
            assert!((found / mass_ratio - 1.0).abs() < 1e-3, "{name}: {found}");
        }
        for (parameter, expected) in &effect.parameters {
            let found = result.effects[0].parameters[parameter].value.unwrap();
            let [found, expected] = [&found, expected].map(|number| {
                Vector3::from_iterator(
                    number.components().iter().copied().chain([0.0, 0.0]).take(3),
                )
            });
            let off = (found - expected).norm() / expected.norm();
            assert!(off < 1e-2, "{name}.{parameter}: {found} isn't {expected}");
        }
    }
}

fn every_third() -> Sampling {
    Sampling::Regular(RegularSampling { interval: 3, frame_count: 90, gap: Some(3) })
}
