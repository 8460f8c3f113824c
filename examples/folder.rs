//! Third rung: all scenes of a folder on all cores, one row each.
//!
//! ```sh
//! cargo run --release --example folder -- scenes
//! ```

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use smash::{Error, ErrorKind, Options, Reconstruction, Result, Scene};

fn main() -> Result<()> {
    smash::silence_solver_log();
    let folder: PathBuf = std::env::args_os().nth(1).map_or("scenes".into(), PathBuf::from);
    let scenes = scenes_in(&folder)?;
    println!("| scene | m_b/m_a | restitution | t_c (s) | error (mm) | error (deg) | flags |");
    println!("|---|---|---|---|---|---|---|");
    // Scenes are independent: any number of threads gives the same rows, in the same order.
    let rows: Vec<Result<String>> = scenes
        .par_iter()
        .map(|scene| Ok(row(&smash::reconstruct(scene, &Options::default())?)))
        .collect();
    for row in rows {
        match row {
            Ok(row) => println!("{row}"),
            Err(error) => eprintln!("{error}"),
        }
    }
    Ok(())
}

/// The scenes among the folder's JSON files, by name.
fn scenes_in(folder: &Path) -> Result<Vec<Scene>> {
    let entries = std::fs::read_dir(folder).map_err(|error| {
        Error::new(ErrorKind::Read, error.to_string()).in_file(folder.display().to_string())
    })?;
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    let is_scene = |path: &&PathBuf| {
        path.extension().is_some_and(|e| e == "json")
            && !path.to_string_lossy().ends_with(".spec.json")
    };
    paths.iter().filter(is_scene).map(Scene::read).collect()
}

fn row(result: &Reconstruction) -> String {
    let number =
        |value: Option<f64>| value.map_or("–".to_string(), |value| format!("{value:.3}"));
    let flags: Vec<String> = result.flags.iter().map(|flag| format!("{flag:?}")).collect();
    format!(
        "| {} | {} | {} | {} | {:.2} | {} | {} |",
        result.scene,
        number(result.mass_ratio.as_ref().and_then(|estimate| estimate.value)),
        number(result.restitution.value),
        number(result.collision_time.value),
        1e3 * result.fit.position_rmse,
        number(result.fit.orientation_rmse.map(f64::to_degrees)),
        flags.join(", "),
    )
}
