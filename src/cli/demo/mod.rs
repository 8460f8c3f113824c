//! `smash demo`: the whole story, without any data.

mod folder;
mod story;

use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use smash::files::print_bytes;
use smash::reconstruct::RefinedOptions;
use smash::report::{has_page, page, report};
use smash::simulate::{SimulationSpec, simulate};
use smash::{Options, Result, compare, diagnose, improve, reconstruct};

use super::typed::Typed;
use super::{again, browser};
use folder::DemoFolder;

/// A ball that spins, a box, and a force that the model doesn't know.
const SPEC: &str = include_str!("spec.json");

/// Tells the whole story on a simulated collision: reconstruct, see what is missing, add it, report
///
/// It needs no data and takes some seconds. The scene, the results and the report are written to a
/// folder, so that each command can be typed again.
#[derive(Args)]
pub struct Arguments {
    /// The folder for the demo's files; made if need be
    #[arg(short, long, value_name = "FOLDER", default_value = "smash-demo")]
    output: PathBuf,
    /// Open the report in the browser
    #[arg(long)]
    open: bool,
    /// Print what was found as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Simulates, and takes each step that a user would.
pub fn run(arguments: &Arguments) -> Result<()> {
    let tell = |words: String| match arguments.json {
        true => Ok(()),
        false => print_bytes(words.as_bytes()),
    };
    let simulation = simulate(&SimulationSpec::parse(SPEC, "the demo's specification")?)?;
    let scene = &simulation.scene;
    let folder = DemoFolder::open(&arguments.output, &simulation.scene_file.to_json())?;
    folder.spec.write(SPEC.as_bytes())?;
    folder.scene.write(simulation.scene_file.to_json().as_bytes())?;
    let [scene_path, base_path, better_path, report_path] =
        [&folder.scene, &folder.base, &folder.better, &folder.report].map(folder::word);
    let mut commands = Vec::new();
    let mut step = |title: &str, command: String| {
        let words = story::step(commands.len() + 1, title, &command);
        commands.push(command);
        tell(words)
    };
    tell(story::opening(&simulation))?;

    step(story::FIT, format!("smash reconstruct {scene_path} -o {base_path}"))?;
    let base = reconstruct(scene, &Options::default())?;
    folder.base.write(base.to_json().as_bytes())?;
    tell(story::fit(&base))?;

    step(story::MISFIT, format!("smash compare {scene_path} {base_path}"))?;
    let comparison = compare(scene, &[(base_path.clone(), base.clone())])?;
    tell(story::misfit(&comparison))?;

    step(story::MISSING, format!("smash diagnose {scene_path}"))?;
    let options = RefinedOptions::default();
    let mut diagnosis = diagnose(scene, &options, &[])?;
    let typed = Typed::of_scene(folder.scene.path());
    diagnosis.advice = typed.advice(&diagnosis.advice);
    tell(story::missing(&diagnosis))?;

    step(story::LADDER, format!("smash improve {scene_path}"))?;
    let improvement = improve(scene, &options, &[])?;
    folder.better.write(improvement.result.to_json().as_bytes())?;
    tell(story::ladder(&improvement))?;

    let better = again::reconstruction(&scene_path, &improvement.result.made_with()?);
    step(story::TRUTH, format!("{better} -o {better_path}"))?;
    tell(story::truth(&base, &improvement.result, &simulation.truth))?;

    let results =
        [(better_path.clone(), improvement.result.clone()), (base_path.clone(), base.clone())];
    let mut report = report(scene, &results, Some(diagnosis), Some(improvement.clone()))?;
    let command = format!("smash report {scene_path} {better_path} {base_path} -o {report_path}");
    step(story::REPORT, command)?;
    report.commands = commands;
    // Without Node there is no page, but all the rest.
    let seen = has_page().then(|| folder.report.path().display().to_string());
    if seen.is_some() {
        folder.report.write(page(&report)?.as_bytes())?;
    }
    let is_open = arguments.open && seen.as_deref().is_some_and(browser::is_opened);
    if let Some(path) = seen.as_ref().filter(|_| arguments.open && !is_open) {
        super::warn(&[format!("no browser could be opened\n  hint: open {path} in one yourself")]);
    }
    tell(story::closing(seen.as_deref(), is_open))?;
    if !arguments.json {
        return Ok(());
    }
    let told = json!({
        "folder": arguments.output.display().to_string(),
        "report": seen,
        "ladder": improvement.ladder, "verdict": improvement.verdict,
        "effects": improvement.result.effects, "truth": simulation.truth,
    });
    print_bytes(format!("{told:#}\n").as_bytes())
}
