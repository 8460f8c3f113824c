//! The motion in a result, and what it leaves of the poses.

use std::fs;

use serde_json::{Value, json};
use smash::compare::{Channel, Segment};
use smash::{Reconstruction, Scene, compare};

use super::{SCENES, assert_near, compared, paper, quantity, refined, scene, scene_path};
use crate::scenes::edited;

/// A result's numbers are enough to fly its bodies again. The refined solver's integrator is good to
/// far below the noise, so a thousandth of it is room enough; the paper's parabolas are the same
/// closed form, once gravity is tilted as the fit found it.
#[test]
fn the_motion_in_a_result_leaves_the_error_that_it_reports() {
    for name in SCENES {
        let scene = scene(name);
        let (paper, refined) = (paper(&scene), refined(&scene));
        let comparison = compared(&scene, &[&paper, &refined]);
        let [of_paper, of_refined] = comparison.results.as_slice() else { panic!("two results") };
        let position = |one: &Reconstruction| one.fit.position_rmse;
        assert_near(of_paper.position_rmse.unwrap(), position(&paper), 1e-9, name);
        assert_near(of_refined.position_rmse.unwrap(), position(&refined), 1e-9, name);
        match refined.fit.orientation_rmse {
            Some(angle) => assert_near(of_refined.orientation_rmse.unwrap(), angle, 1e-3, name),
            None => assert_eq!(of_refined.orientation_rmse, None, "{name}"),
        }
    }
}

/// Without the fitted tilt the same numbers miss the poses by more: the field is what tells.
#[test]
fn without_gravity_in_the_file_the_scenes_is_taken() {
    let scene = scene("boxes");
    let paper = paper(&scene);
    let mut older = paper.clone();
    older.gravity = None;
    let mut upright = paper.clone();
    upright.gravity = Some([0.0, -9.81, 0.0]);
    let comparison = compared(&scene, &[&paper, &older, &upright]);
    let rmse = |index: usize| comparison.results[index].position_rmse.unwrap();
    assert!((rmse(1) - rmse(0)).abs() > 1e-6);
    assert_eq!(rmse(1), rmse(2));
}

/// One annotation that is off shows in its channel, at its time, and nowhere else.
#[test]
fn a_wrong_pose_is_found() {
    let text = fs::read_to_string(scene_path("boxes")).unwrap();
    let original: Value = serde_json::from_str(&text).unwrap();
    let refined = refined(&scene("boxes"));
    let poses = |side: std::cmp::Ordering| {
        let time = refined.collision_time.value.unwrap();
        let seen = original["bodies"][1]["observations"].as_array().unwrap();
        let fps = original["fps"].as_f64().unwrap();
        seen.iter()
            .map(|one| one["frame"].as_f64().unwrap() / fps)
            .position(|t| t.total_cmp(&time) == side)
            .unwrap()
    };
    let index = poses(std::cmp::Ordering::Greater) + 1;
    let wrong = edited(original.clone(), |scene| {
        let x = &mut scene["bodies"][1]["observations"][index]["position"][0];
        *x = json!(x.as_f64().unwrap() + 0.05);
    });
    let wrong = Scene::parse(&wrong.to_string(), "scene.json").unwrap();
    let comparison = compared(&wrong, &[&refined]);
    let failing: Vec<_> = comparison.results[0]
        .channels
        .iter()
        .filter(|one| one.stands_out == Some(true))
        .map(|one| (one.body.as_str(), one.segment, one.channel))
        .collect();
    assert_eq!(failing, [("b", Segment::After, Channel::Position)]);
    let one = comparison.results[0].channels.iter().find(|one| one.stands_out == Some(true));
    let largest = &one.unwrap().largest;
    assert_eq!(largest.time, wrong.bodies()[1].observations[index].time_s);
    // 50 mm, but for the noise of that pose.
    assert!((largest.size - 0.05).abs() < 0.01, "{} m", largest.size);
    assert_eq!(largest.in_sigma, Some(largest.size / 0.002));
    let [outlier] = comparison.results[0].outliers.as_slice() else { panic!("one wrong pose") };
    assert_eq!((outlier.body.as_str(), outlier.time), ("b", largest.time));
    assert_eq!(
        (outlier.channel.as_str(), Some(outlier.deviations)),
        ("position", largest.in_sigma)
    );
    let right = compared(&scene("boxes"), &[&refined]);
    assert_eq!((&right.results[0].outliers, &right.results[0].findings), (&vec![], &vec![]));
    assert!(
        compared(&scene("boxes"), &[&refined]).results[0]
            .channels
            .iter()
            .all(|one| one.stands_out == Some(false))
    );
}

/// The scene's noise if it states one, else that of the first result that has one, else none.
#[test]
fn residuals_are_told_in_the_noise_that_is_known() {
    let scene = scene("uneven_times");
    assert_eq!(scene.noise(), None);
    let (paper, refined) = (paper(&scene), refined(&scene));
    let both = compared(&scene, &[&paper, &refined]);
    let noise = both.noise.unwrap();
    assert_eq!(noise.from_result.as_deref(), Some("second"));
    assert_eq!(noise.position, refined.noise.as_ref().unwrap().position);
    let alone = compared(&scene, &[&paper]);
    assert_eq!(alone.noise, None);
    for one in &alone.results[0].channels {
        assert_eq!((one.rmse_in_sigma, one.stands_out, one.largest.in_sigma), (None, None, None));
    }
}

/// Without what a motion needs there are no residuals of it, and a reason.
#[test]
fn what_a_result_does_not_tell_is_not_compared() {
    let scene = scene("boxes");
    let good = refined(&scene);
    let mut spinless = good.clone();
    spinless.bodies[1].angular_velocity_after = None;
    let mut timeless = good.clone();
    timeless.collision_time.value = None;
    let comparison = compared(&scene, &[&good, &spinless, &timeless]);
    let [of_good, of_spinless, of_timeless] = comparison.results.as_slice() else {
        panic!("three results")
    };
    assert_eq!((of_good.channels.len(), &of_good.reason), (8, &None));
    assert_eq!(of_spinless.channels.len(), 7);
    assert!(of_spinless.reason.as_ref().unwrap().contains("spins"));
    assert_eq!((of_timeless.channels.len(), of_timeless.position_rmse), (0, None));
    assert!(of_timeless.reason.as_ref().unwrap().contains("collision time"));
    let spin = &quantity(&comparison, "b.angular_velocity_after");
    assert_eq!((spin.entries[1].value.as_ref(), spin.differences[0].size), (None, None));
    assert!(spin.entries[1].reason.is_some());
}

/// Gravity along the floor is no gravity upwards.
#[test]
fn where_gravity_cannot_be_the_scenes_it_says_how() {
    let scene = scene("boxes");
    for (gravity, told) in [([9.81, 0.0, 0.0], "sideways"), ([0.0, 9.81, 0.0], "upwards")] {
        let mut result = refined(&scene);
        result.gravity = Some(gravity);
        let error = compare(&scene, &[("result".to_string(), result)]).unwrap_err();
        assert!(error.to_string().contains(told), "{error}");
    }
}
