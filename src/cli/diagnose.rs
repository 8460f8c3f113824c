//! `smash diagnose`: which effect is missing.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use smash::diagnose::{CandidateReport, Diagnosis, Verdict};
use smash::files::{Output, print_bytes};
use smash::{Result, diagnose, diagnose_throws};

use super::method::Method;
use super::progress::ProgressLine;
use super::table::{aligned, decimals, p_value, probability};
use super::throws::{further, read_all};
use super::typed::Typed;

/// Finds which physical effect the model lacks, ranked, with the evidence
///
/// Every effect of the catalogue is tried on every body. The answer is one that is missing (and
/// those that can't be told apart from it), that nothing is missing, or that something is that no
/// effect explains.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input; several throws of the same objects are
    /// diagnosed together
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Where to write the diagnosis (smash.diagnosis/1), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    method: Method,
    /// A further candidate: an effect file of your own. May be given several times
    #[arg(long = "try", value_name = "EFFECT")]
    further: Vec<String>,
    /// Print the diagnosis as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, diagnoses, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let inputs: Vec<&Path> = arguments.scenes.iter().map(PathBuf::as_path).collect();
    let check = |path| Output::check(path, &inputs);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let scenes = read_all(&arguments.scenes)?;
    let options = arguments.method.refined()?;
    let further = further(&arguments.further, &options)?;
    let progress = ProgressLine::of_work("trying all effects that there are");
    let mut diagnosis = match scenes.as_slice() {
        [scene] => diagnose(scene, &options, &further)
            .map_err(|error| error.in_file(arguments.scenes[0].display().to_string()))?,
        throws => diagnose_throws(throws, &options, &further)?,
    };
    progress.clear();
    let typed = Typed::new(&arguments.scenes, &options, &further);
    diagnosis.advice = typed.advice(&diagnosis.advice);
    let json = diagnosis.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => print_bytes(in_words(&diagnosis).as_bytes()),
    }
}

fn in_words(diagnosis: &Diagnosis) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_words(&mut text, diagnosis);
    text
}

fn write_words(out: &mut String, diagnosis: &Diagnosis) -> std::fmt::Result {
    writeln!(out, "{}", diagnosis.explanation)?;
    if !diagnosis.candidates.is_empty() {
        write_candidates(out, diagnosis)?;
    }
    if !diagnosis.advice.is_empty() {
        writeln!(out, "\nNext")?;
    }
    for line in &diagnosis.advice {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}

fn write_candidates(out: &mut String, diagnosis: &Diagnosis) -> std::fmt::Result {
    let mut rows = vec![
        ["candidate", "probability", "p-value", "Δχ²", "held out, mm"].map(String::from).to_vec(),
    ];
    rows.extend(diagnosis.candidates.iter().map(row));
    writeln!(out, "\n{}", aligned(&rows))?;
    match diagnosis.verdict {
        Verdict::UnknownEffect => writeln!(
            out,
            "No candidate explains the poses: the probabilities are how they compare with each other."
        )?,
        _ => writeln!(
            out,
            "The probability that nothing is missing: {}.",
            probability(diagnosis.probability_of_nothing)
        )?,
    }
    writeln!(
        out,
        "A p-value counts all candidates. Held out: how far the fit misses positions that it hasn't \
         seen,\nwithout and with the effect."
    )
}

fn row(candidate: &CandidateReport) -> Vec<String> {
    let held_out = match (candidate.heldout_rmse_before, candidate.heldout_rmse_after) {
        (Some(before), Some(after)) => {
            format!("{} to {}", decimals(1e3 * before, 2), decimals(1e3 * after, 2))
        }
        _ => "-".to_string(),
    };
    vec![
        candidate.label(),
        probability(candidate.probability),
        p_value(candidate.p_value),
        decimals(candidate.delta_chi2, 1),
        held_out,
    ]
}
