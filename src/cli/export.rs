//! `smash export`: a result's motion for other programs.

use std::path::{Path, PathBuf};

use clap::error::ErrorKind;
use clap::{Args, ValueEnum};
use serde_json::json;
use smash::files::{Output, display_name, print_bytes};
use smash::{Reconstruction, Result, export};

/// Writes the motion of a result: a film in 3D for viewers such as Blender, or a table
///
/// The bodies move as the result says, from the first pose to the last; no scene is needed.
#[derive(Args)]
pub struct Arguments {
    /// The result (smash.result/1), or - for standard input
    result: PathBuf,
    /// Where to write it, or - for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// What to write; by default as the name of FILE ends, .glb or .csv
    #[arg(long)]
    format: Option<Format>,
    /// Frames a second; by default those of the scene, or 60
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, value_parser = frames_a_second)]
    fps: Option<f64>,
    /// Print what was written as JSON instead of words
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    /// glTF 2.0, in one binary file (.glb): the bodies and their motion, for 3D programs and viewers
    Gltf,
    /// A table: a row for each body and frame, with velocity and spin
    Csv,
}

/// Reads, flies, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let format = arguments.format.or(by_ending(&arguments.output)).unwrap_or_else(|| {
        let file = display_name(&arguments.output, "standard output");
        let problem = format!(
            "{file}: its name doesn't tell what to write: end it in `.glb` or `.csv`, or add `--format \
             gltf` or `--format csv`"
        );
        super::usage_error(ErrorKind::MissingRequiredArgument, &problem)
    });
    let output = Output::check(&arguments.output, &[&arguments.result])?;
    super::refuse_json_beside(&output, arguments.json)?;
    let result = Reconstruction::read(&arguments.result)?;
    let bytes = match format {
        Format::Gltf => export::gltf(&result, arguments.fps),
        Format::Csv => export::csv(&result, arguments.fps).map(String::into_bytes),
    };
    let name = display_name(&arguments.result, "standard input");
    output.write(&bytes.map_err(|error| error.in_file(name))?)?;
    let unknown = unknown(&result);
    if output.is_standard_output() {
        // It carries the data already.
        return Ok(());
    }
    let file = arguments.output.display().to_string();
    if arguments.json {
        let told = json!({"file": file, "format": format.name(), "unknown": unknown});
        return print_bytes(format!("{told:#}\n").as_bytes());
    }
    let mut words = format!("Written: {file}\n");
    for one in &unknown {
        words += &format!("Not known, and left out: {one}\n");
    }
    words += &format!("Next:    {}\n", format.next());
    print_bytes(words.as_bytes())
}

impl Format {
    fn name(self) -> &'static str {
        match self {
            Format::Gltf => "gltf",
            Format::Csv => "csv",
        }
    }

    fn next(self) -> &'static str {
        match self {
            Format::Gltf => "open it in Blender (File, Import, glTF 2.0) or any viewer of glTF",
            Format::Csv => {
                "open it in a spreadsheet; a line says which column is what, in which unit"
            }
        }
    }
}

fn by_ending(path: &Path) -> Option<Format> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "glb" => Some(Format::Gltf),
        "csv" => Some(Format::Csv),
        _ => None,
    }
}

/// What of the motion the result doesn't tell.
fn unknown(result: &Reconstruction) -> Vec<String> {
    let mut unknown = Vec::new();
    for body in &result.bodies {
        let name = &body.name;
        let spins = [body.angular_velocity_before, body.angular_velocity_after];
        match (body.orientation, spins) {
            (Some(_), [Some(_), Some(_)]) => {}
            (Some(_), [None, Some(_)]) => {
                unknown.push(format!("how {name} turns before it is hit"))
            }
            (Some(_), [Some(_), None]) => unknown.push(format!("how {name} turns after it is hit")),
            _ => unknown.push(format!("how {name} turns")),
        }
    }
    unknown
}

fn frames_a_second(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(fps) if (1e-3..=1e7).contains(&fps) => Ok(fps),
        _ => Err("give the frames a second, above 0 (0.001 to 10000000), such as 60".to_string()),
    }
}
