//! A result's motion, sampled: continuous at the collision, along the parabola, through the poses.

use nalgebra::Vector3;
use smash::effect::EffectRequest;
use smash::reconstruct::RefinedOptions;
use smash::{Options, Scene, motion, reconstruct};

fn scene(name: &str) -> Scene {
    Scene::read(format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

#[test]
fn both_sides_meet_at_the_collision() {
    for name in ["boxes", "ball_on_floor", "box_on_floor", "uneven_times"] {
        let scene = scene(name);
        let result = reconstruct(&scene, &Options::default()).unwrap();
        let motion = motion(&scene, &result, 240.0).unwrap().unwrap();
        for (body, known) in motion.bodies.iter().zip(&result.bodies) {
            let (before, after) = (&body.before, &body.after);
            let time_s = motion.collision_time;
            // The last sample before is a nanosecond early: some nanometres.
            let apart = |a: [f64; 3], b: [f64; 3]| (Vector3::from(a) - Vector3::from(b)).norm();
            assert!((before.times.last().unwrap() - time_s).abs() < 1e-12, "{name}");
            assert_eq!(after.times[0], time_s, "{name}");
            assert!(apart(*before.positions.last().unwrap(), known.position) < 1e-7, "{name}");
            assert!(apart(after.positions[0], known.position) < 1e-12, "{name}");
            assert!(apart(after.velocities[0], known.velocity_after) < 1e-12, "{name}");
            assert!(
                apart(*before.velocities.last().unwrap(), known.velocity_before) < 1e-7,
                "{name}"
            );
            for track in [before, after] {
                for pair in track.orientations.iter().flat_map(|all| all.windows(2)) {
                    let dot: f64 = pair[0].iter().zip(&pair[1]).map(|(a, b)| a * b).sum();
                    assert!(dot > 0.9, "{name}: a jump of sign or of pose, {dot}");
                }
                assert!(track.times.windows(2).all(|pair| pair[0] < pair[1]), "{name}");
            }
        }
    }
}

/// Without forces but gravity second differences are g, whatever the rest.
#[test]
fn free_flight_is_a_parabola() {
    let scene = scene("boxes");
    let result = reconstruct(&scene, &Options::default()).unwrap();
    let motion = motion(&scene, &result, 100.0).unwrap().unwrap();
    let gravity = Vector3::from(result.gravity.unwrap());
    for track in motion.bodies.iter().flat_map(|body| [&body.before, &body.after]) {
        let at = |i: usize| Vector3::from(track.positions[i]);
        let step = track.times[1] - track.times[0];
        for i in 1..track.times.len() - 1 {
            let second = (at(i + 1) - 2.0 * at(i) + at(i - 1)) / (step * step);
            // Rounding of a metre, 1e-16, over the step's square of 1e-4; stamps are good to 1e-9 of
            // a step of 1e-2.
            assert!((second - gravity).norm() < 1e-5, "{second}");
        }
    }
}

/// A wrong annotation is no motion: by the law of the effect the first pose is a metre off.
#[test]
fn a_wrong_pose_moves_nothing() {
    let scene = scene("boxes");
    let first_s = scene.bodies()[0].observations[0].time_s;
    let mut options = RefinedOptions::default();
    let wrong = format!("outlier@a:time={first_s},shift=[1,0,0],turn=[0,0,0]");
    options.effects.push(EffectRequest::parse(&wrong).unwrap());
    let result = reconstruct(&scene, &Options::Refined(options)).unwrap();
    let motion = motion(&scene, &result, 60.0).unwrap().unwrap();
    for pair in motion.bodies[0].before.positions.windows(2) {
        let moved = (Vector3::from(pair[0]) - Vector3::from(pair[1])).norm();
        assert!(moved < 0.5, "{moved} m within a frame");
    }
}

/// A body whose clock is late meets the other by its own stamp: the way has its bend there.
#[test]
fn a_late_clock_moves_the_meeting() {
    let scene = scene("boxes");
    let mut options = RefinedOptions::default();
    options.effects.push(EffectRequest::parse("time_offset@b:delay=-0.02").unwrap());
    let result = reconstruct(&scene, &Options::Refined(options)).unwrap();
    let motion = motion(&scene, &result, 60.0).unwrap().unwrap();
    let [a, b] = motion.bodies.as_slice() else { panic!() };
    assert_eq!(a.after.times[0], motion.collision_time);
    assert!((b.after.times[0] - motion.collision_time).abs() > 0.01, "{}", b.after.times[0]);
    for (body, known) in motion.bodies.iter().zip(&result.bodies) {
        assert_eq!(body.before.times.last(), body.after.times.first());
        let near = |found: [f64; 3], expected: [f64; 3]| {
            let apart = (Vector3::from(found) - Vector3::from(expected)).norm();
            assert!(apart < 1e-9, "{}: {apart}", body.name);
        };
        near(*body.before.positions.last().unwrap(), known.position);
        near(body.after.positions[0], known.position);
        near(*body.before.velocities.last().unwrap(), known.velocity_before);
        near(body.after.velocities[0], known.velocity_after);
    }
}
