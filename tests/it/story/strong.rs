//! Effects so strong that the model without them says nothing of the collision: half of gravity, as with a
//! frame rate that is wrong by a third, or a force like a motor's. Their fits find the way all the same.

use super::*;

/// How often noise alone leaves χ² outside, in one of so many scenes.
const SCENES: f64 = 6.0;

#[test]
fn a_model_that_is_far_off_hides_no_strong_effect() {
    let strong = [
        ("gravity_scale", effect("gravity_scale", None, &[("s", &[0.5])])),
        ("constant_force@a", effect("constant_force", Some("a"), &[("a", &[4.0, 1.0, -3.0])])),
    ];
    for (label, hidden) in strong {
        for seed in 61..64 {
            let scene = with(boxes(seed), std::slice::from_ref(&hidden)).scene;
            let without = fit(&scene, &[]).fit.reduced_chi2.unwrap();
            assert!(without > 10.0, "{label}, {seed}: {without}");
            let result = fit(&scene, &[label.to_string()]);
            assert!(is_in_band(&result, SCENES), "{label}, {seed}: {:?}", result.fit);
        }
    }
}

/// As of a shuttlecock: before the collision drag slows it so much that no parabola is near its path. And a
/// motor in a body that turns.
#[test]
fn a_path_that_no_parabola_is_near_is_found() {
    let thrust = format!("{}/examples/effects/thrust.toml@b", env!("CARGO_MANIFEST_DIR"));
    let file = thrust.trim_end_matches("@b");
    let strong = [
        ("quadratic_drag@a", effect("quadratic_drag", Some("a"), &[("k", &[0.3])])),
        (&thrust, effect(file, Some("b"), &[("thrust", &[-2.7, -0.5, -5.6])])),
    ];
    for (label, hidden) in strong {
        for seed in [66, 67] {
            let mut spec = boxes(seed);
            spec.observations =
                Sampling::Regular(RegularSampling { interval: 3, frame_count: 90, gap: None });
            let scene = with(spec, std::slice::from_ref(&hidden)).scene;
            assert!(fit(&scene, &[]).fit.reduced_chi2.unwrap() > 100.0);
            let result = fit(&scene, &[label.to_string()]);
            assert!(is_in_band(&result, SCENES), "{label}, {seed}: {:?}", result.fit);
        }
    }
}

/// Where a spring has no stiffness its anchor is nothing to it: from the null alone no way leads there.
#[test]
fn a_strong_spring_of_ones_own_is_found() {
    let file = format!("{}/examples/effects/spring.toml", env!("CARGO_MANIFEST_DIR"));
    let hidden = effect(&file, Some("b"), &[("stiffness", &[5.0]), ("anchor", &[0.5, 2.0, 0.0])]);
    for seed in [62, 63] {
        let scene = with(boxes(seed), std::slice::from_ref(&hidden)).scene;
        assert!(fit(&scene, &[]).fit.reduced_chi2.unwrap() > 10.0);
        let result = fit(&scene, &[format!("{file}@b")]);
        assert!(is_in_band(&result, SCENES), "{seed}: {:?}", result.fit);
    }
}

#[test]
fn half_of_gravity_is_diagnosed() {
    let scene = with(boxes(64), &[effect("gravity_scale", None, &[("s", &[0.5])])]).scene;
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(diagnosis.candidates[0].label(), "gravity_scale", "{}", diagnosis.explanation);
    assert!(!diagnosis.stays_structured, "{}", diagnosis.explanation);
}

/// As a slip of the keyboard makes: one pose of many is ten metres off, and the fit with it is of no use.
#[test]
fn a_wild_pose_among_many_is_found() {
    let mut spec = boxes(65);
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 2, frame_count: 90, gap: None });
    let file = simulate(&spec).unwrap().scene_file.to_json();
    for index in [3, 7, 15, 35] {
        let mut scene: Value = serde_json::from_str(&file).unwrap();
        let poses = scene["bodies"][0]["observations"].as_array_mut().unwrap();
        assert!(poses.len() > 40);
        poses[index]["position"][1] = 10.0.into();
        let scene = Scene::parse(&scene.to_string(), "wild").unwrap();
        let result = fit(&scene, &["outlier@a".to_string()]);
        assert!(is_in_band(&result, SCENES), "{index}: {:?}", result.fit);
        let time_s = scene.bodies()[0].observations[index].time_s;
        assert_eq!(result.effects[0].parameters["time"].value, Some(Number::Scalar(time_s)));
    }
}
