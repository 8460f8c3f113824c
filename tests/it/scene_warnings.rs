//! What is allowed but odd gets a warning, and what is in order gets none.

use serde_json::{Value, json};
use smash::Scene;

use crate::scenes::{edited, two_boxes};

/// The only warning of a scene.
fn only_warning(value: &Value) -> String {
    let scene = Scene::parse(&value.to_string(), "odd.json").unwrap();
    match scene.warnings() {
        [one] => one.to_string(),
        other => panic!("one warning expected: {other:#?}"),
    }
}

fn poses(scene: &mut Value, body: usize) -> &mut Vec<Value> {
    scene["bodies"][body]["observations"].as_array_mut().unwrap()
}

/// Multiplies what is given of positions and sizes.
fn scale(scene: &mut Value, positions: f64, sizes: f64) {
    let scaled = |value: &mut Value, factor: f64| *value = json!(value.as_f64().unwrap() * factor);
    for body in scene["bodies"].as_array_mut().unwrap() {
        for pose in body["observations"].as_array_mut().unwrap() {
            pose["position"].as_array_mut().unwrap().iter_mut().for_each(|x| scaled(x, positions));
        }
        match body["shape"]["type"].as_str() {
            Some("sphere") => scaled(&mut body["shape"]["radius"], sizes),
            _ => body["shape"]["size"]
                .as_array_mut()
                .unwrap()
                .iter_mut()
                .for_each(|x| scaled(x, sizes)),
        }
    }
}

/// All warnings of the scene after lengths were multiplied.
fn warnings_when_scaled(positions: f64, sizes: f64) -> Vec<String> {
    let value = edited(two_boxes(), |s| scale(s, positions, sizes));
    let scene = Scene::parse(&value.to_string(), "scaled.json").unwrap();
    scene.warnings().iter().map(ToString::to_string).collect()
}

#[test]
fn times_out_of_order_are_sorted_and_told() {
    let value = edited(two_boxes(), |s| poses(s, 0).swap(2, 3));
    let warning = only_warning(&value);
    assert!(warning.contains("body `a`") && warning.contains("[3]"), "{warning}");
    let scene = Scene::parse(&value.to_string(), "odd.json").unwrap();
    let ordered = Scene::parse(&two_boxes().to_string(), "good.json").unwrap();
    assert_eq!(scene.bodies(), ordered.bodies());
}

#[test]
fn a_repeated_pose_is_kept_once_and_told() {
    let value = edited(two_boxes(), |s| {
        let mut copy = poses(s, 1)[4].clone();
        // The same pose: a quaternion and its negative are one orientation.
        for part in copy["orientation"].as_array_mut().unwrap() {
            *part = json!(-part.as_f64().unwrap());
        }
        poses(s, 1).insert(5, copy);
    });
    let warning = only_warning(&value);
    assert!(warning.contains("observations[5] repeats"), "{warning}");
    assert_eq!(
        Scene::parse(&value.to_string(), "odd.json").unwrap().bodies()[1].observations.len(),
        10
    );
}

#[test]
fn a_slip_in_a_frame_number_is_told() {
    let value = edited(two_boxes(), |s| poses(s, 0)[9]["frame"] = json!(51));
    assert!(only_warning(&value).contains("uneven steps"));
}

#[test]
fn a_turn_of_nearly_half_a_turn_may_be_more() {
    // 3 rad in 3 frames: by the quaternions alone it could as well be 3.28 rad backwards.
    let value = edited(two_boxes(), |s| {
        for (index, pose) in poses(s, 0).iter_mut().enumerate() {
            let half = 1.5 * index as f64;
            pose["orientation"] = json!([half.cos(), 0.0, half.sin(), 0.0]);
        }
    });
    assert!(only_warning(&value).contains("172° or 188°"), "{}", only_warning(&value));
}

#[test]
fn a_spin_that_outruns_a_longer_step_is_told() {
    // 0.6 rad a frame: 1.8 rad a step, but 3.6 rad over the missing pose, seen as 2.68 rad.
    let value = edited(two_boxes(), |s| {
        for pose in poses(s, 0) {
            let half = 0.3 * pose["frame"].as_f64().unwrap();
            pose["orientation"] = json!([half.cos(), 0.0, half.sin(), 0.0]);
        }
    });
    let warning = only_warning(&value);
    assert!(warning.contains("154° or 206°") && warning.contains("(1 such"), "{warning}");
}

