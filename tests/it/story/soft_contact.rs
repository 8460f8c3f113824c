//! Contacts that last: what the poses show meanwhile is no flight, and looks like an effect.

use std::path::Path;

use smash::diagnose::{Cause, Diagnosis, NearCollision, NearCollisions, Otherwise};
use smash::improve::Improvement;
use smash::reconstruct::Number;

use super::*;

/// How long bodies that give way touch, s: half of it is some six frames of 60 in a second.
const TOUCH_S: f64 = 0.2;

/// Every frame of 90, as a good tracker sees them.
fn dense(mut spec: SimulationSpec) -> SimulationSpec {
    spec.noise = NoiseSpec::Gaussian(Noise { position: 2e-4, orientation: 1e-3 });
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 1, frame_count: 90, gap: None });
    spec
}

/// The scene as if the impulse had been a constant force that lasts; outside of that time nothing changes.
fn softened(simulation: &Simulation) -> Scene {
    let mut file = simulation.scene.to_file();
    for (body, truth) in file.bodies.iter_mut().zip(&simulation.truth.bodies) {
        let jump = Vector3::from(truth.velocity_after) - Vector3::from(truth.velocity_before);
        for pose in body.observations.as_mut().unwrap() {
            let since_s = (pose.time.unwrap() - simulation.truth.collision_time).abs();
            let left_s = (0.5 * TOUCH_S - since_s).max(0.0);
            let shift = jump * (left_s * left_s / (2.0 * TOUCH_S));
            pose.position = (Vector3::from(pose.position) + shift).into();
        }
    }
    Scene::from_file(file).unwrap()
}

/// What a command prints.
fn typed(folder: &Path, command: &str) -> String {
    let mut smash = std::process::Command::new(env!("CARGO_BIN_EXE_smash"));
    let arguments = command.split_whitespace().skip(1);
    let output = smash.args(arguments).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs the cuts that stand in `told`, and counts them.
fn cut(folder: &Path, told: &str) -> usize {
    let mut lines = told.lines();
    let cuts = lines.find_map(|line| line.find("smash cut ").map(|place| &line[place..])).unwrap();
    cuts.split(" && ").inspect(|command| drop(typed(folder, command))).count()
}

fn diagnosis(scene: &Scene) -> Diagnosis {
    smash::diagnose(scene, &RefinedOptions::default(), &[]).unwrap()
}

/// What is missing without the poses of the contact, which explain all that is left.
fn without_contact(otherwise: Option<Otherwise>) -> (NearCollision, Vec<String>) {
    match otherwise {
        Some(Otherwise { cause: Cause::NearCollision(near), missing, .. }) if !near.leaves_more => {
            (near, missing)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_contact_that_lasts_may_be_all_that_is_left() {
    let simulation = with(dense(plain_balls(61)), &[]);
    let told = diagnosis(&softened(&simulation));
    let (near, missing) = without_contact(told.otherwise.clone());
    assert!(missing.is_empty(), "{}", told.explanation);
    let collision_s = simulation.truth.collision_time;
    assert!((near.from_time..near.to_time).contains(&collision_s), "{near:?}, {collision_s}");
    assert!(told.explanation.contains("Or it is the contact"), "{}", told.explanation);
    assert!(told.advice.contains(&told.otherwise.unwrap().mend), "{:?}", told.advice);
}

/// The command that is printed leaves exactly these poses out, and then nothing is missing.
#[test]
fn the_poses_of_a_contact_are_cut_by_the_command_that_is_printed() {
    let scene = softened(&with(dense(plain_balls(61)), &[]));
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("soft.json"), scene.to_file().to_json()).unwrap();
    let told = typed(folder.path(), "smash diagnose soft.json -o soft.diagnosis.json");
    assert_eq!(cut(folder.path(), &told), 1);
    let file = std::fs::read_to_string(folder.path().join("soft.diagnosis.json")).unwrap();
    let (near, _) = without_contact(serde_json::from_str::<Diagnosis>(&file).unwrap().otherwise);
    let count = |scene: &Scene| -> usize {
        scene.bodies().iter().map(|body| body.observations.len()).sum()
    };
    let rest = Scene::read(folder.path().join("cut.json")).unwrap();
    assert_eq!(count(&rest), count(&scene) - near.poses);
    assert_eq!(diagnosis(&rest).verdict, smash::diagnose::Verdict::NothingMissing);
}

#[test]
fn beside_a_contact_that_lasts_the_effect_is_told_that_is_missing() {
    let drag = effect("quadratic_drag", Some("a"), &[("k", &[0.2])]);
    let scene = softened(&with(dense(plain_balls(62)), &[drag]));
    let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
    let (_, missing) = without_contact(improvement.otherwise);
    assert_eq!(missing, ["quadratic_drag@a"]);
}

/// Each throw has a contact of its own; the drag that they share is told beside it, with its size.
#[test]
fn the_contacts_of_several_throws_are_told_and_cut() {
    const K: f64 = 0.2;
    let folder = tempfile::tempdir().unwrap();
    for seed in [62, 64] {
        let drag = effect("quadratic_drag", Some("a"), &[("k", &[K])]);
        let scene = softened(&with(dense(plain_balls(seed)), &[drag]));
        let file = folder.path().join(format!("soft_{seed}.json"));
        std::fs::write(file, scene.to_file().to_json()).unwrap();
    }
    let told = typed(folder.path(), "smash improve soft_62.json soft_64.json -o soft.json");
    let file = std::fs::read_to_string(folder.path().join("soft.json")).unwrap();
    let improvement: Improvement = serde_json::from_str(&file).unwrap();
    let otherwise = improvement.otherwise.unwrap();
    assert_eq!(otherwise.missing, ["quadratic_drag@a"]);
    assert!(told.contains(&otherwise.words), "{told}");
    let Cause::NearCollisions(NearCollisions { throws, leaves_more: false }) = otherwise.cause
    else {
        panic!("{otherwise:?}")
    };
    assert_eq!(throws.len(), 2);
    assert_eq!(cut(folder.path(), &told), 2);
    let again = typed(folder.path(), "smash improve cut_1.json cut_2.json --json");
    let again: Improvement = serde_json::from_str(&again).unwrap();
    let drag = &again.ladder[1].parameters["k"];
    let (Some(Number::Scalar(k)), Some(Number::Scalar(std))) = (&drag.value, &drag.std) else {
        panic!("{drag:?}")
    };
    assert!((k - K).abs() < 4.0 * std, "{k} ± {std}");
    let diagnosis = typed(folder.path(), "smash diagnose soft_62.json soft_64.json");
    assert!(
        diagnosis.contains("Without them quadratic_drag@a is all that is missing"),
        "{diagnosis}"
    );
}

/// A force bends whole flights, also where no effect explains it.
#[test]
fn a_force_is_no_lasting_contact() {
    let law = format!("{}/examples/effects/tether.toml", env!("CARGO_MANIFEST_DIR"));
    let tether: [(&str, &[f64]); 3] =
        [("stiffness", &[3.0]), ("length", &[0.9]), ("anchor", &[0.3, 2.2, -0.4])];
    let told = diagnosis(&with(dense(plain_balls(63)), &[effect(&law, Some("a"), &tether)]).scene);
    assert!(!told.explanation.contains("Or it is the contact"), "{}", told.explanation);
}
