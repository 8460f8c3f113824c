//! Scenes with hidden effects: what the base model makes of them, and the model with the right ones.
//!
//! Each scene is drawn by its seed: two bodies in mid-air or one on a floor, seen often or seldom,
//! with noise, and with an effect that is strong enough to be found, none, or two. Prints a table.
//!
//! ```sh
//! cargo run --release --example evaluate_hidden                        # all effects, 12 scenes each
//! cargo run --release --example evaluate_hidden -- --effect friction   # only this one
//! cargo run --release --example evaluate_hidden -- --folder hidden     # case_*.json, truth/case_*.json
//! ```

mod case;
mod draw;
mod folder;
mod score;
mod strength;

use std::path::PathBuf;

use clap::Parser;
use rayon::prelude::*;
use smash::effect::{EffectRequest, catalogue};
use smash::reconstruct::RefinedOptions;
use smash::{Options, Reconstruction, Result};

use case::Case;
use draw::{Regime, hidden_scene};
use score::{Outcome, row};

/// Reconstructs scenes with hidden effects, without and with them
#[derive(Parser)]
struct Arguments {
    /// Scenes of each kind, from seeds 0, 1, 2, …; dense, medium and sparse in turn
    #[arg(long, default_value_t = 12)]
    scenes: u64,
    /// Only this effect of the catalogue, or `none`, or two joined by `+`
    #[arg(long = "effect", value_name = "NAME")]
    effects: Vec<String>,
    /// A folder of scenes case_*.json, each with its truth/case_*.json
    #[arg(long)]
    folder: Option<PathBuf>,
}

/// Pairs that occur together, each about another part of the model.
const PAIRS: [&str; 3] =
    ["gravity_scale+spin_drag", "quadratic_drag+time_offset", "magnus+outlier"];

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    smash::silence_solver_log();
    println!("{}", score::HEADING);
    match &arguments.folder {
        Some(folder) => tell_folder(folder::cases(folder)?),
        None => {
            let singles = catalogue().iter().map(|effect| effect.name.as_str());
            let all = ["none"].into_iter().chain(singles).chain(PAIRS);
            let wanted = &arguments.effects;
            for kind in all.filter(|kind| wanted.is_empty() || wanted.iter().any(|w| w == kind)) {
                println!("{}", row(kind, &drawn(kind, arguments.scenes)?));
            }
        }
    }
    Ok(())
}

fn drawn(kind: &str, scenes: u64) -> Result<Vec<Outcome>> {
    let names: Vec<&str> = kind.split('+').filter(|name| *name != "none").collect();
    let seeds: Vec<u64> = (0..scenes).collect();
    let of_seed = |&seed: &u64| {
        let regime = [Regime::Dense, Regime::Medium, Regime::Sparse][seed as usize % 3];
        Ok(outcome(&hidden_scene(&names, regime, seed)?))
    };
    seeds.par_iter().map(of_seed).collect()
}

fn tell_folder(cases: Vec<Case>) {
    let mut kinds: Vec<String> = cases.iter().map(Case::kind).collect();
    kinds.sort();
    kinds.dedup();
    for kind in kinds {
        let cases: Vec<&Case> = cases.iter().filter(|case| case.kind() == kind).collect();
        let outcomes: Vec<Outcome> = cases.par_iter().map(|case| outcome(case)).collect();
        println!("{}", row(&kind, &outcomes));
    }
}

/// A case fitted without and with its effects.
fn outcome(case: &Case) -> Outcome {
    let fit = |effects: Vec<EffectRequest>| -> Result<Reconstruction> {
        let options = RefinedOptions { effects, ..RefinedOptions::default() };
        smash::reconstruct(&case.scene, &Options::Refined(options))
    };
    let requests = case.effects.iter().map(|label| EffectRequest::parse(label));
    let with = requests.collect::<Result<Vec<_>>>().and_then(fit);
    Outcome::of(case, fit(Vec::new()), with)
}
