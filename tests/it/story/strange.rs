//! Scenes that show little, or are unlike what the other stories are told of: always numbers or words.

use serde_json::{Value, json};
use smash::diagnose::Verdict;
use smash::reconstruct::RefinedOptions;

use super::*;

fn value(spec: SimulationSpec) -> Value {
    serde_json::from_str(&simulate(&spec).unwrap().scene_file.to_json()).unwrap()
}

/// Keeps `count` poses of each body on each side of the collision, the nearest.
fn only_nearest(scene: &mut Value, spec: &SimulationSpec, count: usize) {
    let frame = spec.collision.time * spec.fps.unwrap();
    for body in scene["bodies"].as_array_mut().unwrap() {
        let Some(poses) = body.get_mut("observations").and_then(Value::as_array_mut) else {
            continue;
        };
        let before = poses.iter().filter(|pose| pose["frame"].as_f64().unwrap() < frame).count();
        *poses = poses[before - count..before + count].to_vec();
    }
}

/// Diagnosis and improvement are given, and fit their schemas; or a message says what to mend.
fn assert_tells(what: &str, scene: &Value) -> Option<Verdict> {
    let scene = Scene::parse(&scene.to_string(), what).unwrap();
    let options = RefinedOptions::default();
    let told = smash::diagnose(&scene, &options, &[]);
    let improved = smash::improve(&scene, &options, &[]);
    for error in [told.as_ref().err(), improved.as_ref().err()].into_iter().flatten() {
        assert!(error.hint().is_some(), "{what}: {error}");
    }
    let (told, improved) = (told.ok()?, improved.ok()?);
    assert!(!told.explanation.is_empty() && !told.advice.is_empty(), "{what}");
    assert_fits(SchemaKind::Diagnosis, &told.to_json());
    assert_fits(SchemaKind::Improvement, &improved.to_json());
    let total: f64 = told.candidates.iter().map(|one| one.probability).sum();
    assert!(total + told.probability_of_nothing < 1.0 + 1e-9, "{what}: {total}");
    Some(told.verdict)
}

/// All of them are clean.
#[test]
fn scenes_that_show_little_are_not_suspected() {
    let [boxes_spec, drop_spec] = [boxes(4), box_on_floor(4)];
    let (pair, drop) = (value(boxes_spec.clone()), value(drop_spec.clone()));
    let mut cases = vec![
        ("plain balls", value(plain_balls(4))),
        ("a plain ball on a floor", value(annotated(SimulationSpec::random_ball_drop(4), 4))),
        ("no weight", value(SimulationSpec { gravity: 0.0, ..boxes_spec.clone() })),
    ];
    let mut edited = |what, scene: &Value, edit: &dyn Fn(&mut Value)| {
        let mut scene = scene.clone();
        edit(&mut scene);
        cases.push((what, scene));
    };
    edited("no camera", &pair, &|s| drop_key(s, "camera"));
    edited("no noise stated", &pair, &|s| drop_key(s, "noise"));
    edited("no noise stated on a floor", &drop, &|s| drop_key(s, "noise"));
    edited("one body alone", &drop, &|s| {
        s["bodies"].as_array_mut().unwrap().pop();
    });
    edited("one of two never turns up", &pair, &|s| {
        for pose in s["bodies"][1]["observations"].as_array_mut().unwrap() {
            pose["orientation"] = json!(null);
        }
    });
    for count in [2, 3] {
        edited("few poses", &pair, &|s| only_nearest(s, &boxes_spec, count));
        edited("few poses, no noise stated", &pair, &|s| {
            only_nearest(s, &boxes_spec, count);
            drop_key(s, "noise");
        });
        edited("few poses on a floor", &drop, &|s| only_nearest(s, &drop_spec, count));
    }
    for (what, scene) in &cases {
        let verdict = assert_tells(what, scene);
        assert!(matches!(verdict, None | Some(Verdict::NothingMissing)), "{what}: {verdict:?}");
    }
}

fn drop_key(scene: &mut Value, key: &str) {
    scene.as_object_mut().unwrap().remove(key);
}

/// Poses that no flight meets: garbage gets an answer too.
#[test]
fn poses_that_make_no_sense_are_not_explained() {
    smash::silence_solver_log();
    let spec = boxes(0);
    let mut scene = value(spec.clone());
    only_nearest(&mut scene, &spec, 4);
    let poses = scene["bodies"][0]["observations"].as_array_mut().unwrap();
    for (index, pose) in poses.iter_mut().enumerate() {
        let away = if index % 2 == 0 { 1.0 } else { -1.0 };
        pose["position"][0] = json!(away * (1.0 + 0.1 * index as f64));
    }
    let scene = Scene::parse(&scene.to_string(), "garbage").unwrap();
    match smash::diagnose(&scene, &RefinedOptions::default(), &[]) {
        Ok(told) => assert_eq!(told.verdict, Verdict::UnknownEffect, "{}", told.explanation),
        Err(error) => assert!(error.hint().is_some(), "{error}"),
    }
}

/// What a recorder's clock starts from is no physics: all is told as with the clock from zero, but for
/// the rounding of its stamps.
#[test]
fn where_the_clock_starts_does_not_matter() {
    let growing = format!("{}/examples/effects/growing_force.toml", env!("CARGO_MANIFEST_DIR"));
    let growing = effect(&growing, Some("a"), &[("growth", &[1.5, 0.0, 0.5])]);
    let hidden = with(boxes(5), &[growing]);
    let told = [0.0, 100.0].map(|start_s| {
        let mut scene: Value = serde_json::from_str(&hidden.scene_file.to_json()).unwrap();
        for body in scene["bodies"].as_array_mut().unwrap() {
            for pose in body["observations"].as_array_mut().unwrap() {
                let time_s = pose["frame"].as_f64().unwrap() / hidden.scene.fps().unwrap();
                drop_key(pose, "frame");
                pose["time"] = json!(start_s + time_s);
            }
        }
        let scene = Scene::parse(&scene.to_string(), "clock").unwrap();
        smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap()
    });
    let [zero, late] = told;
    assert_eq!(zero.verdict, late.verdict);
    assert!(!zero.other_laws.is_empty(), "{}", zero.explanation);
    let laws = |told: &smash::diagnose::Diagnosis| -> Vec<String> {
        told.other_laws.iter().map(|law| law.law.clone()).collect()
    };
    assert_eq!(laws(&zero), laws(&late));
    for (zero, late) in zero.other_laws.iter().zip(&late.other_laws) {
        let apart = (zero.delta_chi2 - late.delta_chi2).abs();
        assert!(apart < 1e-3 * zero.delta_chi2, "{zero:?} {late:?}");
    }
}
