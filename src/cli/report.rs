//! `smash report`: one page to look at.

use std::path::{Path, PathBuf};

use clap::Args;
use smash::effect::{EffectRequest, catalogue};
use smash::files::{Output, display_name, print_bytes, shell_word};
use smash::improve::Improvement;
use smash::reconstruct::{Options, RefinedOptions};
use smash::report::{page, report, require_page};
use smash::{Reconstruction, Result, Scene, diagnose, improve, reconstruct};

use super::again;
use super::law_files::LawFiles;
use super::typed::Typed;

/// Writes one page to look at: the collision in 3D, residuals, what is missing, all numbers
///
/// It needs no network and no other file. It holds the results side by side, and asks what the base
/// model lacks, as `smash diagnose` and `smash improve` do. Without any results it shows the base
/// model, and the best that could be found.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
    /// Results of this scene (smash.result/1), the main one first
    #[arg(value_name = "RESULT")]
    results: Vec<PathBuf>,
    /// Where to write the page (HTML), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Print the page's data (smash.report/1) as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, asks, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let inputs: Vec<&Path> =
        arguments.results.iter().chain([&arguments.scene]).map(PathBuf::as_path).collect();
    require_page()?;
    let output = Output::check(&arguments.output, &inputs)?;
    super::refuse_json_beside(&output, arguments.json)?;
    let scene = Scene::read(&arguments.scene)?;
    super::warn(scene.warnings());
    let read =
        |path: &PathBuf| Ok((display_name(path, "standard input"), Reconstruction::read(path)?));
    let mut results = arguments.results.iter().map(read).collect::<Result<Vec<_>>>()?;
    let name = arguments.scene.display().to_string();
    let (options, further) = (RefinedOptions::default(), own_effects(&results)?);
    let mut diagnosis =
        diagnose(&scene, &options, &further).map_err(|error| error.in_file(&name))?;
    let improvement = improve(&scene, &options, &further).map_err(|error| error.in_file(&name))?;
    if results.is_empty() {
        results = first_and_last(&scene, &improvement)?;
    }
    let typed = Typed::new(std::slice::from_ref(&arguments.scene), &options, &further);
    diagnosis.advice = typed.advice(&diagnosis.advice);
    let mut report = report(&scene, &results, Some(diagnosis), Some(improvement))?;
    super::warn(&report.warnings);
    report.commands = commands(arguments, &results, &further)?;
    output.write(page(&report)?.as_bytes())?;
    match output.is_standard_output() {
        // Standard output carries the page already.
        true => Ok(()),
        false if arguments.json => print_bytes(report.to_json().as_bytes()),
        false => print_bytes(in_words(arguments, &results).as_bytes()),
    }
}

/// Effects that stand in the results with their laws: candidates beyond the catalogue, on every body,
/// with the values that the first result with the law was given. Of two laws of one name it is the first:
/// answers tell candidates by it.
fn own_effects(results: &[(String, Reconstruction)]) -> Result<Vec<EffectRequest>> {
    let mut all: Vec<EffectRequest> = Vec::new();
    for (_, result) in results {
        let Options::Refined(options) = result.made_with()? else { continue };
        for EffectRequest { effect, fixed, .. } in options.effects {
            let is_known = |known: &EffectRequest| known.effect.name == effect.name;
            if !catalogue().contains(&effect) && !all.iter().any(is_known) {
                all.push(EffectRequest { effect, body: None, fixed });
            }
        }
    }
    Ok(all)
}

/// The base model, and the top of the ladder if there is one.
fn first_and_last(
    scene: &Scene,
    improvement: &Improvement,
) -> Result<Vec<(String, Reconstruction)>> {
    let base = reconstruct(scene, &Options::default())?;
    let mut results = vec![("base model".to_string(), base)];
    if let Some(top) = improvement.ladder.last().filter(|rung| !rung.with.is_empty()) {
        let name = format!("with {}", top.with.join(" and "));
        results.insert(0, (name, improvement.result.clone()));
    }
    Ok(results)
}

/// What makes the report again, from the scene alone.
fn commands(
    arguments: &Arguments,
    results: &[(String, Reconstruction)],
    further: &[EffectRequest],
) -> Result<Vec<String>> {
    // Standard input has no name to type.
    let word = |path: &Path, name: &str| match path == Path::new("-") {
        true => name.to_string(),
        false => shell_word(&path.to_string_lossy()),
    };
    let scene = word(&arguments.scene, "SCENE");
    let made: Vec<Options> =
        results.iter().map(|(_, result)| result.made_with()).collect::<Result<_>>()?;
    let files = LawFiles::of(made.iter().flat_map(effects));
    let mut commands = Vec::new();
    let mut paths = String::new();
    for (path, options) in arguments.results.iter().zip(made) {
        let path = word(path, "RESULT");
        let made = again::reconstruction(&scene, &files.named(options));
        commands.push(format!("{made} -o {path}"));
        paths += &format!(" {path}");
    }
    let further: Vec<String> = further
        .iter()
        .map(|law| format!(" --try {}", shell_word(&files.filed(law).to_string())))
        .collect();
    for ask in ["diagnose", "improve"] {
        commands.push(format!("smash {ask} {scene}{}", further.concat()));
    }
    commands.push(format!("smash report {scene}{paths} -o {}", word(&arguments.output, "-")));
    Ok([files.writing(&commands), commands].concat())
}

fn effects(options: &Options) -> &[EffectRequest] {
    match options {
        Options::Refined(options) => &options.effects,
        _ => &[],
    }
}

fn in_words(arguments: &Arguments, results: &[(String, Reconstruction)]) -> String {
    let names: Vec<&str> = results.iter().map(|(name, _)| name.as_str()).collect();
    format!("{} shows {}: open it in a browser\n", arguments.output.display(), names.join(", "))
}
