//! `smash improve`: the ladder of effects.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use smash::diagnose::{MISREAD, Together, Verdict};
use smash::files::{Output, print_bytes};
use smash::improve::{Improvement, Rung};
use smash::reconstruct::Flag;
use smash::{Result, improve, improve_throws};

use super::method::Method;
use super::progress::ProgressLine;
use super::table::{aligned, degrees, millimetres, p_value};
use super::throws::{further, read_all};
use super::typed::Typed;

/// Adds effect after effect until nothing significant is missing, and shows the error fall
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input; several throws of the same objects are
    /// improved together
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Where to write the improvement (smash.improvement/1), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    method: Method,
    /// A further candidate: an effect file of your own. May be given several times
    #[arg(long = "try", value_name = "EFFECT")]
    further: Vec<String>,
    /// Print the improvement as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, improves, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let inputs: Vec<&Path> = arguments.scenes.iter().map(PathBuf::as_path).collect();
    let check = |path| Output::check(path, &inputs);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let scenes = read_all(&arguments.scenes)?;
    let options = arguments.method.refined()?;
    let further = further(&arguments.further, &options)?;
    let progress = ProgressLine::of_work("adding effect after effect, each of all that there are");
    let improvement = match scenes.as_slice() {
        [scene] => improve(scene, &options, &further)
            .map_err(|error| error.in_file(arguments.scenes[0].display().to_string()))?,
        throws => improve_throws(throws, &options, &further)?,
    };
    progress.clear();
    let json = improvement.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => {
            let typed = Typed::new(&arguments.scenes, &options, &further);
            let (next, again) = (next(&improvement, &typed), commands(&improvement, &typed));
            print_bytes(in_words(&improvement, &next, &again).as_bytes())
        }
    }
}

/// What makes each rung, and before them what writes the laws that they need and no file holds.
fn commands(improvement: &Improvement, typed: &Typed) -> Vec<String> {
    let rungs = improvement.ladder.iter();
    let rungs: Vec<String> = rungs.map(|rung| typed.reconstruction(&rung.with)).collect();
    [typed.writing(&rungs), rungs].concat()
}

/// What to film, and what to type next.
fn next(improvement: &Improvement, typed: &Typed) -> Vec<String> {
    let mut next: Vec<String> = improvement.telling_apart();
    let law = improvement.other_laws.first();
    next.extend(law.map_or(Vec::new(), |law| law.trying(&typed.given())));
    let is_open = improvement.verdict == Verdict::UnknownEffect && !improvement.is_misread();
    if is_open && law.is_none() {
        let with = improvement.ladder.last().map_or(&[][..], |rung| &rung.with);
        let with: String = with.iter().map(|label| format!(" --with {label}")).collect();
        let scenes = if typed.has_several_scenes() { "SCENE SCENE …" } else { "SCENE" };
        let given = typed.given();
        next.push(format!("see what is left: smash diagnose {scenes}{given}{with}"));
    }
    if let Some(otherwise) = &improvement.otherwise {
        next.insert(0, otherwise.mend.clone());
    }
    let is_explained = improvement.law_alone().is_some_and(|law| !law.leaves_more);
    if is_open && improvement.result.flags.contains(&Flag::PoorFit) && !is_explained {
        next.insert(0, MISREAD.to_string());
    }
    typed.advice(&next)
}

/// `next`: what to do then; `again`: the commands that make the rungs.
fn in_words(improvement: &Improvement, next: &[String], again: &[String]) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_words(&mut text, improvement, next, again);
    text
}

fn write_words(
    out: &mut String,
    improvement: &Improvement,
    next: &[String],
    again: &[String],
) -> std::fmt::Result {
    writeln!(out, "{}", aligned(&table_of(&improvement.ladder)))?;
    let rungs: Vec<String> = improvement.ladder.iter().filter_map(Rung::in_words).collect();
    if !rungs.is_empty() {
        writeln!(out, "{}\n", rungs.join("\n"))?;
    }
    if !improvement.dropped.is_empty() {
        writeln!(
            out,
            "Left out again, since the others do as well: {}\n",
            improvement.dropped.join(", ")
        )?;
    }
    writeln!(out, "{}", improvement.explanation)?;
    for one in &improvement.together {
        writeln!(out, "{}", one.in_words())?;
    }
    if improvement.verdict == Verdict::UnknownEffect && !improvement.together.is_empty() {
        writeln!(out, "{}", Together::OF_A_POOR_MODEL)?;
    }
    if !next.is_empty() {
        writeln!(out, "\nNext")?;
    }
    for line in next {
        writeln!(out, "  {line}")?;
    }
    writeln!(out, "\nEach rung again")?;
    for command in again {
        writeln!(out, "  {command}")?;
    }
    Ok(())
}

/// A header, and a row for each rung.
pub fn table_of(ladder: &[Rung]) -> Vec<Vec<String>> {
    let header =
        ["model", "p-value", "positions", "held out", "orientations", "χ²/dof", "m_b/m_a", "c"];
    std::iter::once(header.map(String::from).to_vec()).chain(ladder.iter().map(row)).collect()
}

fn row(rung: &Rung) -> Vec<String> {
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_string());
    vec![
        rung.added.as_ref().map_or("start".to_string(), |added| format!("+ {added}")),
        or_none(rung.p_value.map(p_value)),
        millimetres(rung.position_rmse),
        or_none(rung.heldout_position_rmse.map(millimetres)),
        or_none(rung.orientation_rmse.map(degrees)),
        or_none(rung.reduced_chi2.map(|reduced| format!("{reduced:.2}"))),
        or_none(rung.mass_ratio.map(|m| format!("{m:.4}"))),
        or_none(rung.restitution.map(|c| format!("{c:.4}"))),
    ]
}
