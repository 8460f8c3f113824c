//! Scenes whose noise isn't as they state it: random residuals of the wrong size are no physics.

use smash::diagnose::{OtherNoise, Verdict};

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

#[test]
fn a_clean_scene_with_too_small_a_noise_may_have_a_larger_one() {
    for spec in [boxes(31), box_on_floor(32)] {
        let scene = stating(&with(spec, &[]).scene, 0.5);
        let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.verdict, Verdict::UnknownEffect, "{}", diagnosis.explanation);
        let noise = diagnosis.other_noise.unwrap();
        assert_shown(&noise, 0.5);
        assert!(noise.missing.is_empty(), "{noise:?}");
        assert!(diagnosis.explanation.contains("Or the noise is larger than stated"));
        assert!(
            diagnosis.advice[0].contains("left out, it is estimated"),
            "{:?}",
            diagnosis.advice
        );
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(improvement.other_noise, Some(noise));
    }
}

#[test]
fn beside_a_misstated_noise_the_effect_is_told_that_is_missing() {
    let simulation = with(boxes(33), &[drag()]);
    for factor in [0.5, 2.0] {
        let scene = stating(&simulation.scene, factor);
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        let noise = improvement.other_noise.unwrap();
        assert_shown(&noise, factor);
        assert_eq!(noise.missing, ["quadratic_drag@a"], "{factor}");
    }
}

/// An effect too weak for the noise that is stated shows beside the true one.
#[test]
fn a_noise_that_is_stated_too_large_hides_nothing() {
    let simulation = with(boxes(34), &[effect("gravity_scale", None, &[("s", &[1.001])])]);
    let scene = stating(&simulation.scene, 4.0);
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    assert_eq!(diagnosis.verdict, Verdict::NothingMissing, "{}", diagnosis.explanation);
    let noise = diagnosis.other_noise.unwrap();
    assert_shown(&noise, 4.0);
    assert_eq!(noise.missing, ["gravity_scale"]);
    assert!(diagnosis.explanation.contains("gravity_scale is all that is missing"));
}

#[test]
fn a_noise_that_is_stated_rightly_is_left_alone() {
    for effects in [&[][..], &[drag()]] {
        let scene = with(boxes(35), effects).scene;
        let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(diagnosis.other_noise, None, "{}", diagnosis.explanation);
        let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
        assert_eq!(improvement.other_noise, None);
    }
}
