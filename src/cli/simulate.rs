//! `smash simulate`: the dynamics run forwards.

use std::path::PathBuf;

use clap::Args;
use smash::files::{Output, display_name, print_bytes};
use smash::simulate::{NoiseSpec, Simulation, SimulationSpec, simulate};
use smash::{Error, ErrorKind, Result};

/// Makes a scene from bodies, their speeds and a collision, with sampling and noise
#[derive(Args)]
pub struct Arguments {
    /// The specification (smash.simulation/1), or - for standard input
    spec: PathBuf,
    /// Where to write the scene (smash.scene/1), or - for standard output
    #[arg(short, long, value_name = "SCENE")]
    output: PathBuf,
    /// Where to write what the scene was made with (smash.truth/1)
    #[arg(long, value_name = "FILE")]
    truth: Option<PathBuf>,
    /// Start of the noise's random numbers, in place of the specification's
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Print the truth as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, simulates, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let output = Output::check(&arguments.output)?;
    let truth_output = arguments.truth.as_deref().map(Output::check).transpose()?;
    let on_standard_output =
        |output: &Option<Output>| output.as_ref().is_some_and(Output::is_standard_output);
    if output.is_standard_output() && on_standard_output(&truth_output) {
        return Err(Error::new(ErrorKind::Write, "two files can't share it")
            .in_file("(standard output)")
            .mend("give the scene or the truth a file"));
    }
    let mut spec = SimulationSpec::read(&arguments.spec)?;
    spec.seed = arguments.seed.unwrap_or(spec.seed);
    let simulation = simulate(&spec)
        .map_err(|error| error.in_file(display_name(&arguments.spec, "standard input")))?;
    super::warn(simulation.scene.warnings());
    output.write(simulation.scene_file.to_json().as_bytes())?;
    let truth = simulation.truth.to_json();
    if let Some(truth_output) = &truth_output {
        truth_output.write(truth.as_bytes())?;
    }
    if output.is_standard_output() || on_standard_output(&truth_output) {
        // It carries the data already.
        return Ok(());
    }
    let told = if arguments.json { truth } else { in_words(arguments, &spec, &simulation) };
    print_bytes(told.as_bytes())
}

/// What was made, for a person.
fn in_words(arguments: &Arguments, spec: &SimulationSpec, simulation: &Simulation) -> String {
    let truth = &simulation.truth;
    let name = if truth.scene.is_empty() { "the collision" } else { &truth.scene };
    let mass_ratio = match truth.mass_ratio {
        Some(ratio) => format!("{ratio:.4}"),
        None => "none: against a static body".to_string(),
    };
    let [x, y, z] = truth.impulse;
    let seen = simulation
        .scene
        .bodies()
        .iter()
        .map(|body| format!("`{}` {} times", body.name, body.observations.len()));
    let noise = match spec.noise {
        NoiseSpec::None => "none".to_string(),
        NoiseSpec::Gaussian(sigma) => format!(
            "Gaussian, {} m and {} rad, seed {}",
            sigma.position, sigma.orientation, spec.seed
        ),
        NoiseSpec::Uniform(fraction) => {
            format!("uniform, {} % of each number, seed {}", 100.0 * fraction, spec.seed)
        }
        // The library may learn others.
        _ => format!("as specified, seed {}", spec.seed),
    };
    let scene = arguments.output.display();
    format!(
        "{name}\n\n\
         \x20 mass ratio m_b/m_a   {mass_ratio}\n\
         \x20 restitution          {:.4}\n\
         \x20 collision time       {:.4} s\n\
         \x20 impulse on a         ({x:.3}, {y:.3}, {z:.3}) N·s per kg of a\n\
         \x20 seen                 {}\n\
         \x20 noise                {noise}\n\n\
         Written: {scene}\n\
         Next:    smash reconstruct {scene}\n",
        truth.restitution,
        truth.collision_time,
        seen.collect::<Vec<_>>().join(", "),
    )
}
