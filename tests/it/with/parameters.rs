//! What is said of an effect's parameters.

use smash::effect::EffectRequest;
use smash::reconstruct::Number;

use super::{chi2, fit, noisy, own, scene, with};

/// Where the poses pull a parameter past its bound it stays there, and has no deviation: noise looks
/// like a push along the way of this box, and drag can't push.
#[test]
fn at_a_bound_there_is_no_deviation_but_a_reason() {
    let result = with(&scene("box_on_floor"), &["linear_drag"]).unwrap();
    let k = &result.effects[0].parameters["k"];
    assert_eq!((k.value, k.std), (Some(Number::Scalar(0.0)), None));
    assert_eq!(k.reason.as_deref(), Some("it ends at its bound"));
}

#[test]
fn a_given_parameter_stays_and_counts_no_freedom() {
    let scene = noisy(1);
    let free = with(&scene, &["quadratic_drag@a"]).unwrap();
    let held = with(&scene, &["quadratic_drag@a:k=0.05"]).unwrap();
    let k = &held.effects[0].parameters["k"];
    assert_eq!((k.value, k.std), (Some(Number::Scalar(0.05)), None));
    assert_eq!(k.reason.as_deref(), Some("it was given"));
    assert_eq!(held.fit.dof, free.fit.dof + 1);
    assert!(chi2(&held) > chi2(&free));
}

/// Parameters stand in the covariance under the names of their places in the file.
#[test]
fn the_table_of_deviations_holds_the_parameters() {
    let result = with(&noisy(2), &["constant_force@a", "gravity_scale"]).unwrap();
    let table = result.uncertainty.as_ref().unwrap();
    let std_of = |name: &str| {
        let place = table.quantities.iter().position(|known| known == name).unwrap();
        table.std[place].unwrap()
    };
    let Some(Number::Vector(stds)) = result.effects[0].parameters["a"].std else { panic!() };
    for (axis, std) in ["x", "y", "z"].into_iter().zip(stds) {
        let told = std_of(&format!("effects[0].a.{axis}"));
        assert!((told - std).abs() <= 1e-12 * std, "{told}, not {std}");
    }
    assert!(std_of("effects[1].s") > 0.0);
}

/// A plain name is an effect of each body, one of a pair or of the scene acts once.
#[test]
fn a_plain_name_acts_on_every_body() {
    let scene = scene("boxes");
    let of_bodies = with(&scene, &["spin_drag"]).unwrap();
    let bodies: Vec<_> = of_bodies.effects.iter().map(|one| one.body.as_deref()).collect();
    assert_eq!(bodies, [Some("a"), Some("b")]);
    assert_eq!(of_bodies.phases.len(), 5);
    for name in ["gravity_tilt", "torsional_impulse"] {
        let of_all = with(&scene, &[name]).unwrap();
        assert_eq!((of_all.effects.len(), &of_all.effects[0].body), (1, &None), "{name}");
    }
}

/// A second of the same kind is a rival of the first, not a mistake: the two share what one explains.
#[test]
fn an_effect_may_be_there_twice() {
    let scene = noisy(5);
    let once = with(&scene, &["constant_force@a"]).unwrap();
    let twice = with(&scene, &["constant_force@a", "constant_force@a"]).unwrap();
    assert!(twice.fit.cost <= once.fit.cost);
    assert!(twice.fit.cost >= once.fit.cost * (1.0 - 1e-6));
    // Nothing tells one from the other, and it is said.
    for effect in &twice.effects {
        assert!(effect.parameters["a"].reason.is_some(), "{effect:?}");
    }
    let outliers = with(&scene, &["outlier@a", "outlier@a"]).unwrap();
    let times: Vec<_> = outliers.effects.iter().map(|one| one.parameters["time"].value).collect();
    assert_ne!(times[0], times[1], "one pose was taken twice");
}

#[test]
fn a_law_that_reads_no_motion_has_its_value() {
    let text = "name = \"push\"\n[parameters.a]\nunit = \"m/s^2\"\nnull = [0, 0, 0]\n\
                bounds = [-100, 100]\n[law]\nacceleration = \"a\"\n";
    let scene = noisy(6);
    let own = fit(&scene, &[own(text, "a")]).unwrap();
    let known = fit(&scene, &[EffectRequest::parse("constant_force@a").unwrap()]).unwrap();
    // The same law under another name, with another scale: the optimiser's tolerance.
    assert!((chi2(&own) - chi2(&known)).abs() <= 1e-6 * chi2(&known));
    assert!(own.effects[0].definition.is_some() && known.effects[0].definition.is_none());
}
