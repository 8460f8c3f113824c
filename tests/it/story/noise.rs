//! Scenes whose noise isn't as they state it: random residuals of the wrong size are no physics.

use smash::diagnose::{Cause, OtherNoise, Otherwise, Verdict};

use super::*;

/// The scene's poses, with another noise stated: `factor` times the true one.
fn stating(scene: &Scene, factor: f64) -> Scene {
    let mut file = scene.to_file();
    let Noise { position, orientation } = file.noise.unwrap();
    file.noise = Some(Noise { position: factor * position, orientation: factor * orientation });
    Scene::from_file(file).unwrap()
}

fn drag() -> EffectSpec {
    effect("quadratic_drag", Some("a"), &[("k", &[0.2])])
}

/// That the poses show the true noise, within what so many numbers tell of it: some 7 %, three times.
fn assert_shown(noise: &OtherNoise, factor: f64) {
    for (shown, stated) in [
        (noise.position, noise.stated_position),
        (noise.orientation.unwrap(), noise.stated_orientation.unwrap()),
    ] {
        assert!((shown * factor / stated - 1.0).abs() < 0.2, "{noise:?}");
    }
}

/// The noise that is told, and what is missing with it.
fn told(otherwise: Option<Otherwise>) -> (OtherNoise, Vec<String>) {
    match otherwise {
        Some(Otherwise { cause: Cause::OtherNoise(noise), missing, .. }) => (noise, missing),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_clean_scene_with_too_small_a_noise_may_have_a_larger_one() {
    for spec in [boxes(31), box_on_floor(32)] {
        let scene = stating(&with(spec, &[]).scene, 0.5);
        let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.verdict, Verdict::UnknownEffect, "{}", diagnosis.explanation);
        let (noise, missing) = told(diagnosis.otherwise.clone());
        assert_shown(&noise, 0.5);
        assert!(missing.is_empty(), "{missing:?}");
        assert!(diagnosis.explanation.contains("The noise may be larger than stated"));
        assert!(
            diagnosis.advice[0].contains("left out, it is estimated"),
            "{:?}",
            diagnosis.advice
        );
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(improvement.otherwise, diagnosis.otherwise);
    }
}

#[test]
fn beside_a_misstated_noise_the_effect_is_told_that_is_missing() {
    let simulation = with(boxes(33), &[drag()]);
    for factor in [0.5, 2.0] {
        let scene = stating(&simulation.scene, factor);
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        let (noise, missing) = told(improvement.otherwise);
        assert_shown(&noise, factor);
        assert_eq!(missing, ["quadratic_drag@a"], "{factor}");
    }
}

/// An effect too weak for the noise that is stated shows beside the true one.
#[test]
fn a_noise_that_is_stated_too_large_hides_nothing() {
    let simulation = with(boxes(34), &[effect("gravity_scale", None, &[("s", &[1.001])])]);
    let scene = stating(&simulation.scene, 4.0);
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(diagnosis.verdict, Verdict::NothingMissing, "{}", diagnosis.explanation);
    let (noise, missing) = told(diagnosis.otherwise);
    assert_shown(&noise, 4.0);
    assert_eq!(missing, ["gravity_scale"]);
    assert!(diagnosis.explanation.contains("gravity_scale is all that is missing"));
}

#[test]
fn a_noise_that_is_stated_rightly_is_left_alone() {
    for effects in [&[][..], &[drag()]] {
        let scene = with(boxes(35), effects).scene;
        let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.otherwise, None, "{}", diagnosis.explanation);
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(improvement.otherwise, None);
    }
}

/// A law of the user's own that was tried, too.
#[test]
fn beside_a_misstated_noise_a_law_of_ones_own_is_told() {
    let law = format!("{}/examples/effects/tether.toml", env!("CARGO_MANIFEST_DIR"));
    let anchor: &[f64] = &[0.3, 2.2, -0.4];
    let strength: [(&str, &[f64]); 3] =
        [("stiffness", &[1.0]), ("length", &[0.9]), ("anchor", anchor)];
    let scene = with(boxes(3), &[effect(&law, Some("a"), &strength)]).scene;
    let further = requests(&[format!("{law}@a:anchor=[0.3,2.2,-0.4]")]);
    let scene = stating(&scene, 0.5);
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &further).unwrap();
    let (noise, missing) = told(diagnosis.otherwise);
    assert_eq!(missing, ["tether@a"], "{}", diagnosis.explanation);
    assert_shown(&noise, 0.5);
}

/// A ball whose orientation nobody sees tells the noise of its positions.
#[test]
fn a_ball_s_noise_is_told_too() {
    let scene = stating(&with(plain_balls(36), &[]).scene, 0.5);
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    let (noise, _) = told(diagnosis.otherwise);
    assert!((noise.position / noise.stated_position - 2.0).abs() < 0.4, "{noise:?}");
    assert_eq!((noise.orientation, noise.stated_orientation), (None, None));
}

/// Of two channels one is misstated.
#[test]
fn the_words_tell_which_way_the_noise_is_off() {
    let simulation = with(boxes(37), &[]);
    for (position, orientation, how) in
        [(1.0, 0.3, "larger"), (0.5, 4.0, "other"), (1.0, 8.0, "smaller")]
    {
        let mut file = simulation.scene.to_file();
        file.noise = Some(Noise {
            position: position * NOISE.position,
            orientation: orientation * NOISE.orientation,
        });
        let scene = Scene::from_file(file).unwrap();
        let told = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap().explanation;
        assert!(told.contains(&format!("noise may be {how} than stated")), "{how}: {told}");
    }
}

/// A few poses far off are no noise.
#[test]
fn wrong_poses_are_not_taken_for_noise() {
    let mut file = with(boxes(38), &[]).scene.to_file();
    let poses = file.bodies[0].observations.as_mut().unwrap();
    for (index, shift) in [(1, 0.05), (4, -0.06), (8, 0.04)] {
        poses[index].position[0] += shift;
    }
    let scene = Scene::from_file(file).unwrap();
    let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(improvement.otherwise, None);
}
