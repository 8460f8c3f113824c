//! `smash simulate`: the dynamics run forwards.

use std::path::PathBuf;

use clap::Args;
use smash::Result;
use smash::files::{Output, check_distinct, display_name, print_bytes, shell_word, write_together};
use smash::simulate::{EffectSpec, NoiseSpec, Simulation, SimulationSpec, simulate};

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
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true, value_parser = parse_seed)]
    seed: Option<u64>,
    /// Print the truth as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reads, simulates, writes, tells.
pub fn run(arguments: &Arguments) -> Result<()> {
    let check = |path| Output::check(path, &[&arguments.spec]);
    let output = check(&arguments.output)?;
    let truth_output = arguments.truth.as_deref().map(check).transpose()?;
    if let Some(truth_output) = &truth_output {
        check_distinct(&output, truth_output)?;
    }
    super::refuse_json_beside(&output, arguments.json)?;
    let mut spec = SimulationSpec::read(&arguments.spec)?;
    spec.seed = arguments.seed.unwrap_or(spec.seed);
    let simulation = simulate(&spec)
        .map_err(|error| error.in_file(display_name(&arguments.spec, "standard input")))?;
    super::warn(simulation.scene.warnings());
    let (scene, truth) = (simulation.scene_file.to_json(), simulation.truth.to_json());
    let mut parts = vec![(&output, scene.as_bytes())];
    parts.extend(truth_output.as_ref().map(|output| (output, truth.as_bytes())));
    write_together(&parts)?;
    if parts.iter().any(|(output, _)| output.is_standard_output()) {
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
    let first = truth.bodies.first().map_or("a", |body| body.name.as_str());
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
    let acts = |effect: &EffectSpec| match &effect.body {
        Some(body) => format!("{}@{body}", effect.name),
        None => effect.name.clone(),
    };
    let effects = match truth.effects.iter().map(acts).collect::<Vec<_>>().join(", ") {
        none if none.is_empty() => String::new(),
        some => format!("  effects              {some}\n"),
    };
    let scene = arguments.output.display();
    let word = shell_word(&arguments.output.to_string_lossy());
    format!(
        "{name}\n\n\
         \x20 mass ratio m_b/m_a   {mass_ratio}\n\
         \x20 restitution          {:.4}\n\
         \x20 collision time       {:.4} s\n\
         \x20 {:19}  ({x:.3}, {y:.3}, {z:.3}) N·s per kg of {first}\n\
         \x20 seen                 {}\n\
         {}\
         \x20 noise                {noise}\n\n\
         Written: {scene}\n\
         Next:    smash reconstruct {word}\n",
        truth.restitution,
        truth.collision_time,
        format!("impulse on {first}"),
        seen.collect::<Vec<_>>().join(", "),
        effects,
    )
}

fn parse_seed(text: &str) -> std::result::Result<u64, String> {
    text.parse().map_err(|_| format!("write a whole number from 0 to {}", u64::MAX))
}
