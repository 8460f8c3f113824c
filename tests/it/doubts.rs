//! What the data don't determine is null with a reason, and what is doubtful is flagged.

use smash::reconstruct::Flag;
use smash::scene::{Noise, SceneFile};
use smash::simulate::{NoiseSpec, RegularSampling, Sampling, SimulationSpec, add_noise, simulate};
use smash::{Options, Reconstruction, Scene, reconstruct};

const NOISE: NoiseSpec = NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 });

fn every(interval: u32, frame_count: u32) -> Sampling {
    Sampling::Regular(RegularSampling { interval, frame_count, gap: None })
}

fn seen(mut spec: SimulationSpec, sampling: Sampling) -> SceneFile {
    spec.observations = sampling;
    simulate(&spec).unwrap().scene_file
}

fn solve(file: SceneFile) -> Reconstruction {
    reconstruct(&Scene::from_file(file).unwrap(), &Options::default()).unwrap()
}

fn without_orientations(mut file: SceneFile) -> SceneFile {
    for observation in file.bodies.iter_mut().flat_map(|b| b.observations.iter_mut().flatten()) {
        observation.orientation = None;
    }
    file
}

/// Balls that fly past each other as if nothing were there: b's positions are those of another
/// time. The search picks the largest of all jumps that noise feigns, so a test that knew nothing
/// of the search would find an impulse in a third of the scenes.
#[test]
fn balls_that_never_touch_have_no_mass_ratio() {
    let mut false_alarms = 0;
    for seed in 0..20 {
        let mut file = seen(SimulationSpec::random_balls(seed), every(6, 90));
        for body in &mut file.bodies {
            // One parabola throughout: that of the first two poses.
            let poses = body.observations.as_mut().unwrap();
            let fps = 60.0;
            let at = |i: usize| (poses[i].frame.unwrap() / fps, poses[i].position);
            let ((t0, p0), (t1, p1)) = (at(0), at(1));
            for pose in poses.iter_mut() {
                let t = pose.frame.unwrap() / fps;
                pose.position = std::array::from_fn(|i| {
                    let g = if i == 1 { -9.81 } else { 0.0 };
                    let v = (p1[i] - p0[i]) / (t1 - t0) - 0.5 * g * (t1 - t0);
                    p0[i] + v * (t - t0) + 0.5 * g * (t - t0) * (t - t0)
                });
            }
        }
        let result = solve(add_noise(file, &NOISE, seed));
        match result.mass_ratio.unwrap().value {
            None => assert!(result.flags.contains(&Flag::NoVisibleImpulse), "seed {seed}"),
            Some(_) => false_alarms += 1,
        }
    }
    // One body in twenty by construction, hence up to one scene in ten: 5 of 20 or more would
    // come about once in 25 such tests; these seeds are fixed.
    assert!(false_alarms < 5, "{false_alarms} of 20");
}

/// A true hit isn't taken for noise.
#[test]
fn balls_that_hit_each_other_have_a_mass_ratio() {
    for seed in 0..10 {
        let file = seen(SimulationSpec::random_balls(seed), every(6, 90));
        let result = solve(add_noise(file, &NOISE, seed));
        assert!(result.mass_ratio.unwrap().value.is_some(), "seed {seed}");
        assert!(!result.flags.contains(&Flag::NoVisibleImpulse), "seed {seed}");
    }
}

/// A ball that only falls meets no plane: there is nothing to report of a contact.
#[test]
fn a_fall_without_a_bounce_is_flagged() {
    let mut file = seen(SimulationSpec::random_ball_drop(1), every(5, 80));
    for pose in file.bodies[0].observations.as_mut().unwrap() {
        let t = pose.frame.unwrap() / 120.0;
        pose.position = [0.3 * t, 2.0 - 4.905 * t * t, 0.0];
    }
    let results = (0..20).map(|seed| solve(add_noise(file.clone(), &NOISE, seed)));
    let (flagged, alarms): (Vec<_>, Vec<_>) =
        results.partition(|result| result.flags.contains(&Flag::NoVisibleImpulse));
    for result in &flagged {
        assert_eq!(result.restitution.value, None);
        assert!(result.restitution.reason.is_some());
        assert_eq!(result.contact_point, None);
    }
    // At most one search in twenty by construction: three or more of 20 would come about once in
    // 13 such tests; these seeds are fixed.
    assert!(alarms.len() < 3, "{} of 20", alarms.len());
}

/// The points that touch turn with the body: without its spin their velocity isn't known. A smooth
/// ball's impulse passes through its centre, so there it doesn't matter.
#[test]
fn the_restitution_of_boxes_needs_their_spins_and_of_balls_does_not() {
    let boxes = without_orientations(seen(SimulationSpec::random_cuboids(2), every(9, 90)));
    let result = solve(boxes);
    assert_eq!(result.restitution.value, None);
    assert!(result.restitution.reason.unwrap().contains("spins"));
    assert_eq!(result.contact_point, None);
    assert!(result.mass_ratio.unwrap().value.is_some(), "velocities alone tell it");

    let balls = seen(SimulationSpec::random_balls(2), every(9, 90));
    assert!(balls.bodies.iter().all(|b| b.observations.as_ref().unwrap()[0].orientation.is_none()));
    assert!(solve(balls).restitution.value.is_some());
}

/// Along the impulse the contact point isn't determined; the plane settles it.
#[test]
fn the_contact_point_lies_on_the_plane() {
    for spec in [SimulationSpec::random_box_drop(1), SimulationSpec::random_ball_drop(1)] {
        let plane = spec.bodies.iter().find(|body| body.is_static == Some(true)).unwrap();
        let (normal, height) = (plane.normal.unwrap(), plane.height.unwrap());
        let point = solve(seen(spec, every(5, 80))).contact_point.unwrap();
        let above: f64 = point.iter().zip(normal).map(|(x, n)| x * n).sum::<f64>() - height;
        // Rounding of metres.
        assert!(above.abs() < 1e-9, "{above} m above the plane");
    }
}

/// Quaternions written in another order than they are read are a classic: the fit shows it.
#[test]
fn a_swapped_quaternion_order_is_a_poor_fit() {
    let exact = seen(SimulationSpec::random_cuboids(2), every(9, 90));
    let annotated = add_noise(exact, &NOISE, 0);
    let mut swapped = annotated.clone();
    for pose in swapped.bodies.iter_mut().flat_map(|b| b.observations.iter_mut().flatten()) {
        let [w, x, y, z] = pose.orientation.unwrap();
        pose.orientation = Some([x, y, z, w]);
    }
    assert!(!solve(annotated).flags.contains(&Flag::PoorFit));
    assert!(solve(swapped).flags.contains(&Flag::PoorFit));
}
