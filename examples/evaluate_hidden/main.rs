//! Scenes with hidden effects: is what is missing found, named and added?
//!
//! Each scene is drawn by its seed: two bodies in mid-air or one on a floor, seen often or seldom,
//! with noise, and with an effect that is strong enough to be found, none, two, or a law that the
//! catalogue hasn't got. Prints tables.
//!
//! ```sh
//! cargo run --release --example evaluate_hidden                      # 6 scenes of each effect
//! cargo run --release --example evaluate_hidden -- --scenes 20 --seed 1000 --clean 500
//! cargo run --release --example evaluate_hidden -- --only friction   # only this effect
//! cargo run --release --example evaluate_hidden -- --folder hidden   # case_*.json, truth/case_*.json
//! ```

mod answer;
mod case;
mod clean;
mod draw;
mod fit;
mod folder;
mod foreign;
mod outside;
mod pair;
mod single;
mod strength;
mod table;
mod throws;
mod time;

use std::path::PathBuf;

use clap::Parser;
use rayon::prelude::*;
use smash::Result;
use smash::effect::catalogue;

use case::Case;
use draw::{Regime, hidden_scene, hidden_throws};

/// Diagnoses and improves scenes with hidden effects, and holds the answers against the truth
#[derive(Parser)]
struct Arguments {
    /// Scenes of each single effect; dense, medium and sparse in turn
    #[arg(long, default_value_t = 6)]
    scenes: u64,
    /// The first seed
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Scenes without any effect, each with the noise stated and estimated
    #[arg(long, default_value_t = 48)]
    clean: u64,
    /// Scenes with two effects
    #[arg(long, default_value_t = 16)]
    pairs: u64,
    /// Scenes with a law that the catalogue hasn't got
    #[arg(long, default_value_t = 18)]
    outside: u64,
    /// Sets of four throws with the same effect in each
    #[arg(long, default_value_t = 14)]
    throws: u64,
    /// Scenes of 2 × 20 poses to take the time of
    #[arg(long, default_value_t = 16)]
    timed: u64,
    /// Only this single effect
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Don't tell the noise of scenes with effects
    #[arg(long)]
    unstated: bool,
    /// A folder that is there, to keep the scenes with something hidden in: to look at one by one
    #[arg(long, value_name = "FOLDER")]
    keep: Option<PathBuf>,
    /// Instead, a folder of scenes case_*.json, each with its truth/case_*.json and, if there is one,
    /// another solver's oracle/case_*.json
    #[arg(long)]
    folder: Option<PathBuf>,
}

/// Pairs that occur together.
const PAIRS: [[&str; 2]; 8] = [
    ["gravity_scale", "spin_drag"],
    ["quadratic_drag", "time_offset"],
    ["magnus", "outlier"],
    ["linear_drag", "spin_drag"],
    ["gravity_scale", "outlier"],
    ["quadratic_drag", "magnus"],
    ["com_offset", "quadratic_drag"],
    ["friction", "quadratic_drag"],
];

/// Throws that are put together.
const THROWS: usize = 4;
/// Effects of single poses and moments, and pushes, which no two throws share.
const OF_ONE_THROW: [&str; 3] = ["external_impulse", "outlier", "second_impact"];

fn main() -> Result<()> {
    let arguments = Arguments::parse();
    smash::silence_solver_log();
    match &arguments.folder {
        Some(folder) => of_folder(folder::cases(folder)?, arguments.unstated),
        None => of_seeds(&arguments),
    }
}

fn of_seeds(arguments: &Arguments) -> Result<()> {
    let Arguments { scenes, seed, unstated, .. } = *arguments;
    let only = arguments.only.as_deref();
    let names: Vec<&str> = catalogue().iter().map(|effect| effect.name.as_str()).collect();
    let names: Vec<&str> =
        names.into_iter().filter(|name| only.is_none_or(|only| only == *name)).collect();
    let singles: Vec<(u64, &str)> = names
        .iter()
        .flat_map(|name| (seed..seed + scenes).map(move |seed| (seed, *name)))
        .collect();
    let drawn = |(seed, name): &(u64, &str)| hidden_scene(&[name], Regime::of_seed(*seed), *seed);
    let singles = told(in_parallel(&singles, drawn)?, unstated)?;
    let keep = |cases: &[Case]| match &arguments.keep {
        Some(folder) => cases.iter().try_for_each(|case| case.keep(folder)),
        None => Ok(()),
    };
    keep(&singles)?;
    tell(&singles, single::tables)?;
    if only.is_some() {
        return Ok(());
    }
    let seeds = |count: u64| (seed..seed + count).collect::<Vec<u64>>();
    let clean = |seed: &u64| hidden_scene(&[], Regime::of_seed(*seed), *seed);
    tell(&in_parallel(&seeds(arguments.clean), clean)?, clean::table)?;
    let pair = |seed: &u64| {
        let pair = PAIRS[*seed as usize % PAIRS.len()];
        hidden_scene(&pair, Regime::of_seed(*seed / PAIRS.len() as u64), *seed)
    };
    let pairs = told(in_parallel(&seeds(arguments.pairs), pair)?, unstated)?;
    keep(&pairs)?;
    tell(&pairs, pair::table)?;
    let outside = |seed: &u64| {
        let law = foreign::LAWS[*seed as usize % foreign::LAWS.len()];
        hidden_scene(&[law], Regime::of_seed(*seed / foreign::LAWS.len() as u64), *seed)
    };
    let outside = told(in_parallel(&seeds(arguments.outside), outside)?, unstated)?;
    keep(&outside)?;
    tell(&outside, outside::table)?;
    let shared: Vec<&str> =
        names.iter().copied().filter(|name| !OF_ONE_THROW.contains(name)).collect();
    let throws = |seed: &u64| {
        let name = shared[*seed as usize % shared.len()];
        hidden_throws(name, THROWS, Regime::of_seed(*seed / shared.len() as u64), *seed)
    };
    let throws = in_parallel(&seeds(arguments.throws), throws)?;
    throws.iter().try_for_each(|set| keep(set))?;
    tell(&throws, throws::table)?;
    let timed =
        |seed: &u64| hidden_scene(&[names[*seed as usize % names.len()]], Regime::Medium, *seed);
    let mut timed = in_parallel(&seeds(arguments.timed), timed)?;
    timed.retain(|case| case.scene.bodies().len() == 2);
    keep(&timed)?;
    tell(&timed, time::table)
}

fn of_folder(cases: Vec<Case>, unstated: bool) -> Result<()> {
    let (clean, cases): (Vec<Case>, Vec<Case>) =
        cases.into_iter().partition(|case| case.effects.is_empty());
    let (singles, pairs): (Vec<Case>, Vec<Case>) =
        told(cases, unstated)?.into_iter().partition(|case| !case.kind().contains('+'));
    tell(&singles, single::tables)?;
    tell(&clean, clean::table)?;
    tell(&pairs, pair::table)
}

/// Prints what `table` makes of the cases, if there are any.
fn tell<T>(cases: &[T], table: fn(&[T]) -> Result<String>) -> Result<()> {
    if !cases.is_empty() {
        println!("{}", table(cases)?);
    }
    Ok(())
}

/// The cases as their scenes tell them.
fn told(cases: Vec<Case>, unstated: bool) -> Result<Vec<Case>> {
    match unstated {
        true => cases.into_iter().map(Case::unstated).collect(),
        false => Ok(cases),
    }
}

fn in_parallel<T: Sync, R: Send>(
    all: &[T],
    each: impl Fn(&T) -> Result<R> + Sync + Send,
) -> Result<Vec<R>> {
    all.par_iter().map(each).collect()
}
