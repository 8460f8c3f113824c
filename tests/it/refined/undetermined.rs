//! What the poses don't determine is null with a reason, never a number.

use nalgebra::{UnitQuaternion, Vector3};
use smash::Reconstruction;
use smash::reconstruct::{Estimate, Flag};
use smash::rigid_body::{RigidBody, rotate_freely};
use smash::scene::{BodyFile, ObservationFile, SCENE_SCHEMA, SceneFile, Shape};
use smash::simulate::{NoiseSpec, SimulationSpec, add_noise};

use super::{NOISE, every, solve, with_noise_stated, without_orientations};

fn assert_unknown(estimate: &Estimate, words: &str) {
    assert_eq!((estimate.value, estimate.std, estimate.interval_95), (None, None, None));
    let reason = estimate.reason.as_ref().unwrap();
    assert!(reason.contains(words), "{reason}");
}

/// A box in free flight, seen ten times in a second and a half.
fn in_flight(name: &str, position: [f64; 3], velocity: [f64; 3], spin: [f64; 3]) -> BodyFile {
    let shape = Shape::Box { size: [0.1, 0.2, 0.3] };
    let body = RigidBody::solid(&shape, 1.0).spinning(&Vector3::from(spin));
    let seen = |index: u32| {
        let t = 0.15 * f64::from(index);
        let fallen = Vector3::new(0.0, -0.5 * 9.81 * t * t, 0.0);
        let q: UnitQuaternion<f64> = rotate_freely(
            &body.world_from_body,
            &body.principal_inertia,
            &body.angular_momentum_in_world,
            t,
        );
        let at = Vector3::from(position) + t * Vector3::from(velocity) + fallen;
        ObservationFile {
            frame: None,
            time: Some(t),
            position: at.into(),
            orientation: Some([q.w, q.i, q.j, q.k]),
            noise_scale: None,
        }
    };
    BodyFile {
        name: name.into(),
        shape: Some(shape),
        observations: Some((0..10).map(seen).collect()),
        ..BodyFile::default()
    }
}

/// Two boxes that pass each other by a metre: nothing is known of a collision that wasn't.
#[test]
fn boxes_that_fly_past_each_other_have_no_collision() {
    let file = SceneFile {
        schema: SCENE_SCHEMA.into(),
        name: "past each other".into(),
        fps: None,
        up: [0.0, 1.0, 0.0],
        gravity: 9.81,
        noise: None,
        camera: None,
        source: None,
        bodies: vec![
            in_flight("a", [-1.0, 2.0, 0.0], [1.0, 5.0, 0.0], [1.0, 2.0, -1.0]),
            in_flight("b", [1.0, 2.0, 1.0], [-1.0, 5.5, 0.0], [0.5, -2.0, 1.5]),
        ],
    };
    // The impulse is tested so that noise feigns one in a scene out of twenty; these seeds don't.
    for seed in 0..4 {
        let result = solve(&add_noise(file.clone(), &NoiseSpec::Gaussian(NOISE), seed));
        assert!(result.flags.contains(&Flag::NoVisibleImpulse), "seed {seed}");
        let words = "don't stand out of the noise";
        assert_unknown(result.mass_ratio.as_ref().unwrap(), words);
        assert_unknown(&result.restitution, words);
        assert_unknown(&result.collision_time, words);
        assert_eq!((result.contact_point, result.normal), (None, None), "seed {seed}");
        // The flights themselves are known.
        assert!(result.bodies.iter().all(|body| body.angular_velocity_before.is_some()));
    }
}

fn assert_no_spin(result: &Reconstruction) {
    for body in &result.bodies {
        assert_eq!(body.orientation, None);
        assert_eq!((body.angular_velocity_before, body.angular_velocity_after), (None, None));
        assert_eq!((body.angular_momentum_before, body.angular_momentum_after), (None, None));
        assert!(body.reason.as_ref().unwrap().contains("too few orientations"));
    }
}

/// A plain ball shows no spin; its restitution needs none, since the impulse goes through its
/// centre.
#[test]
fn plain_balls_have_no_spin() {
    for spec in [SimulationSpec::random_balls(1), SimulationSpec::random_ball_drop(1)] {
        let result = solve(&add_noise(every(9, spec).0, &NoiseSpec::Gaussian(NOISE), 1));
        assert_no_spin(&result);
        assert!(result.restitution.value.is_some() && result.restitution.std.is_some());
        let table = result.uncertainty.unwrap();
        for (name, std) in table.quantities.iter().zip(table.std) {
            let of_spin = name.contains("angular") || name.contains("orientation");
            assert!(!of_spin || std.is_none(), "{name}: {std:?}");
        }
    }
}

