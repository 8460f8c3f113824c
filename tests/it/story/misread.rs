//! Scenes that are written otherwise than they are read: no law of physics explains them, and the answer
//! is how to write them.

use smash::diagnose::{Cause, Misread, Orientations, Verdict};
use smash::scene::SceneFile;

use super::*;

const AS_STATED: Misread = Misread { up: None, fps: None, orientations: None };

/// The scene file of `simulation`, its orientations written by `orientations`.
fn written(simulation: &Simulation, orientations: impl Fn([f64; 4]) -> [f64; 4]) -> SceneFile {
    let mut file = simulation.scene_file.clone();
    let poses = file.bodies.iter_mut().flat_map(|body| body.observations.iter_mut().flatten());
    poses.for_each(|pose| pose.orientation = pose.orientation.map(&orientations));
    file
}

fn scalar_last([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [x, y, z, w]
}

fn inverse([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [w, -x, -y, -z]
}

/// All ways to write two boxes that are told here.
fn all(simulation: &Simulation) -> Vec<(SceneFile, Misread)> {
    let as_is = written(simulation, |orientation| orientation);
    let other = |up: [f64; 3], fps: f64| SceneFile {
        up,
        fps: as_is.fps.map(|stated| stated * fps),
        ..as_is.clone()
    };
    let turned = |orientations| Misread { orientations: Some(orientations), ..AS_STATED };
    let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut both = other(x, 1.0);
    both.bodies = written(simulation, scalar_last).bodies;
    vec![
        (written(simulation, scalar_last), turned(Orientations::ScalarLast)),
        (written(simulation, inverse), turned(Orientations::Inverse)),
        (written(simulation, |q| scalar_last(inverse(q))), turned(Orientations::ScalarLastInverse)),
        (other(x, 1.0), Misread { up: Some(y), ..AS_STATED }),
        (other(y, 0.4), Misread { fps: as_is.fps, ..AS_STATED }),
        (both, Misread { up: Some(y), ..turned(Orientations::ScalarLast) }),
    ]
}

/// With the noise stated and without.
#[test]
fn another_reading_that_explains_the_poses_is_told_before_any_effect() {
    let simulation = with(boxes(81), &[]);
    assert_eq!(simulation.scene.up_in_world().y, 1.0);
    for (mut file, reading) in all(&simulation) {
        for is_stated in [true, false] {
            file.noise = file.noise.filter(|_| is_stated);
            let scene = Scene::from_file(file.clone()).unwrap();
            let base = RefinedOptions::default();
            let diagnosis = smash::diagnose(&scene, &base, &[]).unwrap();
            let told = &diagnosis.explanation;
            assert_eq!(diagnosis.verdict, Verdict::UnknownEffect, "{reading:?}: {told}");
            assert!(diagnosis.candidates.is_empty(), "{reading:?}: {told}");
            let otherwise = diagnosis.otherwise.unwrap();
            assert_eq!(otherwise.cause, Cause::Misread(reading), "{told}");
            assert_eq!(otherwise.missing, [""; 0], "{told}");
            assert!(told.ends_with("nothing is missing."), "{told}");

            let improvement = smash::improve(&scene, &base, &[]).unwrap();
            assert!(improvement.is_misread(), "{}", improvement.explanation);
            assert_eq!(improvement.ladder.len(), 1);
        }
    }
}

/// At twice the frame rate all falls as on a planet of four times the gravity.
#[test]
fn an_effect_that_explains_as_much_keeps_its_name() {
    let boxes = format!("{}/scenes/boxes.json", env!("CARGO_MANIFEST_DIR"));
    let mut file = Scene::read(boxes).unwrap().to_file();
    let fps = file.fps.unwrap();
    let poses = file.bodies.iter_mut().flat_map(|body| body.observations.iter_mut().flatten());
    poses.for_each(|pose| pose.time = pose.time.map(|time_s| 0.5 * time_s));
    file.fps = Some(2.0 * fps);
    let scene = Scene::from_file(file).unwrap();
    let base = RefinedOptions::default();
    let diagnosis = smash::diagnose(&scene, &base, &[]).unwrap();
    let told = &diagnosis.explanation;
    assert_eq!(diagnosis.missing().unwrap().label(), "gravity_scale", "{told}");
    let cause = Cause::Misread(Misread { fps: Some(fps), ..AS_STATED });
    assert_eq!(diagnosis.otherwise.unwrap().cause, cause, "{told}");
    let improvement = smash::improve(&scene, &base, &[]).unwrap();
    assert_eq!(last(&improvement).with, ["gravity_scale"]);
    assert_eq!(improvement.otherwise.unwrap().cause, cause);
}

#[test]
fn what_is_missing_beside_it_is_told_too() {
    let drag = effect("quadratic_drag", Some("b"), &[("k", &[0.1])]);
    let simulation = with(boxes(82), &[drag]);
    let scene = Scene::from_file(written(&simulation, scalar_last)).unwrap();
    let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
    let otherwise = diagnosis.otherwise.unwrap();
    assert!(otherwise.is_misread(), "{}", otherwise.words);
    assert_eq!(otherwise.missing, ["quadratic_drag@b"], "{}", otherwise.words);
}
