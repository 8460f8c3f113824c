//! Every effect of the catalogue, on scenes that can show it.

use smash::effect::{Effect, EffectRequest, Scope, catalogue};
use smash::{Scene, compare};

use super::{chi2, first_body, fit, noisy, scene, with};

const FLOORS: [&str; 2] = ["box_on_floor", "ball_on_floor"];

/// The effect on the first body, or on all where it acts on all.
fn request(effect: &Effect, scene: &Scene) -> EffectRequest {
    let body = (effect.scope == Scope::Body).then(|| first_body(scene).to_string());
    EffectRequest { effect: effect.clone(), body, fixed: Default::default() }
}

/// The effects that `scene` can show, with their fit.
fn fits(scene: &Scene) -> Vec<(EffectRequest, smash::Reconstruction)> {
    let mut fits = Vec::new();
    for effect in catalogue() {
        let request = request(effect, scene);
        match fit(scene, std::slice::from_ref(&request)) {
            Ok(result) => fits.push((request, result)),
            // Only what the scene lacks may hinder an effect.
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains("this scene ") && error.hint().is_some(), "{text}");
            }
        }
    }
    fits
}

/// All that a fit with an effect must keep: χ² never rises when an unknown joins, to the last digit;
/// the phases tell of it; and the numbers in the result, with their own laws, leave the residuals that
/// the fit reports. The two integrate with different steps: the fit's error, some 1e-7 rad, is a
/// hundred-thousandth of the noise.
fn assert_keeps_the_contract(scene: &Scene, least_effects: usize) {
    let base = fit(scene, &[]).unwrap();
    let fits = fits(scene);
    assert!(fits.len() >= least_effects, "{}: only {}", scene.name(), fits.len());
    for (request, result) in fits {
        let name = format!("{} in {}", request.effect.name, scene.name());
        if let (Some(with), Some(without)) = (result.fit.chi2, base.fit.chi2) {
            // The tilt of gravity has a prior, which is part of what is minimised, but not of χ².
            assert!(result.fit.cost <= base.fit.cost, "{name}: {with} after {without}");
        }
        let phase = result.phases.last().unwrap();
        assert!(phase.name.starts_with(&format!("4 {}", request.effect.name)), "{name}");
        assert_eq!(phase.cost_final, result.fit.cost, "{name}");
        assert!(phase.cost_final <= phase.cost_initial * (1.0 + 1e-6), "{name}: {phase:?}");
        assert!(phase.seconds.is_some(), "{name}");
        let named = [("with".to_string(), result.clone())];
        let comparison = compare(scene, &named).unwrap();
        let compared = &comparison.results[0];
        let pairs = [
            (compared.position_rmse, Some(result.fit.position_rmse)),
            (compared.orientation_rmse, result.fit.orientation_rmse),
        ];
        for (found, expected) in pairs {
            let (found, expected) = match (found, expected) {
                (Some(found), Some(expected)) => (found, expected),
                // A further impact beside the collision may leave no jump to it that stands out.
                (None, _) if result.collision_time.value.is_none() => {
                    assert_eq!(request.effect.name, "second_impact", "{name}");
                    assert!(compared.reason.is_some(), "{name}");
                    continue;
                }
                (found, expected) => {
                    assert_eq!(found.is_some(), expected.is_some(), "{name}");
                    continue;
                }
            };
            assert!((found - expected).abs() <= 2e-5 * expected, "{name}: {found}, not {expected}");
        }
    }
}

#[test]
fn two_boxes_keep_the_contract_with_every_effect_but_friction() {
    assert_keeps_the_contract(&scene("boxes"), 15);
}

/// What only two bodies have is missing here: the stamps of one against the other's.
#[test]
fn a_body_on_a_floor_keeps_the_contract() {
    for name in FLOORS {
        assert_keeps_the_contract(&scene(name), if name == "box_on_floor" { 15 } else { 9 });
    }
}

/// Without a stated noise each fit has its own; the contract is the same.
#[test]
fn a_scene_without_noise_keeps_the_contract() {
    assert_keeps_the_contract(&scene("uneven_times"), 15);
}

#[test]
fn noisy_boxes_keep_the_contract() {
    for seed in 1..=3 {
        assert_keeps_the_contract(&noisy(seed), 15);
    }
}

/// Held where it does nothing an effect leaves the base model, in all numbers.
#[test]
fn at_its_null_an_effect_changes_nothing() {
    for name in ["boxes", "box_on_floor"] {
        let scene = scene(name);
        let base = fit(&scene, &[]).unwrap();
        for effect in catalogue() {
            let mut request = request(effect, &scene);
            let nulls = effect.parameters.iter().map(|p| (p.name.clone(), p.null.clone()));
            request.fixed = nulls.collect();
            let Ok(held) = fit(&scene, &[request]) else { continue };
            let name = format!("{} in {name}", effect.name);
            assert!((chi2(&held) - chi2(&base)).abs() <= 1e-9 * chi2(&base), "{name}");
            assert_eq!(held.bodies, base.bodies, "{name}");
            assert_eq!((held.fit.dof, held.flags), (base.fit.dof, base.flags.clone()), "{name}");
            for parameter in held.effects[0].parameters.values() {
                assert_eq!(parameter.std, None, "{name}");
                assert_eq!(parameter.reason.as_deref(), Some("it was given"), "{name}");
            }
        }
    }
}

/// The optimum doesn't depend on the order in which effects join, but for the integrators' errors.
#[test]
fn the_order_of_effects_makes_no_difference() {
    let scene = noisy(4);
    for [one, other] in [
        ["quadratic_drag@a", "constant_force@b"],
        ["gravity_scale", "inertia@a"],
        ["spin_drag@b", "com_offset@a"],
        ["external_impulse@a", "depth_scale@b"],
    ] {
        let forwards = with(&scene, &[one, other]).unwrap();
        let backwards = with(&scene, &[other, one]).unwrap();
        let (first, second) = (forwards.fit.cost, backwards.fit.cost);
        let told = format!("{first}: {:?}, or {second}: {:?}", forwards.effects, backwards.effects);
        assert!((first - second).abs() <= 1e-5 * first, "{told}");
        assert_eq!(forwards.effects.len(), 2);
        assert_eq!(forwards.phases.len(), 5);
        assert!(forwards.phases[4].name.starts_with(&format!("5 {other}")));
    }
}
