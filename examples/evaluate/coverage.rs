//! Do the error bars hold? Scatter against the Cramér-Rao bound, and how often the 95 % interval
//! holds the truth.

use rayon::prelude::*;
use smash::reconstruct::{Estimate, Reconstruction};
use smash::scene::Noise;
use smash::simulate::{
    NoiseSpec, RegularSampling, SimulationSpec, add_noise, keep_frames, simulate,
};
use smash::{Options, Result, Scene};

/// An annotator's.
const NOISE: Noise = Noise { position: 0.002, orientation: 0.01 };

/// An estimate against the truth.
struct Hit {
    /// Its error over the bound's deviation.
    error_over_bound: f64,
    covered: bool,
}

/// Simulates `count` random collisions of two cuboids, each with its own noise, and prints a row for
/// each interval, stated and estimated noise, and quantity.
pub fn print(count: usize, intervals: &[u32]) -> Result<()> {
    println!(
        "| interval | noise | scenes | quantity | scatter / bound | 95 % interval holds the truth |\n\
         |---|---|---|---|---|---|"
    );
    for &interval in intervals {
        for (noise_name, is_stated) in [("stated", true), ("estimated", false)] {
            let rows = (0..count as u64)
                .into_par_iter()
                .map(|seed| hits(seed, interval, is_stated))
                .collect::<Result<Vec<_>>>()?;
            for (index, quantity) in
                ["mass ratio", "restitution", "collision time"].into_iter().enumerate()
            {
                let hits: Vec<&Hit> = rows.iter().filter_map(|row| row[index].as_ref()).collect();
                println!(
                    "| {interval} | {noise_name} | {} | {quantity} | {:.2} | {:.1} % |",
                    hits.len(),
                    scatter(&hits),
                    100.0 * hits.iter().filter(|hit| hit.covered).count() as f64
                        / hits.len() as f64
                );
            }
        }
    }
    Ok(())
}

/// Of mass ratio, restitution and collision time, where there is a number.
fn hits(seed: u64, interval: u32, is_stated: bool) -> Result<[Option<Hit>; 3]> {
    let mut spec = SimulationSpec::random_cuboids(seed);
    spec.collision.time = 0.75;
    let simulation = simulate(&spec)?;
    let truth = &simulation.truth;
    let sampling = RegularSampling { interval, frame_count: 90, gap: None };
    let frames = sampling.frame_numbers(60.0 * truth.collision_time);
    let mut exact = keep_frames(simulation.scene_file.clone(), &frames);
    let mut noisy = add_noise(exact.clone(), &NoiseSpec::Gaussian(NOISE), seed);
    noisy.noise = is_stated.then_some(NOISE);
    exact.noise = Some(NOISE);
    let solve = |file| smash::reconstruct(&Scene::from_file(file)?, &Options::default());
    let (found, bound) = (solve(noisy)?, solve(exact)?);
    let truths = [truth.mass_ratio.unwrap_or(f64::NAN), truth.restitution, truth.collision_time];
    let pairs = estimates(&found).into_iter().zip(estimates(&bound)).zip(truths);
    let hits: Vec<Option<Hit>> = pairs
        .map(|((found, bound), truth)| {
            let (found, bound) = (found?, bound?);
            let [low, high] = found.interval_95?;
            Some(Hit {
                error_over_bound: (found.value? - truth) / bound.std?,
                covered: low <= truth && truth <= high,
            })
        })
        .collect();
    Ok(hits.try_into().unwrap_or([const { None }; 3]))
}

fn estimates(result: &Reconstruction) -> [Option<Estimate>; 3] {
    let Reconstruction { mass_ratio, restitution, collision_time, .. } = result.clone();
    [mass_ratio, Some(restitution), Some(collision_time)]
}

/// Root mean square of the errors over the bound. Beyond five deviations is a wrong solution, which
/// the coverage counts.
fn scatter(hits: &[&Hit]) -> f64 {
    let kept: Vec<f64> =
        hits.iter().map(|hit| hit.error_over_bound).filter(|e| e.abs() < 5.0).collect();
    (kept.iter().map(|e| e * e).sum::<f64>() / kept.len() as f64).sqrt()
}
