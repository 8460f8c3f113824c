//! `smash compare`: results against the poses, and against each other.

use std::path::{Path, PathBuf};

use clap::Args;
use smash::compare::{against_truth, plots};
use smash::files::{Output, OutputFolder, display_name, print_bytes};
use smash::simulate::Truth;
use smash::{Reconstruction, Result, Scene, compare};

use super::comparison;

/// Compares results with the poses: where a model fails, and where several results differ
///
/// Residuals (pose minus model) by body, before and after the collision, in position and
/// orientation; whether they look random along the axes where causes show, and in words where they
/// don't; single poses that are wrong; momentum and energy before and after. With several results,
/// also what each says, and how far later ones are from the first; with --truth, how far all are from it.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
    /// Results of this scene (smash.result/1)
    #[arg(required = true, value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// What the scene was simulated with (smash.truth/1), to tell how far off results are
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// Where to write the comparison (smash.comparison/1), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Draw the residuals over time: RESULT-BODY.svg for each result and body, in this folder; made
    /// if need be
    #[arg(long, value_name = "FOLDER")]
    svg: Option<PathBuf>,
    /// Print the comparison as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, compares, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let results = arguments.results.iter();
    let inputs: Vec<&Path> = results
        .clone()
        .chain([&arguments.scene])
        .chain(&arguments.truth)
        .map(PathBuf::as_path)
        .collect();
    let check = |path| Output::check(path, &inputs);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let folder = arguments.svg.as_deref().map(OutputFolder::open).transpose()?;
    let scene = Scene::read(&arguments.scene)?;
    super::warn(scene.warnings());
    let read =
        |path: &PathBuf| Ok((display_name(path, "standard input"), Reconstruction::read(path)?));
    let results = results.map(read).collect::<Result<Vec<_>>>()?;
    let mut comparison = compare(&scene, &results)?;
    if let Some(path) = &arguments.truth {
        let name = display_name(path, "standard input");
        comparison.against_truth = against_truth(&scene, &Truth::read(path)?, &results)
            .map_err(|error| error.in_file(name))?;
    }
    super::warn(&comparison.warnings);
    let json = comparison.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    let drawn = match &folder {
        Some(folder) => draw(folder, &scene, &results)?,
        None => Vec::new(),
    };
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => {
            let mut words = comparison::in_words(&comparison);
            if let Some(folder) = &arguments.svg {
                words += &format!("\nPlots in {}: {}\n", folder.display(), drawn.join(", "));
            }
            print_bytes(words.as_bytes())
        }
    }
}

/// A picture for each result and body; the files' names.
fn draw(
    folder: &OutputFolder,
    scene: &Scene,
    results: &[(String, Reconstruction)],
) -> Result<Vec<String>> {
    let mut taken: Vec<String> = Vec::new();
    for (name, result) in results {
        let stem = Path::new(name).file_stem().map_or(name.clone(), |s| s.to_string_lossy().into());
        for plot in plots(scene, name, result).map_err(|error| error.in_file(name))? {
            let wanted = format!("{}-{}", plain(&stem), plain(&plot.body));
            let numbered = (2..).map(|number| format!("{wanted}-{number}.svg"));
            let first = format!("{wanted}.svg");
            let mut names = std::iter::once(first.clone()).chain(numbered);
            let file = names.find(|name| !taken.contains(name)).unwrap_or(first);
            folder.output(&file)?.write(plot.svg.as_bytes())?;
            taken.push(file);
        }
    }
    Ok(taken)
}

/// `name` with what a file's name can't have everywhere as `_`.
fn plain(name: &str) -> String {
    let keep = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    name.chars().take(60).map(keep).collect()
}