/// Boxes without orientations tell their mass ratio, but not what their surfaces did.
#[test]
fn boxes_without_orientations_have_no_restitution() {
    let file = without_orientations(every(9, SimulationSpec::random_cuboids(2)).0);
    let result = solve(&add_noise(file, &NoiseSpec::Gaussian(NOISE), 1));
    assert_no_spin(&result);
    assert_unknown(&result.restitution, "spins");
    assert_eq!(result.contact_point, None);
    assert!(result.mass_ratio.unwrap().std.is_some());
}

/// A mass ratio needs a jump of both bodies: of one that is hit too weakly to be seen there is
/// a bound at best.
#[test]
fn a_body_that_hardly_moves_has_no_mass_ratio() {
    let (mut file, _) = every(9, SimulationSpec::random_balls(1));
    // b flies on as if nothing were: the parabola of its first two poses.
    let fps = file.fps.unwrap();
    let b = file.bodies[1].observations.as_mut().unwrap();
    let time = |pose: &ObservationFile| pose.frame.unwrap() / fps;
    let (t0, p0) = (time(&b[0]), Vector3::from(b[0].position));
    let (t1, p1) = (time(&b[1]), Vector3::from(b[1].position));
    let g = Vector3::new(0.0, -9.81, 0.0);
    let v = (p1 - p0) / (t1 - t0) - 0.5 * g * (t1 - t0);
    for pose in b {
        let t = time(pose) - t0;
        pose.position = (p0 + v * t + 0.5 * t * t * g).into();
    }
    for seed in 0..4 {
        let result = solve(&add_noise(file.clone(), &NoiseSpec::Gaussian(NOISE), seed));
        assert!(result.flags.contains(&Flag::MassRatioUnidentifiable), "seed {seed}");
        assert!(!result.flags.contains(&Flag::NoVisibleImpulse), "seed {seed}");
        assert_unknown(result.mass_ratio.as_ref().unwrap(), "bound");
    }
}

/// A box that bounces on a floor, with orientations of the poses numbered so; five on each side.
fn box_on_floor(oriented: &[usize]) -> SceneFile {
    let (mut file, truth) = every(4, SimulationSpec::random_box_drop(1));
    let fps = file.fps.unwrap();
    let seen = file.bodies[0].observations.as_mut().unwrap();
    let first_after = seen.partition_point(|pose| pose.frame.unwrap() < fps * truth.collision_time);
    *seen = seen[first_after - 5..first_after + 5].to_vec();
    for (index, pose) in seen.iter_mut().enumerate() {
        pose.orientation = pose.orientation.filter(|_| oriented.contains(&index));
    }
    file
}

/// Two orientations before tell the spin before. After it there is none: the torque, hence the point
/// of contact and its velocity, could be any. That holds for exact poses too, whose noise is found
/// to be a billionth of a metre.
#[test]
fn a_spin_after_that_nobody_saw_is_not_made_up() {
    let exact = box_on_floor(&[2, 4]);
    let noisy = add_noise(exact.clone(), &NoiseSpec::Gaussian(NOISE), 1);
    for file in [exact.clone(), with_noise_stated(exact), noisy] {
        let result = solve(&file);
        let body = &result.bodies[0];
        assert!(body.angular_velocity_before.is_some());
        assert_eq!((body.angular_velocity_after, body.angular_momentum_after), (None, None));
        assert_eq!(result.contact_point, None);
        assert_unknown(&result.restitution, "");
        assert!(result.collision_time.value.is_some());
    }
}

/// Three orientations are nine numbers for eight unknowns: with the noise stated all is known, but
/// one spare number doesn't tell the noise.
#[test]
fn deviations_need_a_noise() {
    let noisy = add_noise(box_on_floor(&[2, 4, 6]), &NoiseSpec::Gaussian(NOISE), 1);
    let stated = solve(&noisy);
    assert!(stated.restitution.std.is_some() && stated.uncertainty.is_some());
    let untold = solve(&SceneFile { noise: None, ..noisy });
    assert!(untold.restitution.value.is_some());
    assert_eq!((untold.restitution.std, untold.restitution.interval_95), (None, None));
    assert!(untold.restitution.reason.unwrap().contains("noise"));
    assert_eq!(untold.uncertainty, None);
}
