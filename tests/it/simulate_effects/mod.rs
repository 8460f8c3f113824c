//! Simulations with effects: closed forms, what is seen, broken requests, and that the
//! reconstruction finds again what was put in.

mod flights;
mod found_again;
mod instants;
mod requests;
mod seen;

use nalgebra::{UnitQuaternion, Vector3};
use smash::effect::EffectRequest;
use smash::reconstruct::{Number, RefinedOptions};
use smash::rigid_body::RigidBody;
use smash::scene::{Camera, Noise, ObservationFile};
use smash::simulate::{
    EffectSpec, Motion, RegularSampling, Sampling, Simulation, SimulationSpec, simulate,
};
use smash::{Options, Scene};

/// Flights with effects are integrated to 1e-9; velocities in m/s and positions in m likewise.
const INTEGRATED: f64 = 1e-9;
/// What happens at an instant is as exact as numbers are.
const EXACT: f64 = 1e-12;

/// Times on both sides of a collision, in s from it.
const MOMENTS_S: [f64; 5] = [-0.6, -0.23, 0.004, 0.31, 0.6];

fn effect(name: &str, body: Option<&str>, parameters: &[(&str, &[f64])]) -> EffectSpec {
    let parameters =
        parameters.iter().map(|(name, value)| (name.to_string(), Number::from(value.to_vec())));
    EffectSpec { name: name.into(), body: body.map(String::from), parameters: parameters.collect() }
}

fn with(mut spec: SimulationSpec, effects: &[EffectSpec]) -> Simulation {
    spec.effects = effects.to_vec();
    simulate(&spec).unwrap()
}

fn weightless(spec: SimulationSpec) -> SimulationSpec {
    SimulationSpec { gravity: 0.0, ..spec }
}

/// Two balls whose turning is seen.
fn balls(seed: u64) -> SimulationSpec {
    let mut spec = SimulationSpec::random_balls(seed);
    spec.bodies.iter_mut().for_each(|body| body.measure_orientation = None);
    spec
}

/// The states at `since_s` from the collision, and where that flight starts.
fn flown(motion: &Motion, since_s: f64) -> (RigidBody, &RigidBody) {
    let start = if since_s < 0.0 { &motion.before } else { &motion.after };
    (motion.at(motion.collision_time_s + since_s), start)
}

fn assert_near(found: Vector3<f64>, expected: Vector3<f64>, tolerance: f64) {
    let off = (found - expected).norm();
    assert!(off < tolerance, "{found} isn't {expected}: {off:e} off");
}

fn seen(simulation: &Simulation, body: usize) -> &[ObservationFile] {
    simulation.scene_file.bodies[body].observations.as_deref().unwrap()
}

fn loading(offset: Vector3<f64>) -> EffectSpec {
    effect("com_offset", Some("a"), &[("offset", offset.as_slice())])
}

/// The same place of the shape of a, with its centre of mass moved in it.
fn loaded(mut spec: SimulationSpec, offset: Vector3<f64>) -> SimulationSpec {
    let [w, x, y, z] = spec.bodies[0].orientation.unwrap();
    let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let centre = Vector3::from(spec.bodies[0].position.unwrap());
    spec.bodies[0].position = Some((centre + q.transform_vector(&offset)).into());
    spec
}
