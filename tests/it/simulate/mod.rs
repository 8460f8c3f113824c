//! The dynamics run forwards: what must hold in every simulated scene.

mod laws;
mod noise;
mod refused;
mod sampling;
mod symmetry;

use smash::simulate::{RegularSampling, Sampling, Simulation, SimulationSpec, simulate};

/// Relative; the bar that simulations are held to. Rounding reaches some 1e-14.
const EXACT: f64 = 1e-10;

/// Every kind of collision, ten of each.
fn simulations() -> Vec<(SimulationSpec, Simulation)> {
    let kinds = [
        SimulationSpec::random_cuboids,
        SimulationSpec::random_balls,
        SimulationSpec::random_box_drop,
        SimulationSpec::random_ball_drop,
    ];
    let mut specs: Vec<_> = (0..10).flat_map(|seed| kinds.map(|random| random(seed))).collect();
    for spec in &mut specs {
        // A few poses do here: the laws are tested on the motion itself.
        spec.observations = every(9, 80);
    }
    specs.into_iter().map(|spec| (spec.clone(), simulate(&spec).unwrap())).collect()
}

fn every(interval: u32, frame_count: u32) -> Sampling {
    Sampling::Regular(RegularSampling { interval, frame_count, gap: Some(interval) })
}
