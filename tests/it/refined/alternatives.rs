//! Whole turns between poses that the poses can't tell: said, not chosen in silence.

use smash::scene::{Noise, SceneFile, Shape};
use smash::simulate::{
    BodySpec, CollisionSpec, NoiseSpec, SIMULATION_SCHEMA, Sampling, SimulationSpec, simulate,
};

use super::{every, solve, with_noise_stated};

/// A marked ball that bounces on a smooth floor while it spins about the vertical with 2 rad/s,
/// which the floor can't change, seen at `times`; the collision is at 0.02 s.
fn spinning_ball(times: &[f64]) -> SimulationSpec {
    let floor = BodySpec {
        name: "floor".into(),
        is_static: Some(true),
        normal: Some([0.0, 1.0, 0.0]),
        height: Some(0.0),
        ..BodySpec::default()
    };
    let ball = BodySpec {
        name: "ball".into(),
        shape: Some(Shape::Sphere { radius: 0.1 }),
        position: Some([0.0, 0.1, 0.0]),
        velocity: Some([0.5, -3.0, 0.0]),
        angular_velocity: Some([0.0, 2.0, 0.0]),
        ..BodySpec::default()
    };
    SimulationSpec {
        schema: SIMULATION_SCHEMA.into(),
        name: "spinning ball".into(),
        fps: None,
        up: [0.0, 1.0, 0.0],
        gravity: 9.81,
        mass_ratio: None,
        bodies: vec![ball, floor],
        collision: CollisionSpec {
            time: 0.02,
            contact_point: [0.0, 0.0, 0.0],
            normal: None,
            restitution: Some(0.8),
            impulse: None,
        },
        observations: Sampling::Times(times.to_vec()),
        noise: NoiseSpec::None,
        effects: Vec::new(),
        camera: None,
        seed: 0,
    }
}

/// Seen every 0.2 s, a turn more from pose to pose looks just the same: 2 rad/s, or 2π/0.2 − 2 =
/// 29.4 rad/s the other way. No data in the scene tell which.
#[test]
fn a_turn_more_between_even_poses_is_an_alternative() {
    let file = simulate(&spinning_ball(&[-0.3, -0.1, 0.1, 0.3])).unwrap().scene_file;
    let result = solve(&with_noise_stated(file));
    let turns: Vec<_> =
        result.alternatives.iter().filter(|a| a.differs_in.contains("turn")).collect();
    assert!(!turns.is_empty(), "{:?}", result.bodies[0].angular_velocity_before);
    // To what the optimiser stops at.
    assert!(turns.iter().any(|turn| turn.delta_chi2.abs() < 1e-3), "{turns:?}");
    // The floor's push doesn't depend on the turns.
    for turn in turns {
        assert!((turn.restitution.unwrap() - 0.8).abs() < 1e-6, "{turn:?}");
        assert!((turn.collision_time - 0.02).abs() < 1e-6, "{turn:?}");
    }
}

/// One more pose off the beat, and a turn more would be 115 degrees off it.
#[test]
fn a_pose_off_the_beat_decides() {
    let file = simulate(&spinning_ball(&[-0.3, -0.1, 0.1, 0.164, 0.3])).unwrap().scene_file;
    let result = solve(&with_noise_stated(file));
    assert_eq!(result.alternatives, []);
    let spin = result.bodies[0].angular_velocity_before.unwrap();
    assert!(super::distance(spin, [0.0, 2.0, 0.0]) < 1e-5, "{spin:?}");
}

/// Five poses on each side leave nothing open, nor do two in scene 3, where several starts lead to
/// the same answer: it is told once.
#[test]
fn a_clear_scene_has_no_alternatives() {
    for (interval, seed) in [(9, 0), (9, 2), (9, 5), (19, 3)] {
        let (file, _) = every(interval, SimulationSpec::random_cuboids(seed));
        assert_eq!(solve(&with_noise_stated(file)).alternatives, [], "seed {seed}");
    }
}

/// Two poses on each side of tumbling boxes, seen to three degrees, can be had by other turns within
/// three deviations; seen a fifth more precisely they can't, since χ² goes with the inverse square.
#[test]
fn precision_decides_between_turns() {
    let (file, truth) = every(19, SimulationSpec::random_cuboids(1));
    let seen = |orientation: f64| {
        let noise = Some(Noise { position: 0.2 * orientation, orientation });
        solve(&SceneFile { noise, ..file.clone() })
    };
    let vague = seen(0.05);
    assert!(!vague.alternatives.is_empty());
    for alternative in &vague.alternatives {
        assert!((0.0..9.0).contains(&alternative.delta_chi2), "{alternative:?}");
        // Another answer, not the same one again.
        let other = alternative.restitution.unwrap();
        assert!((other - truth.restitution).abs() > 0.01, "{alternative:?}");
    }
    assert_eq!(seen(0.04).alternatives, []);
}
