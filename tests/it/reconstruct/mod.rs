//! Reconstructions of collisions whose truth is known: simulated, seen exactly, the collision in
//! the middle of its segment, where the paper puts it.

mod limits;
mod nulls;
mod recovery;
mod running;
mod symmetry;

use nalgebra::Vector3;
use smash::scene::{ObservationFile, SceneFile};
use smash::simulate::{RegularSampling, Sampling, SimulationSpec, Truth, simulate};
use smash::{Options, Reconstruction, Scene, reconstruct};

/// How far a result may be from the truth.
struct Tolerance {
    /// Of the mass ratio, relative, and of the restitution.
    ratio: f64,
    /// Of velocities, in m/s.
    velocity: f64,
    /// Of angular velocities, in rad/s.
    spin: f64,
    /// Of the true contact point from the impulse's line, in m.
    line: f64,
}

/// Without spins nothing is approximated: what is left is where the optimiser stops.
const EXACT: Tolerance = Tolerance { ratio: 1e-8, velocity: 1e-8, spin: 0.0, line: 1e-9 };

/// Euler's steps of a quarter frame turn by 0.03 rad at most for the spins here (8 rad/s at 60
/// frames per second), and the spin found for them is off by about that share of itself squared:
/// 1 %. Little of it reaches the rest.
const EULER: Tolerance = Tolerance { ratio: 5e-3, velocity: 1e-3, spin: 0.08, line: 3e-3 };

fn solved(file: &SceneFile) -> Reconstruction {
    reconstruct(&scene(file), &Options::paper_by_cost()).unwrap()
}

fn scene(file: &SceneFile) -> Scene {
    Scene::from_file(file.clone()).unwrap()
}

fn simulated(spec: &SimulationSpec) -> (SceneFile, Truth) {
    let simulation = simulate(spec).unwrap();
    (simulation.scene_file, simulation.truth)
}

/// Seen as in the paper's section 5.1: every ninth of 90 frames, with a gap of 18.
fn every_ninth_frame(mut spec: SimulationSpec) -> SimulationSpec {
    spec.collision.time = 0.75;
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 9, frame_count: 90, gap: None });
    spec
}

/// Three poses on each side: five segments, which is fast.
fn six_poses(mut spec: SimulationSpec) -> SimulationSpec {
    spec.collision.time = 40.0 / spec.fps.unwrap();
    spec.observations = Sampling::Frames(vec![26.0, 31.0, 36.0, 44.0, 49.0, 54.0]);
    spec
}

fn six_of_cuboids(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_cuboids(seed)))
}

fn six_of_balls(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_balls(seed)))
}

fn six_of_a_drop(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_box_drop(seed)))
}

fn mass_ratio(result: &Reconstruction) -> f64 {
    result.mass_ratio.as_ref().unwrap().value.unwrap()
}

fn restitution(result: &Reconstruction) -> f64 {
    result.restitution.value.unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (Vector3::from(a) - Vector3::from(b)).norm()
}

/// The result is the truth, in every number that the poses determine.
fn assert_recovers(result: &Reconstruction, truth: &Truth, tolerance: &Tolerance) {
    let name = &truth.scene;
    assert_eq!(result.flags, [], "{name}");
    let time = result.collision_time.value.unwrap();
    assert!((time - truth.collision_time).abs() < 1e-12, "{name}: {time}");
    let found = result.mass_ratio.as_ref().map(|m| m.value.unwrap());
    assert_eq!(found.is_some(), truth.mass_ratio.is_some(), "{name}");
    if let (Some(found), Some(mass_ratio)) = (found, truth.mass_ratio) {
        let error = (found / mass_ratio - 1.0).abs();
        assert!(error < tolerance.ratio, "{name}: mass ratio off by {error:e}");
    }
    let error = (restitution(result) - truth.restitution).abs();
    assert!(error < tolerance.ratio, "{name}: restitution off by {error:e}");
    let error = distance(result.impulse, truth.impulse);
    assert!(error < 4.0 * tolerance.velocity, "{name}: impulse off by {error:e}");
    let lever = Vector3::from(result.contact_point.unwrap()) - Vector3::from(truth.contact_point);
    let error = lever.cross(&Vector3::from(truth.normal)).norm();
    assert!(error < tolerance.line, "{name}: contact off its line by {error:e} m");
    for (found, truth) in result.bodies.iter().zip(&truth.bodies) {
        assert_eq!(found.name, truth.name);
        for (found, truth) in [
            (found.velocity_before, truth.velocity_before),
            (found.velocity_after, truth.velocity_after),
        ] {
            let error = distance(found, truth);
            assert!(error < tolerance.velocity, "{name}: velocity off by {error:e} m/s");
        }
        for (found, truth) in [
            (found.angular_velocity_before, truth.angular_velocity_before),
            (found.angular_velocity_after, truth.angular_velocity_after),
        ] {
            let error = found.map_or(0.0, |found| distance(found, truth));
            assert!(error <= tolerance.spin, "{name}: spin off by {error:e} rad/s");
        }
    }
}

/// All of a result but the one thing that differs from run to run; numbers with all their digits.
fn text_without_seconds(result: &Reconstruction) -> String {
    let mut result = result.clone();
    for phase in &mut result.phases {
        phase.seconds = None;
    }
    result.to_json()
}

fn observations(file: &mut SceneFile) -> impl Iterator<Item = &mut ObservationFile> {
    file.bodies.iter_mut().flat_map(|body| body.observations.iter_mut().flatten())
}
