//! `smash compare`: results against the poses, and against each other.

use std::path::{Path, PathBuf};

use clap::Args;
use smash::files::{Output, display_name, print_bytes};
use smash::{Reconstruction, Result, Scene, compare};

use super::comparison;

/// Compares results with the poses: where a model fails, and where several results differ
///
/// Residuals (model minus pose) by body, before and after the collision, in position and
/// orientation. With several results, also what each says, and how far later ones are from the
/// first.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
    /// Results of this scene (smash.result/1)
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// Where to write the comparison (smash.comparison/1), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the comparison as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, compares, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let results = arguments.results.iter();
    let inputs: Vec<&Path> =
        results.clone().chain([&arguments.scene]).map(PathBuf::as_path).collect();
    let check = |path| Output::check(path, &inputs);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let scene = Scene::read(&arguments.scene)?;
    super::warn(scene.warnings());
    let read =
        |path: &PathBuf| Ok((display_name(path, "standard input"), Reconstruction::read(path)?));
    let results = results.map(read).collect::<Result<Vec<_>>>()?;
    let comparison = compare(&scene, &results)?;
    super::warn(&comparison.warnings);
    let json = comparison.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => print_bytes(comparison::in_words(&comparison).as_bytes()),
    }
}
