//! Second rung: simulate a collision, annotate it badly, and see what can be recovered.
//!
//! ```sh
//! cargo run --release --example recover
//! ```

use smash::scene::{Noise, Scene};
use smash::simulate::{NoiseSpec, RegularSampling, Sampling, SimulationSpec, simulate};

fn main() -> smash::Result<()> {
    let mut spec = SimulationSpec::random_cuboids(2);
    // What an annotator sees of a film: every 9th frame, not the impact, to a few millimetres.
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 9, frame_count: 90, gap: None });
    println!("{:>10} {:>18} {:>18}", "noise", "mass ratio", "restitution");
    for position_m in [0.0005, 0.002, 0.008] {
        spec.noise = NoiseSpec::Gaussian(Noise { position: position_m, orientation: 0.01 });
        let simulation = simulate(&spec)?;
        let scene = Scene::from_file(simulation.scene_file)?;
        let result = smash::reconstruct(&scene, &smash::Options::default())?;
        let truth = simulation.truth;
        let mass_ratio = result.mass_ratio.and_then(|estimate| estimate.value);
        println!(
            "{:>7.1} mm {:>9.3} ({:.3}) {:>9.3} ({:.3})",
            1e3 * position_m,
            mass_ratio.unwrap_or(f64::NAN),
            truth.mass_ratio.unwrap_or(f64::NAN),
            result.restitution.value.unwrap_or(f64::NAN),
            truth.restitution,
        );
    }
    println!("(the truth in brackets)");
    Ok(())
}
