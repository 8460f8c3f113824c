//! What can't be asked for, and laws that go wrong: a clear message each time, never a panic.

use rayon::prelude::*;
use smash::effect::EffectRequest;
use smash::{ErrorKind, Scene};

use super::{first_body, fit, noisy, own, scene, with};

fn law(parameter: &str, laws: &str) -> String {
    format!("name = \"mine\"\n[parameters.k]\n{parameter}\n[law]\n{laws}\n")
}

/// Either the scene has a fit that is no worse than without, or a message that names the effect and
/// says what to do.
fn assert_fits_or_tells(scene: &Scene, text: &str) {
    let base = fit(scene, &[]).unwrap();
    match fit(scene, &[own(text, first_body(scene))]) {
        Ok(result) => {
            assert!(result.fit.cost <= base.fit.cost, "{text}");
            let json = result.to_json();
            smash::Reconstruction::parse(&json, "result.json").unwrap();
        }
        Err(error) => {
            let message = error.to_string();
            // A plain ball shows no torque.
            let is_unseen = message.contains("no orientations");
            assert!(is_unseen || error.kind() == ErrorKind::Solve, "{message}");
            assert!(message.contains("mine") && error.hint().is_some(), "{message}");
        }
    }
}

#[test]
fn what_the_scene_has_not_got_is_said() {
    let floor = scene("box_on_floor");
    let ball = scene("ball_on_floor");
    let boxes = scene("boxes");
    let dark = Scene::parse(&super::scene_value("boxes").to_string(), "boxes").unwrap();
    for (scene, effect, words) in [
        (&floor, "time_offset", "one dynamic body"),
        (&ball, "magnus", "no orientations"),
        (&boxes, "friction", "no static body"),
        (&dark, "depth_scale", "no camera"),
        (&boxes, "linear_drag@c", "no dynamic body `c`"),
        (&floor, "linear_drag@floor", "no dynamic body `floor`"),
        (&boxes, "gravity_scale@a", "acts on all bodies together"),
        (&boxes, "torsional_impulse@b", "acts on all bodies together"),
    ] {
        let error = with(scene, &[effect]).unwrap_err();
        let message = error.to_string();
        assert_eq!(error.kind(), ErrorKind::Invalid, "{message}");
        assert!(message.contains(words) && error.hint().is_some(), "{effect}: {message}");
    }
}

/// On few poses or none in flight an effect is not determined, and it is said.
#[test]
fn too_few_poses_for_an_effect_give_reasons() {
    let scene = scene("boxes");
    let all = ["linear_drag", "quadratic_drag", "magnus", "spin_drag", "inertia", "com_offset"];
    let result = with(&scene, &all).unwrap();
    for effect in &result.effects {
        for parameter in effect.parameters.values() {
            assert!(parameter.std.is_some() || parameter.reason.is_some(), "{effect:?}");
        }
    }
}

/// Laws that are good where they were tried, and stiff, huge or not a number elsewhere.
#[test]
fn laws_that_go_wrong_along_the_flight() {
    let per_second = "unit = \"1/s\"\nnull = 0\nbounds = [-1e6, 1e6]";
    let rate = "unit = \"1/s^2\"\nnull = 0\nbounds = [0, 1e9]\nscale = 1e7";
    let acceleration = "unit = \"m/s^2\"\nnull = 0\nbounds = [-1e6, 1e6]\nscale = 100";
    for (parameter, laws) in [
        // Stiff, and away from zero: a decay time of a nanosecond, or growth.
        (per_second, "acceleration = \"-k * v\"".to_string()),
        (per_second, "torque = \"k * L\"".to_string()),
        (rate, "acceleration = \"-k * p\"".to_string()),
        (
            rate,
            "acceleration = \"k * p * norm(p) * norm(p) / 1e-9\""
                .replace(" / 1e-9", " * 1 / size.x^2"),
        ),
        // Faster than any camera.
        (
            acceleration,
            "acceleration = \"k * sin(1e5 * t / 1) * up\"".replace("t / 1", "(t / t_c)"),
        ),
        (acceleration, "acceleration = \"k * exp(min(p.y / size.x, 700)) * up\"".to_string()),
        (acceleration, "acceleration = \"k * step(p.y / size.x - 2) * up\"".to_string()),
        (
            "unit = \"s\"\nnull = 0\nbounds = [-1e6, 1e6]\nscale = 100",
            "time = \"t + k\"".to_string(),
        ),
        ("unit = \"1\"\nnull = 0\nbounds = [-1e6, 1e6]", "time = \"t * (1 + k)\"".to_string()),
        ("unit = \"1\"\nnull = 1\nbounds = [-1e6, 1e6]", "inertia = \"[k, k, k]\"".to_string()),
        ("unit = \"1\"\nnull = 1\nbounds = [0, 1e6]", "inertia = \"[k, 1, 1]\"".to_string()),
        ("unit = \"1\"\nnull = 1\nbounds = [-10, 1e6]", "position = \"k * p\"".to_string()),
    ] {
        let text = law(parameter, &laws);
        // What its own check refuses needs no fit.
        if smash::effect::Effect::parse(&text, "own.toml").is_err() {
            continue;
        }
        assert_fits_or_tells(&noisy(7), &text);
        assert_fits_or_tells(&scene("ball_on_floor"), &text);
    }
}

