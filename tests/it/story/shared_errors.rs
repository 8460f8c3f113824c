//! Poses of a tracker that smooths: neighbours share their errors, which look like a force.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use smash::diagnose::{Cause, Diagnosis, Otherwise, Verdict};

use super::*;

/// The correlation of neighbours' errors.
const CORRELATION: f64 = 0.8;

/// Every frame of 90, exactly.
fn dense(mut spec: SimulationSpec, effects: &[EffectSpec]) -> Scene {
    spec.observations = every_frame();
    spec.noise = NoiseSpec::None;
    with(spec, effects).scene
}

fn every_frame() -> Sampling {
    Sampling::Regular(RegularSampling { interval: 1, frame_count: 90, gap: None })
}

/// The same, seen by such a tracker; the noise is stated rightly.
fn tracked(scene: &Scene, seed: u64) -> Scene {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut drawn =
        || -> Vector3<f64> { Vector3::from_fn(|_, _| StandardNormal.sample(&mut random)) };
    let mut file = scene.to_file();
    for poses in file.bodies.iter_mut().filter_map(|body| body.observations.as_mut()) {
        let (mut shift, mut turn) = (drawn(), drawn());
        for pose in poses {
            let fresh = (1.0 - CORRELATION * CORRELATION).sqrt();
            shift = CORRELATION * shift + fresh * drawn();
            turn = CORRELATION * turn + fresh * drawn();
            pose.position = (Vector3::from(pose.position) + NOISE.position * shift).into();
            let [w, x, y, z] = pose.orientation.unwrap();
            let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
                * UnitQuaternion::new(NOISE.orientation * turn);
            pose.orientation = Some([q.w, q.i, q.j, q.k]);
        }
    }
    file.noise = Some(NOISE);
    Scene::from_file(file).unwrap()
}

fn diagnosis(scene: &Scene) -> Diagnosis {
    smash::diagnose(scene, &RefinedOptions::default(), &[]).unwrap()
}

/// Every so manieth pose, and what those show.
fn shared(otherwise: Option<Otherwise>) -> (usize, Vec<String>) {
    match otherwise {
        Some(Otherwise { cause: Cause::SharedErrors(shared), missing, .. }) => {
            (shared.every, missing)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn smooth_errors_alone_may_be_all_that_is_left() {
    let told = diagnosis(&tracked(&dense(boxes(41), &[]), 1));
    assert_eq!(told.verdict, Verdict::UnknownEffect, "{}", told.explanation);
    let (every, missing) = shared(told.otherwise);
    assert!(missing.is_empty(), "{missing:?}");
    assert!(told.explanation.contains("share their errors"), "{}", told.explanation);
    assert!(told.advice[0].contains(&format!("keep one in {every}")), "{:?}", told.advice);
}

#[test]
fn an_effect_is_told_beside_them() {
    let drag = effect("quadratic_drag", Some("a"), &[("k", &[0.2])]);
    let scene = tracked(&dense(boxes(42), &[drag]), 2);
    let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
    let (_, missing) = shared(improvement.otherwise);
    assert_eq!(missing, ["quadratic_drag@a"]);
}

/// A force that no effect explains shows in fewer poses, too: errors are no excuse for it.
#[test]
fn a_force_is_no_error_of_the_poses() {
    let law = format!("{}/examples/effects/coriolis.toml", env!("CARGO_MANIFEST_DIR"));
    let coriolis = effect(&law, None, &[("turning", &[0.3, 0.5, -0.2])]);
    let mut spec = boxes(3);
    spec.observations = every_frame();
    let told = diagnosis(&with(spec, &[coriolis]).scene);
    assert!(
        told.stays_structured || told.verdict == Verdict::UnknownEffect,
        "{}",
        told.explanation
    );
    assert_eq!(told.otherwise, None, "{}", told.explanation);
}

/// Independent noise makes no waves, beside a force that is too weak to be told either.
#[test]
fn a_weak_force_beside_independent_noise_is_no_shared_error() {
    let law = format!("{}/examples/effects/coriolis.toml", env!("CARGO_MANIFEST_DIR"));
    for seed in 50..54 {
        let coriolis = effect(&law, None, &[("turning", &[0.004, -0.004, 0.004])]);
        let mut spec = boxes(seed);
        spec.observations = every_frame();
        let told = diagnosis(&with(spec, &[coriolis]).scene);
        assert_eq!(told.otherwise, None, "{seed}: {}", told.explanation);
    }
}
