//! `smash diagnose`: which effect is missing.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use smash::diagnose::{CandidateReport, Diagnosis};
use smash::effect::EffectRequest;
use smash::files::{Output, print_bytes};
use smash::{Result, Scene, diagnose};

use super::method::Method;
use super::table::{aligned, p_value, probability};
use super::typed::Typed;

/// Finds which physical effect the model lacks, ranked, with the evidence
///
/// Every effect of the catalogue is tried on every body. The answer is one that is missing (and
/// those that can't be told apart from it), that nothing is missing, or that something is that no
/// effect explains.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
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
    let check = |path| Output::check(path, &[&arguments.scene]);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let scene = Scene::read(&arguments.scene)?;
    super::warn(scene.warnings());
    let further = requests(&arguments.further)?;
    let mut diagnosis = diagnose(&scene, &arguments.method.refined()?, &further)
        .map_err(|error| error.in_file(arguments.scene.display().to_string()))?;
    let typed = Typed::new(&arguments.scene, &arguments.method, &arguments.further)?;
    for line in &mut diagnosis.advice {
        *line = typed.completed(line);
    }
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

/// The effects that were typed.
pub fn requests(texts: &[String]) -> Result<Vec<EffectRequest>> {
    texts.iter().map(|text| EffectRequest::parse(text)).collect()
}

fn in_words(diagnosis: &Diagnosis) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_words(&mut text, diagnosis);
    text
}

fn write_words(out: &mut String, diagnosis: &Diagnosis) -> std::fmt::Result {
    writeln!(out, "{}\n", diagnosis.explanation)?;
    let mut rows = vec![
        ["candidate", "probability", "p-value", "Δχ²", "held out, mm"].map(String::from).to_vec(),
    ];
    rows.extend(diagnosis.candidates.iter().map(row));
    writeln!(out, "{}", aligned(&rows))?;
    writeln!(
        out,
        "The probability that nothing is missing: {}. A p-value counts all candidates. Held out: how \
         far\nthe fit misses positions that it hasn't seen, without and with the effect.",
        probability(diagnosis.probability_of_nothing)
    )?;
    if !diagnosis.advice.is_empty() {
        writeln!(out, "\nNext")?;
    }
    for line in &diagnosis.advice {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}

fn row(candidate: &CandidateReport) -> Vec<String> {
    let held_out = match (candidate.heldout_rmse_before, candidate.heldout_rmse_after) {
        (Some(before), Some(after)) => format!("{:.2} to {:.2}", 1e3 * before, 1e3 * after),
        _ => "-".to_string(),
    };
    vec![
        candidate.label(),
        probability(candidate.probability),
        p_value(candidate.p_value),
        format!("{:.1}", candidate.delta_chi2),
        held_out,
    ]
}