/// Far before the first pose, far after the last, and at the collision.
#[test]
fn an_event_outside_the_poses_does_nothing() {
    let scene = noisy(8);
    let base = fit(&scene, &[]).unwrap();
    for time in ["-50", "50"] {
        let result = with(&scene, &[&format!("second_impact@a:time={time}")]).unwrap();
        let (found, expected) = (result.fit.cost, base.fit.cost);
        // Flights with effects take steps of their own, with errors of some 1e-7 rad.
        assert!((found - expected).abs() <= 1e-4 * expected, "{time}: {found}, not {expected}");
        let spin = &result.effects[0].parameters["spin"];
        assert_eq!((spin.std, spin.reason.is_some()), (None, true), "{spin:?}");
    }
    let at = base.collision_time.value.unwrap();
    with(&scene, &[&format!("second_impact@a:time={at}")]).unwrap();
}

/// Values at the ends of what may be given.
#[test]
fn extreme_given_values_end_in_numbers_or_words() {
    let [boxes, floor] = ["boxes", "box_on_floor"].map(scene);
    let in_the_air = [
        "linear_drag@a:k=1000",
        "quadratic_drag:k=10",
        "magnus:k=1",
        "constant_force@a:a=[100,100,100]",
        "gravity_scale:s=5",
        "gravity_tilt:tilt1=0.8,tilt2=-0.8",
        "spin_drag:kappa=100",
        "inertia:factor=[0.05,20,1]",
        "com_offset@a:offset=[1,1,1]",
        "external_impulse@a:P=[1000,0,0]",
        "torsional_impulse:M=100",
        "second_impact@a:time=0.3,impulse=[1000,0,0]",
        "outlier@a:time=0.2,turn=[3.2,0,0]",
        "time_offset@a:delay=0.5",
        "depth_scale@a:s=2",
    ];
    let on_the_floor = ["friction:mu=5", "linear_drag:k=1000", "spin_drag:kappa=100"];
    let all = in_the_air.map(|effect| (&boxes, effect)).into_iter();
    let all: Vec<_> = all.chain(on_the_floor.map(|effect| (&floor, effect))).collect();
    all.into_par_iter().for_each(|(scene, effect)| match with(scene, &[effect]) {
        Ok(result) => assert!(result.fit.cost.is_finite(), "{effect}"),
        Err(error) => {
            let message = error.to_string();
            assert!(error.hint().is_some(), "{effect}: {message}");
            assert!(message.contains(effect.split([':', '@']).next().unwrap()), "{message}");
        }
    });
}

#[test]
fn bounds_are_told_with_their_unit_if_there_is_one() {
    for (text, range) in [("magnus:k=5", "-1 to 1"), ("spin_drag:kappa=1e9", "0 to 100 1/s")] {
        assert_eq!(EffectRequest::parse(text).unwrap_err().hint(), Some(range), "{text}");
    }
}

#[test]
fn requests_that_name_nothing_are_refused() {
    for text in ["drag", "linear_drag@", "linear_drag:", "linear_drag:k", "linear_drag:k=-1", ""] {
        let error = EffectRequest::parse(text).unwrap_err();
        assert!(error.hint().is_some(), "{text}: {error}");
    }
}
