//! One impulse at one point: what it conserves, and how the bodies part.

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use smash::rigid_body::{Contact, RigidBody};
use smash::scene::Shape;

/// Rounding of some dozen operations, with a thousandfold margin.
const ROUNDING: f64 = 1e-12;

fn vector(random: &mut ChaCha8Rng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| random.random_range(-size..size))
}

fn body(random: &mut ChaCha8Rng) -> RigidBody {
    let size = [(); 3].map(|()| random.random_range(0.1..0.4));
    let at_rest = RigidBody {
        position_in_world: vector(random, 1.0),
        world_from_body: UnitQuaternion::new(vector(random, 2.0)),
        velocity_in_world: vector(random, 3.0),
        ..RigidBody::solid(&Shape::Box { size }, random.random_range(0.3..4.0))
    };
    at_rest.spinning(&vector(random, 6.0))
}

/// Any two bodies, and any contact at which they approach.
fn encounters() -> impl Iterator<Item = (Contact, RigidBody, RigidBody, f64)> {
    (0..200).map(|seed| {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let (a, b) = (body(&mut random), body(&mut random));
        let mut contact = Contact {
            point_in_world: vector(&mut random, 1.0),
            normal_in_world: UnitVector3::new_normalize(vector(&mut random, 1.0)),
        };
        if contact.normal_velocity(&a, Some(&b)) > 0.0 {
            contact.normal_in_world = -contact.normal_in_world;
        }
        (contact, a, b, random.random_range(0.0..=1.0))
    })
}

fn collide(contact: &Contact, a: &RigidBody, b: &RigidBody, c: f64) -> (RigidBody, RigidBody) {
    let impulse = contact.impulse_from_restitution(a, Some(b), c);
    (a.pushed(&contact.point_in_world, &impulse), b.pushed(&contact.point_in_world, &-impulse))
}

#[test]
fn the_bodies_part_with_the_restitution_asked_for() {
    for (contact, a, b, c) in encounters() {
        let (a_after, b_after) = collide(&contact, &a, &b, c);
        let found = contact.restitution((&a, Some(&b)), (&a_after, Some(&b_after)));
        assert!((found - c).abs() < ROUNDING * 100.0, "{found} for {c}");
    }
}

/// Momentum, and angular momentum about any point, also a far one. Without its torque on b the
/// impulse would change the latter by a hundredth of it in most encounters.
#[test]
fn what_one_body_gains_the_other_loses() {
    let mut broken_without_torque = 0;
    for (contact, a, b, c) in encounters() {
        let (a_after, b_after) = collide(&contact, &a, &b, c);
        let momentum = |one: &RigidBody, other: &RigidBody| {
            one.mass * one.velocity_in_world + other.mass * other.velocity_in_world
        };
        let gained = momentum(&a_after, &b_after) - momentum(&a, &b);
        assert!(gained.norm() < ROUNDING * (a.mass + b.mass) * 5.0);
        for about in [Vector3::zeros(), contact.point_in_world, Vector3::new(30.0, -70.0, 20.0)] {
            let angular = |one: &RigidBody, other: &RigidBody| {
                one.angular_momentum_about(&about) + other.angular_momentum_about(&about)
            };
            let scale = a.angular_momentum_about(&about).norm() + (a.mass + b.mass) * 5.0;
            let gained = angular(&a_after, &b_after) - angular(&a, &b);
            assert!(gained.norm() < ROUNDING * scale * 10.0, "{gained} about {about}");
        }
        let without_torque =
            RigidBody { angular_momentum_in_world: b.angular_momentum_in_world, ..b_after };
        let about = contact.point_in_world;
        let of_b = |body: &RigidBody| body.angular_momentum_about(&about);
        let broken = (of_b(&without_torque) - of_b(&b_after)).norm() / of_b(&b).norm();
        broken_without_torque += u32::from(broken > 0.01);
    }
    assert!(broken_without_torque > 100, "{broken_without_torque} of 200");
}

/// Energy lost = (1 − c²) times what the approach had: none at c = 1, never a gain.
#[test]
fn energy_is_lost_as_restitution_says() {
    for (contact, a, b, c) in encounters() {
        let before = a.kinetic_energy() + b.kinetic_energy();
        let after = |c: f64| {
            let (a_after, b_after) = collide(&contact, &a, &b, c);
            a_after.kinetic_energy() + b_after.kinetic_energy()
        };
        assert!((after(1.0) / before - 1.0).abs() < 1e-10);
        let most = before - after(0.0);
        let lost = before - after(c);
        assert!(most > 0.0);
        assert!((lost - (1.0 - c * c) * most).abs() < 1e-10 * before);
    }
}

/// An immovable partner is the limit of a heavy one at rest: at 1e9 times the mass the impulses
/// agree to some parts in 1e9.
#[test]
fn a_plane_is_an_infinitely_heavy_body() {
    for (contact, a, _, c) in encounters() {
        let heavy = RigidBody {
            position_in_world: contact.point_in_world,
            ..RigidBody::solid(&Shape::Sphere { radius: 1.0 }, 1e9)
        };
        let on_heavy = contact.impulse_from_restitution(&a, Some(&heavy), c);
        let on_plane = contact.impulse_from_restitution(&a, None, c);
        assert!((on_heavy - on_plane).norm() < 1e-7 * on_plane.norm());
    }
}

/// The schoolbook: two balls head-on, masses 1 and 3, 2 m/s against rest. v_a = (1 − 3c)/4 · 2.
#[test]
fn balls_head_on_do_as_in_school() {
    let ball = |mass: f64, x: f64, v: f64| RigidBody {
        position_in_world: Vector3::new(x, 0.0, 0.0),
        velocity_in_world: Vector3::new(v, 0.0, 0.0),
        ..RigidBody::solid(&Shape::Sphere { radius: 0.1 }, mass)
    };
    let (a, b) = (ball(1.0, -0.1, 2.0), ball(3.0, 0.1, 0.0));
    let contact = Contact { point_in_world: Vector3::zeros(), normal_in_world: -Vector3::x_axis() };
    for c in [0.0, 0.5, 1.0] {
        let (a_after, b_after) = collide(&contact, &a, &b, c);
        assert!((a_after.velocity_in_world.x - (1.0 - 3.0 * c) / 2.0).abs() < ROUNDING);
        assert!((b_after.velocity_in_world.x - (1.0 + c) / 2.0).abs() < ROUNDING);
        assert!(a_after.omega_in_world().norm() < ROUNDING);
    }
}
