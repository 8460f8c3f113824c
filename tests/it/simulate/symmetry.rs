//! Another world, another engine: the same motion.

use nalgebra::{UnitQuaternion, Vector3};
use smash::simulate::{SimulationSpec, simulate};

use super::simulations;

/// No direction is special: the world turned, the scene turns with it. A leftover `y` or a spin
/// taken in the body's frame would show as decimetres or whole radians.
#[test]
fn a_turned_specification_gives_the_turned_scene() {
    let turn = UnitQuaternion::new(Vector3::new(0.7, -1.9, 0.4));
    for (spec, simulation) in simulations() {
        let turned = simulate(&turned_spec(&spec, &turn)).unwrap();
        let pairs = simulation.scene.bodies().iter().zip(turned.scene.bodies());
        for (body, turned_body) in pairs {
            for (seen, turned_seen) in body.observations.iter().zip(&turned_body.observations) {
                let expected = turn * seen.position_in_world;
                assert!((expected - turned_seen.position_in_world).norm() < 1e-9);
                if let Some(q) = seen.world_from_body {
                    assert!((turn * q).angle_to(&turned_seen.world_from_body.unwrap()) < 1e-9);
                }
            }
        }
    }
}

fn turned_spec(spec: &SimulationSpec, turn: &UnitQuaternion<f64>) -> SimulationSpec {
    let vector = |v: [f64; 3]| <[f64; 3]>::from(turn * Vector3::from(v));
    let mut turned = spec.clone();
    turned.up = vector(spec.up);
    turned.collision.contact_point = vector(spec.collision.contact_point);
    turned.collision.normal = spec.collision.normal.map(vector);
    for body in &mut turned.bodies {
        body.position = body.position.map(vector);
        body.velocity = body.velocity.map(vector);
        body.angular_velocity = body.angular_velocity.map(vector);
        body.normal = body.normal.map(vector);
        body.orientation = body.orientation.map(|[w, x, y, z]| {
            let q = turn * UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
            [q.w, q.i, q.j, q.k]
        });
    }
    turned
}

/// The Bullet engine, which steps contacts and rotations its own way 600 000 times a second, moves
/// the same two boxes the same way: centres to its 3e-11 m, orientations to its 0.004°. With the
/// spin constant in flight they would be more than 5° apart.
#[test]
fn an_independent_engine_moves_the_bodies_the_same_way() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
    let spec = SimulationSpec::read(format!("{data}/bullet_00.spec.json").as_ref()).unwrap();
    let bullet = smash::Scene::read(format!("{data}/bullet_00.json")).unwrap();
    let ours = simulate(&spec).unwrap();
    let mut worst_wrong_degrees = 0.0_f64;
    for (index, expected) in bullet.bodies().iter().enumerate() {
        let body = &ours.scene.bodies()[index];
        let after = &ours.motions[index].after;
        assert_eq!(body.observations.len(), expected.observations.len());
        for (seen, expected) in body.observations.iter().zip(&expected.observations) {
            assert_eq!(seen.time_s, expected.time_s);
            assert!((seen.position_in_world - expected.position_in_world).norm() < 1e-10);
            let [q, expected] = [seen, expected].map(|pose| pose.world_from_body.unwrap());
            assert!(q.angle_to(&expected).to_degrees() < 0.005);
            if seen.time_s > spec.collision.time {
                let turn = after.omega_in_world() * (seen.time_s - spec.collision.time);
                let wrong = UnitQuaternion::new(turn) * after.world_from_body;
                worst_wrong_degrees =
                    worst_wrong_degrees.max(wrong.angle_to(&expected).to_degrees());
            }
        }
    }
    assert!(worst_wrong_degrees > 5.0, "{worst_wrong_degrees}°");
}
