//! `smash cut`: a scene without the poses of a time.

use std::path::PathBuf;

use smash::files::{Output, print_bytes, shell_word};
use smash::{Error, ErrorKind, Scene};

/// Writes a scene without the poses of a time, such as those of a contact that lasts
///
/// The times of both ends are left out, too. All else stays as it is.
#[derive(clap::Args)]
pub struct Arguments {
    /// The scene; `-` is standard input
    scene: PathBuf,
    /// The first time that is left out, in s
    #[arg(long, value_name = "TIME", allow_negative_numbers = true)]
    from: f64,
    /// The last time that is left out, in s
    #[arg(long, value_name = "TIME", allow_negative_numbers = true)]
    to: f64,
    /// The scene to write; `-` is standard output
    #[arg(short, long, value_name = "SCENE")]
    output: PathBuf,
    /// Print a summary as JSON
    #[arg(long)]
    json: bool,
}

/// Writes the scene, and says what was left out.
pub fn run(arguments: &Arguments) -> smash::Result<()> {
    let output = Output::check(&arguments.output, &[arguments.scene.as_path()])?;
    super::refuse_json_beside(&output, arguments.json)?;
    let scene = Scene::read(&arguments.scene)?;
    super::warn(scene.warnings());
    let (mut file, mut left_out) = (scene.to_file(), 0);
    for poses in file.bodies.iter_mut().filter_map(|body| body.observations.as_mut()) {
        let count = poses.len();
        let is_meant = |time_s: f64| (arguments.from..=arguments.to).contains(&time_s);
        poses.retain(|pose| !pose.time.is_some_and(is_meant));
        left_out += count - poses.len();
    }
    let place = format!("--from {} --to {}", arguments.from, arguments.to);
    let at_fault = |problem: &str| Error::new(ErrorKind::Invalid, problem).in_file(&place);
    if left_out == 0 {
        let poses = || scene.bodies().iter().flat_map(|body| &body.observations);
        let first_s = poses().map(|pose| pose.time_s).fold(f64::INFINITY, f64::min);
        let last_s = poses().map(|pose| pose.time_s).fold(f64::NEG_INFINITY, f64::max);
        return Err(at_fault("there is no pose of the scene in that time")
            .mend(format!("its poses are from {first_s} to {last_s} s")));
    }
    let text = file.to_json();
    // What is left must be a scene still.
    Scene::parse(&text, "the rest of the scene")?;
    output.write(text.as_bytes())?;
    if output.is_standard_output() {
        return Ok(());
    }
    let left: usize = file.bodies.iter().flat_map(|body| &body.observations).map(Vec::len).sum();
    let path = output.path().display().to_string();
    let text = match arguments.json {
        true => {
            let summary = serde_json::json!({ "poses_left_out": left_out, "poses_left": left });
            format!("{summary}\n")
        }
        false => format!(
            "{path}: without {left_out} of {} poses.\n\nNext\n  smash diagnose {}\n",
            left_out + left,
            shell_word(&path)
        ),
    };
    print_bytes(text.as_bytes())
}