#[test]
fn fewer_than_three_poses_on_a_side_are_told() {
    let value = edited(two_boxes(), |s| {
        poses(s, 0).drain(..3);
        poses(s, 1).drain(..3);
    });
    // 2 before and 5 after; a later gap would have 3 or more before, and leave 3 after.
    let scene = Scene::parse(&value.to_string(), "few.json").unwrap();
    assert_eq!(scene.warnings(), [], "any gap counts: where the collision is isn't known yet");
    let value = edited(value, |s| {
        poses(s, 0).truncate(5);
        poses(s, 1).truncate(5);
    });
    assert!(only_warning(&value).contains("fewer than 3 poses"));
}

#[test]
fn a_box_without_orientations_is_told_and_a_ball_is_not() {
    let value = edited(two_boxes(), |s| {
        for body in 0..2 {
            poses(s, body).iter_mut().for_each(|pose| pose["orientation"] = json!(null));
        }
    });
    let warning = only_warning(&value);
    assert!(warning.contains("body `a`: a box with 0 orientations"), "{warning}");
}

#[test]
fn lengths_in_other_units_are_told_by_their_fall() {
    for (factor, unit) in [(1000.0, "mm"), (100.0, "cm"), (39.37, "inches"), (3.281, "feet")] {
        let warnings = warnings_when_scaled(factor, factor);
        let looks = format!("look like {unit}\n");
        assert!(
            warnings.len() == 2 && warnings.iter().all(|one| one.contains(&looks)),
            "{warnings:?}"
        );
    }
}

#[test]
fn a_wrong_scale_of_a_few_percent_is_physics_not_a_unit() {
    // It is the diagnosis that finds these: a gravity scale.
    for factor in [0.8, 1.2, 2.0] {
        assert_eq!(warnings_when_scaled(factor, 1.0), [""; 0], "{factor}");
    }
}

#[test]
fn sizes_in_millimetres_beside_positions_in_metres_are_told() {
    let warnings = warnings_when_scaled(1.0, 1000.0);
    assert!(warnings.len() == 2 && warnings[0].contains("size of 100 m"), "{warnings:?}");
}

#[test]
fn gravity_in_centimetres_is_told() {
    let value = edited(two_boxes(), |s| {
        scale(s, 100.0, 1.0);
        s["gravity"] = json!(981);
    });
    assert!(only_warning(&value).contains("981 m/s², which looks like cm/s²"));
}

#[test]
fn an_up_that_points_down_or_aside_is_told() {
    for up in [[0, -1, 0], [1, 0, 0], [0, 0, -1]] {
        let warnings = warnings_with("up", json!(up));
        let told = "`up` seems to be [0, 1, 0]";
        assert!(
            warnings.len() == 2 && warnings.iter().all(|one| one.contains(told)),
            "{warnings:?}"
        );
    }
}

/// A frame rate enters a fall with its square; one that is a little off is a gravity scale.
#[test]
fn a_frame_rate_that_is_far_from_a_usual_one_is_told() {
    let fps = two_boxes()["fps"].as_f64().unwrap();
    for factor in [0.4, 0.5, 2.0] {
        let warnings = warnings_with("fps", json!(factor * fps));
        let told = format!("`fps` seems to be {fps}");
        let are_all = warnings.iter().all(|one| one.contains(&told));
        assert!(warnings.len() == 2 && are_all, "{factor}: {warnings:?}");
    }
    assert_eq!(warnings_with("fps", json!(1.2 * fps)), [""; 0]);
}

/// What two boxes are warned about with another value of a field.
fn warnings_with(field: &str, value: serde_json::Value) -> Vec<String> {
    let value = edited(two_boxes(), |s| s[field] = value.clone());
    let scene = Scene::parse(&value.to_string(), "scene.json").unwrap();
    scene.warnings().iter().map(|one| one.text.clone()).collect()
}

/// Between two poses before it and two after it the collision can be nowhere else, however long it
/// takes; a step as long among more poses is odd.
#[test]
fn the_only_gap_for_the_collision_may_be_long() {
    let spaced = |frames: [i32; 5], count: usize| {
        edited(two_boxes(), |s| {
            for body in 0..2 {
                poses(s, body).truncate(count);
                for (pose, frame) in poses(s, body).iter_mut().zip(frames) {
                    pose["frame"] = json!(frame);
                }
            }
        })
    };
    let told = |value: Value| {
        let scene = Scene::parse(&value.to_string(), "gap.json").unwrap();
        scene.warnings().iter().any(|one| one.text.contains("uneven steps"))
    };
    assert!(!told(spaced([0, 6, 66, 72, 0], 4)));
    assert!(told(spaced([0, 6, 12, 18, 78], 5)));
}
