//! `smash improve`: the ladder of effects.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use smash::diagnose::Verdict;
use smash::files::{Output, print_bytes, shell_word};
use smash::improve::{Improvement, Rung};
use smash::{Result, improve, improve_throws};

use super::diagnose::{read_all, requests};
use super::method::Method;
use super::table::{aligned, degrees, millimetres};

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
    let further = requests(&arguments.further)?;
    let options = arguments.method.refined()?;
    let improvement = match scenes.as_slice() {
        [scene] => improve(scene, &options, &further)
            .map_err(|error| error.in_file(arguments.scenes[0].display().to_string()))?,
        throws => improve_throws(throws, &options, &further)?,
    };
    let json = improvement.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => {
            let path = match arguments.scenes.as_slice() {
                [scene] => shell_word(&scene.to_string_lossy()),
                _ => "SCENE".to_string(),
            };
            print_bytes(in_words(&improvement, &path).as_bytes())
        }
    }
}

fn in_words(improvement: &Improvement, path: &str) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_words(&mut text, improvement, path);
    text
}

fn write_words(out: &mut String, improvement: &Improvement, path: &str) -> std::fmt::Result {
    let header =
        ["model", "p-value", "positions", "held out", "orientations", "χ²/dof", "m_b/m_a", "c"];
    let mut rows = vec![header.map(String::from).to_vec()];
    rows.extend(improvement.ladder.iter().map(row));
    writeln!(out, "{}", aligned(&rows))?;
    if !improvement.dropped.is_empty() {
        writeln!(out, "dropped again, as superfluous: {}\n", improvement.dropped.join(", "))?;
    }
    let last = improvement.ladder.last();
    let added = last.map(|rung| rung.with.join(", ")).unwrap_or_default();
    match improvement.verdict {
        Verdict::NothingMissing => {
            writeln!(out, "nothing is missing that these poses could show")?;
        }
        Verdict::Missing => writeln!(out, "with {added} nothing more is missing")?,
        Verdict::UnknownEffect => writeln!(
            out,
            "something is left that no effect explains: see smash diagnose, or write a law of your \
             own"
        )?,
    }
    writeln!(out, "\neach rung again:")?;
    for rung in &improvement.ladder {
        let with: String = rung.with.iter().map(|label| format!(" --with {label}")).collect();
        writeln!(out, "  smash reconstruct {path}{with}")?;
    }
    Ok(())
}

fn row(rung: &Rung) -> Vec<String> {
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_string());
    vec![
        rung.added.as_ref().map_or("start".to_string(), |added| format!("+ {added}")),
        or_none(rung.p_value.map(|p| format!("{p:.1e}"))),
        millimetres(rung.position_rmse),
        or_none(rung.heldout_position_rmse.map(millimetres)),
        or_none(rung.orientation_rmse.map(degrees)),
        or_none(rung.reduced_chi2.map(|reduced| format!("{reduced:.2}"))),
        or_none(rung.mass_ratio.map(|m| format!("{m:.4}"))),
        or_none(rung.restitution.map(|c| format!("{c:.4}"))),
    ]
}
