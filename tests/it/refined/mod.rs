//! The refined solver, as the default options have it: what it finds again, what it says of its own
//! certainty, and what it leaves open.

mod alternatives;
mod conservation;
mod exact;
mod hostile;
mod invariance;
mod noise_scale;
mod range;
mod robust;
mod uncertainty;
mod undetermined;

use nalgebra::Vector3;
use smash::scene::{Noise, ObservationFile, SceneFile};
use smash::simulate::{RegularSampling, Sampling, SimulationSpec, Truth, simulate};
use smash::{Options, Reconstruction, Scene, reconstruct};

/// An annotator's.
const NOISE: Noise = Noise { position: 0.002, orientation: 0.01 };

fn solve(file: &SceneFile) -> Reconstruction {
    reconstruct(&Scene::from_file(file.clone()).unwrap(), &Options::default()).unwrap()
}

/// Every `interval`-th of 90 frames, seen exactly, with twice that gap at the collision.
fn every(interval: u32, mut spec: SimulationSpec) -> (SceneFile, Truth) {
    spec.observations = Sampling::Regular(RegularSampling { interval, frame_count: 90, gap: None });
    let simulation = simulate(&spec).unwrap();
    (simulation.scene_file, simulation.truth)
}

fn with_noise_stated(mut file: SceneFile) -> SceneFile {
    file.noise = Some(NOISE);
    file
}

fn poses(file: &mut SceneFile) -> impl Iterator<Item = &mut ObservationFile> {
    file.bodies.iter_mut().flat_map(|body| body.observations.iter_mut().flatten())
}

fn without_orientations(mut file: SceneFile) -> SceneFile {
    poses(&mut file).for_each(|pose| pose.orientation = None);
    file
}

fn mass_ratio(result: &Reconstruction) -> f64 {
    result.mass_ratio.as_ref().unwrap().value.unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (Vector3::from(a) - Vector3::from(b)).norm()
}
