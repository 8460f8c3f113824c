//! The paper's synthetic evaluation (SMASH section 5.1, Figure 6), for anyone to run.
//!
//! Full scenes are sub-sampled at growing intervals with a gap of twice the interval around the
//! collision, noise is added, and the reconstruction is held against the truth. Prints a table and
//! draws a figure.
//!
//! ```sh
//! cargo run --release --example evaluate                      # 12 scenes of its own
//! cargo run --release --example evaluate -- --folder bullet   # scene_NN.json with truth_NN.json
//! cargo run --release --example evaluate -- --coverage 1000 --intervals 9   # the error bars
//! ```

mod cases;
mod coverage;
mod figure;
mod score;

use std::path::PathBuf;

use clap::Parser;
use rayon::prelude::*;
use smash::Options;
use smash::scene::Noise;
use smash::simulate::NoiseSpec;

use cases::Case;
use score::{Outcome, Score};

/// Frames between two annotated poses, as in the paper.
const INTERVALS: [u32; 5] = [1, 4, 9, 14, 19];

/// Every frame observed makes 87 segments of 88 poses each: a quarter of the scenes must do.
const SHARE_OF_DENSEST: usize = 4;

/// Reconstructs sub-sampled, noisy scenes and holds the results against the truth
#[derive(Parser)]
struct Arguments {
    /// How many scenes; without a folder they are made from seeds 0, 1, 2, …
    #[arg(long, default_value_t = 12)]
    scenes: usize,
    /// A folder of full scenes scene_NN.json, each with its truth_NN.json
    #[arg(long)]
    folder: Option<PathBuf>,
    /// Only these intervals, in frames
    #[arg(long, value_delimiter = ',', default_values_t = INTERVALS)]
    intervals: Vec<u32>,
    /// Only these methods: paper; paper, by cost; refined
    #[arg(long = "method", value_name = "METHOD")]
    methods: Vec<String>,
    /// Instead, test the error bars on so many scenes
    #[arg(long, value_name = "SCENES")]
    coverage: Option<usize>,
    /// Where to draw the figure
    #[arg(long)]
    svg: Option<PathBuf>,
}

fn main() -> smash::Result<()> {
    let arguments = Arguments::parse();
    smash::silence_solver_log();
    if let Some(count) = arguments.coverage {
        return coverage::print(count, &arguments.intervals);
    }
    let cases = match &arguments.folder {
        Some(folder) => cases::from_folder(folder, arguments.scenes)?,
        None => cases::simulated(arguments.scenes)?,
    };
    println!("{}", score::HEADING);
    let mut scores = Vec::new();
    for (noise_name, noise) in noises() {
        for &interval in &arguments.intervals {
            for (method, options) in methods() {
                if !arguments.methods.is_empty() && !arguments.methods.iter().any(|m| m == method) {
                    continue;
                }
                let outcomes = outcomes(&cases, interval, &noise, &options);
                let score = Score { noise_name, interval, method, outcomes };
                println!("{}", score.row());
                scores.push(score);
            }
        }
    }
    match &arguments.svg {
        Some(file) => figure::draw(&scores, file),
        None => Ok(()),
    }
}

/// None, a careful annotator's, and the paper's 5 and 10 percent.
fn noises() -> [(&'static str, NoiseSpec); 4] {
    let annotator = Noise { position: 0.002, orientation: 0.01 };
    [
        ("none", NoiseSpec::None),
        ("gauss", NoiseSpec::Gaussian(annotator)),
        ("5 %", NoiseSpec::Uniform(0.05)),
        ("10 %", NoiseSpec::Uniform(0.10)),
    ]
}

fn methods() -> [(&'static str, Options); 3] {
    [
        ("paper", Options::paper()),
        ("paper, by cost", Options::paper_by_cost()),
        ("refined", Options::default()),
    ]
}

fn outcomes(cases: &[Case], interval: u32, noise: &NoiseSpec, options: &Options) -> Vec<Outcome> {
    let count = if interval == 1 { cases.len().div_ceil(SHARE_OF_DENSEST) } else { cases.len() };
    let cases: Vec<(usize, &Case)> = cases[..count].iter().enumerate().collect();
    cases
        .into_par_iter()
        .map(|(seed, case)| {
            let seen = case.seen(interval, noise, seed as u64);
            let result = seen.and_then(|scene| smash::reconstruct(&scene, options));
            let bound = match noise {
                NoiseSpec::Gaussian(noise) => case.bound(interval, *noise),
                _ => None,
            };
            Outcome::of(case, interval, result, bound)
        })
        .collect()
}
