//! Conservation, Galileo and restitution.

use nalgebra::{UnitQuaternion, Vector3};
use smash::rigid_body::RigidBody;
use smash::simulate::{Motion, simulate};

use super::{EXACT, simulations};

/// Times on both sides of a collision, in s from it.
const MOMENTS_S: [f64; 6] = [-0.7, -0.31, -1e-9, 1e-9, 0.05, 0.66];

fn at_collision(motion: &Motion) -> (RigidBody, RigidBody) {
    (motion.before, motion.after)
}

/// Both bodies together keep momentum, and angular momentum about any point, near or far.
#[test]
fn a_collision_in_mid_air_conserves_momentum_and_angular_momentum() {
    let mut pairs = 0;
    for (_, simulation) in simulations() {
        let [a, b] = simulation.motions.as_slice() else {
            continue;
        };
        pairs += 1;
        let ((a_before, a_after), (b_before, b_after)) = (at_collision(a), at_collision(b));
        let momentum = |body: &RigidBody| body.mass * body.velocity_in_world;
        let before = momentum(&a_before) + momentum(&b_before);
        let scale = momentum(&a_before).norm() + momentum(&b_before).norm();
        let gained = momentum(&a_after) + momentum(&b_after) - before;
        assert!(gained.norm() < EXACT * scale);

        let contact = Vector3::from(simulation.truth.contact_point);
        for about in [Vector3::zeros(), contact, Vector3::new(100.0, -50.0, 7.0)] {
            let of = |body: &RigidBody| body.angular_momentum_about(&about);
            let scale = of(&a_before).norm() + of(&b_before).norm();
            let gained = of(&a_after) + of(&b_after) - of(&a_before) - of(&b_before);
            assert!(gained.norm() < EXACT * scale, "about {about}");
        }
    }
    assert_eq!(pairs, 20);
}

/// A smooth floor pushes along its normal only: what moves along it, and what turns about it,
/// stays.
#[test]
fn a_smooth_floor_neither_drags_nor_twists() {
    let mut drops = 0;
    for (_, simulation) in simulations() {
        let [body] = simulation.motions.as_slice() else {
            continue;
        };
        drops += 1;
        let (before, after) = at_collision(body);
        let push = after.velocity_in_world - before.velocity_in_world;
        assert!(push.y > 0.0);
        assert!(push.xz().norm() < EXACT * push.y);
        let twist = after.angular_momentum_in_world - before.angular_momentum_in_world;
        assert!(twist.y.abs() < EXACT * before.angular_momentum_in_world.norm());
    }
    assert_eq!(drops, 20);
}

/// In flight kinetic and potential energy add up to the same at any time, and the angular
/// momentum is the same vector. Were the spin constant instead, the energy of a box would be off
/// by more than 1 %: 1e8 times this tolerance.
#[test]
fn energy_and_angular_momentum_stay_in_flight() {
    let mut worst_wrong = 0.0_f64;
    for (spec, simulation) in simulations() {
        for motion in &simulation.motions {
            let energy = |body: &RigidBody| {
                body.kinetic_energy() + body.mass * spec.gravity * body.position_in_world.y
            };
            for moment_s in MOMENTS_S {
                let start = if moment_s < 0.0 { &motion.before } else { &motion.after };
                let body = motion.at(motion.collision_time_s + moment_s);
                let scale = start.kinetic_energy() + body.kinetic_energy();
                assert!((energy(&body) - energy(start)).abs() < EXACT * scale);
                assert_eq!(body.angular_momentum_in_world, start.angular_momentum_in_world);

                let spin = start.omega_in_world();
                let wrong = RigidBody {
                    world_from_body: UnitQuaternion::new(spin * moment_s) * start.world_from_body,
                    ..body
                };
                worst_wrong = worst_wrong.max((energy(&wrong) - energy(start)).abs() / scale);
            }
        }
    }
    assert!(worst_wrong > 0.01, "a constant spin is off by {worst_wrong}");
}

/// Centres fall on a parabola: seen from the collision, p = p_c + v t − ½ g t² up.
#[test]
fn bodies_fall_as_galileo_says() {
    for (_, simulation) in simulations() {
        for motion in &simulation.motions {
            let body = motion.at(motion.collision_time_s + 0.5);
            let start = &motion.after;
            let straight = start.position_in_world + 0.5 * start.velocity_in_world;
            let fallen = straight - body.position_in_world;
            let expected = Vector3::new(0.0, 9.81 * 0.125, 0.0);
            assert!((fallen - expected).norm() < 1e-12);
        }
    }
}

/// The restitution is what was asked for, measured on the velocities of the touching points; the
/// energy never rises, and stays when nothing is lost.
#[test]
fn the_bodies_part_as_asked_and_gain_no_energy() {
    for (mut spec, _) in simulations() {
        for restitution in [0.0, 0.37, 1.0] {
            spec.collision.restitution = Some(restitution);
            let simulation = simulate(&spec).unwrap();
            let point = Vector3::from(simulation.truth.contact_point);
            let normal = Vector3::from(simulation.truth.normal);
            let gap_speed = |pick: fn(&Motion) -> &RigidBody| {
                let speed =
                    |motion: &Motion| pick(motion).point_velocity_in_world(&point).dot(&normal);
                let speeds: Vec<f64> = simulation.motions.iter().map(speed).collect();
                speeds[0] - speeds.get(1).unwrap_or(&0.0)
            };
            let (before, after) = (gap_speed(|m| &m.before), gap_speed(|m| &m.after));
            assert!(before < 0.0, "they approach");
            assert!((after + restitution * before).abs() < EXACT * before.abs());

            let energy = |pick: fn(&Motion) -> &RigidBody| -> f64 {
                simulation.motions.iter().map(|motion| pick(motion).kinetic_energy()).sum()
            };
            let (before, after) = (energy(|m| &m.before), energy(|m| &m.after));
            assert!(after <= before * (1.0 + EXACT));
            assert_eq!((after / before - 1.0).abs() < EXACT, restitution == 1.0);
        }
    }
}

/// The impulse of one simulation, put into another in place of its restitution, gives the same.
#[test]
fn restitution_and_impulse_say_the_same() {
    for (mut spec, by_restitution) in simulations() {
        spec.collision.restitution = None;
        spec.collision.normal = None;
        spec.collision.impulse = Some(by_restitution.truth.impulse);
        let by_impulse = simulate(&spec).unwrap();
        let difference = by_impulse.truth.restitution - by_restitution.truth.restitution;
        assert!(difference.abs() < EXACT);
        assert_eq!(by_impulse.scene_file, by_restitution.scene_file);
    }
}
