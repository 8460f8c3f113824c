//! `smash reconstruct`: the main job.

use std::path::{Path, PathBuf};

use clap::Args;
use smash::files::{Output, print_bytes, shell_word};
use smash::reconstruct::{
    Flag, Intervals, Loss, Options, Preset, RefinedOptions, SegmentCriterion,
    reconstruct_with_progress,
};
use smash::{Error, Reconstruction, Result, Scene};

use super::again;
use super::law_files::LawFiles;
use super::method::Method;
use super::progress::ProgressLine;
use super::summary;

/// Reconstructs the collision in a scene: mass ratio, restitution, velocities and spins
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
    /// Where to write the result (smash.result/1), or - for standard output
    #[arg(short, long, value_name = "RESULT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    method: Method,
    /// Print the result as JSON instead of words
    #[arg(long)]
    json: bool,
}

impl Arguments {
    /// What is worth trying after `result`.
    fn next_steps(&self, scene: &Scene, options: &Options, result: &Reconstruction) -> Vec<String> {
        let path = shell_word(&self.scene.to_string_lossy());
        // Standard input can't be read twice.
        let is_file = self.scene != Path::new("-");
        let mut steps = Vec::new();
        if is_file && result.segment_by == SegmentCriterion::Distance {
            let by_cost = again::reconstruction(&path, &Options::paper_by_cost());
            steps.push(format!("{by_cost}    finds the right segment more often"));
        }
        if is_file && result.preset == Preset::Paper {
            let refined = again::reconstruction(&path, &Options::default());
            steps.push(format!("{refined}    more accurate, with error bars"));
        }
        if let Some(output) = self.output.as_ref().filter(|_| is_file) {
            let output = shell_word(&output.to_string_lossy());
            steps.push(format!("smash compare {path} {output}    where it misses the poses"));
        }
        if let (true, Options::Refined(options)) = (is_file, options) {
            steps.extend(self.with_options(&path, scene, options, result));
        }
        if !result.flags.is_empty() || !result.warnings.is_empty() {
            steps.push(
                "look at the poses nearest the collision, and at the flags and warnings above"
                    .to_string(),
            );
        }
        steps
    }

    /// Those that go on with the options, and before them what keeps a law that no file holds.
    fn with_options(
        &self,
        path: &str,
        scene: &Scene,
        options: &RefinedOptions,
        result: &Reconstruction,
    ) -> Vec<String> {
        let laws = LawFiles::of(&options.effects);
        let command = |options: RefinedOptions, start: &str| {
            let options = laws.named(Options::Refined(options));
            again::command(start, path, &options)
        };
        let mut steps = Vec::new();
        if result.flags.contains(&Flag::PoorFit) {
            let diagnose = command(options.clone(), "smash diagnose");
            steps.push(format!("{diagnose}    which physics the model lacks"));
        }
        if options.loss != Loss::Robust && result.outliers.len() * 100 > poses(scene) {
            let intervals = Intervals::Covariance;
            let robust = RefinedOptions { loss: Loss::Robust, intervals, ..options.clone() };
            let robust = command(robust, "smash reconstruct");
            steps.push(format!("{robust}    lets wrong annotations hardly count"));
        }
        let keep = laws.writing(&steps).into_iter();
        keep.map(|command| format!("{command}    keeps the law, which no file holds"))
            .chain(steps)
            .collect()
    }
}

fn poses(scene: &Scene) -> usize {
    scene.bodies().iter().map(|body| body.observations.len()).sum()
}

/// Reads, reconstructs, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let check = |path| Output::check(path, &[&arguments.scene]);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let scene =
        Scene::read(&arguments.scene).map_err(|error| of_folder(error, &arguments.scene))?;
    super::warn(scene.warnings());
    let progress = ProgressLine::new();
    let options = arguments.method.options()?;
    let result = reconstruct_with_progress(&scene, &options, &|step| {
        progress.show(step);
    })
    .map_err(|error| error.in_file(arguments.scene.display().to_string()))?;
    progress.clear();
    let json = result.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => print_bytes(
            summary::of(&result, &arguments.next_steps(&scene, &options, &result), output.as_ref())
                .as_bytes(),
        ),
    }
}

/// An error about a folder leads to the command that takes folders.
fn of_folder(error: Error, path: &Path) -> Error {
    if !path.is_dir() {
        return error;
    }
    let folder = shell_word(&path.to_string_lossy());
    error.mend(format!("name a scene in it, or take all of them: smash batch {folder} -o RESULTS"))
}
