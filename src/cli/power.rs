//! `smash power`: what a planned film could show.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;
use smash::Result;
use smash::files::{Output, display_name, print_bytes};
use smash::power::{AxisPower, Changed, Power, power_with_progress};
use smash::scene::Noise;
use smash::simulate::{EffectSpec, NoiseSpec, SimulationSpec};

use super::progress::ProgressLine;
use super::table::aligned;

/// Tells, before filming, how large an effect must be to be found, with how many frames and how
/// little noise
///
/// The film is planned as for `smash simulate`, without the effect. An effect's parameter may be
/// given, for its size and its direction; without it, each is tried on its own.
#[derive(Args)]
pub struct Arguments {
    /// The plan (smash.simulation/1), or - for standard input
    spec: PathBuf,
    /// The effect that shall be found: NAME[@BODY][:parameter=value,…]
    #[arg(long, value_name = "EFFECT")]
    effect: String,
    /// How far off its null the parameter is, in its unit, in place of the given or typical size
    #[arg(long, value_name = "SIZE", allow_negative_numbers = true, value_parser = above_zero)]
    size: Option<f64>,
    /// One σ of annotated positions in m, in place of the plan's
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = above_zero, requires = "noise_orientation")]
    noise_position: Option<f64>,
    /// One σ of annotated orientations in rad, in place of the plan's
    #[arg(long, value_name = "RAD", allow_negative_numbers = true, value_parser = above_zero, requires = "noise_position")]
    noise_orientation: Option<f64>,
    /// Where to write the answer (smash.power/1), or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print the answer as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, asks, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let check = |path| Output::check(path, &[&arguments.spec]);
    let output = arguments.output.as_deref().map(check).transpose()?;
    let mut spec = SimulationSpec::read(&arguments.spec)?;
    if let (Some(position), Some(orientation)) =
        (arguments.noise_position, arguments.noise_orientation)
    {
        spec.noise = NoiseSpec::Gaussian(Noise { position, orientation });
    }
    let effect = EffectSpec::parse(&arguments.effect)?;
    let line = ProgressLine::new();
    let power = power_with_progress(&spec, &effect, arguments.size, &|of| line.step(of));
    line.clear();
    let power =
        power.map_err(|error| error.in_file(display_name(&arguments.spec, "standard input")))?;
    let json = power.to_json();
    if let Some(output) = &output {
        output.write(json.as_bytes())?;
    }
    match &output {
        // Standard output carries the data already.
        Some(output) if output.is_standard_output() => Ok(()),
        _ if arguments.json => print_bytes(json.as_bytes()),
        _ => print_bytes(in_words(&power).as_bytes()),
    }
}

fn in_words(power: &Power) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_words(&mut text, power);
    text
}

fn write_words(out: &mut String, power: &Power) -> std::fmt::Result {
    writeln!(out, "{}\n", power.explanation)?;
    let header = ["found with", "as planned", "frames ½", "×2", "×4", "noise ×2", "½", "¼"];
    let mut rows = vec![header.map(String::from).to_vec()];
    rows.extend(power.axes.iter().map(row));
    writeln!(out, "{}", aligned(&rows))?;
    writeln!(
        out,
        "Planned are {} poses with a noise of {} mm and {:.2}°. Found: smash diagnose tells the \
         effect\nfrom noise, whichever of {} candidates it tries.",
        power.poses,
        1e3 * power.noise.position,
        power.noise.orientation.to_degrees(),
        power.candidates_tried
    )
}

fn row(axis: &AxisPower) -> Vec<String> {
    let mut row = vec![axis.in_words(axis.size), percent(axis.power)];
    let all = axis.frames.iter().chain(&axis.noise);
    row.extend(all.map(|changed: &Changed| changed.power.map_or("-".to_string(), percent)));
    row
}

fn percent(power: f64) -> String {
    format!("{:.0} %", 100.0 * power)
}

fn above_zero(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err("give a number above 0".to_string()),
    }
}
