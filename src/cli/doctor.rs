//! `smash doctor`: what is installed, what is missing, and how to get it.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Serialize;
use smash::files::print_bytes;
use smash::{Options, Scene};

/// The list that `./setup` reads too.
const DEPENDENCIES: &str = include_str!("../../scripts/dependencies.txt");

/// What the solver is tried on.
const SCENE: &str = include_str!("../../scenes/ball_on_floor.json");

const INCLUDE_FOLDERS: [&str; 2] = ["/usr/include", "/usr/local/include"];

/// Says what is installed, what is missing, and how to get it
#[derive(clap::Args)]
pub struct Arguments {
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Health {
    /// Of smash.
    version: &'static str,
    /// The version of Ceres that smash was built with.
    ceres: String,
    /// Whether a scene that is built in could be reconstructed.
    solver_works: bool,
    /// Whether `smash report` has its page.
    has_page: bool,
    dependencies: Vec<Dependency>,
    /// The command that installs what is missing.
    install: Option<String>,
}

#[derive(Serialize)]
struct Dependency {
    package: &'static str,
    /// What it is for: to build smash, to test it, or to check the style of its source.
    work: &'static str,
    purpose: String,
    /// Where it was found, in readable letters; `None` when it is missing.
    place: Option<String>,
    /// What a program says of itself.
    version: Option<String>,
}

/// Prints the health of the installation.
///
/// # Errors
/// The solver can't reconstruct a scene that it must.
pub fn run(arguments: &Arguments) -> smash::Result<()> {
    let trial = try_solver();
    let health = Health::examine(trial.is_ok());
    let mut text = if arguments.json {
        serde_json::to_string_pretty(&health).expect("plain strings always serialise")
    } else {
        health.in_words()
    };
    text.push('\n');
    print_bytes(text.as_bytes())?;
    trial
}

/// What is missing hinders a build; only a solver that fails hinders a run.
fn try_solver() -> smash::Result<()> {
    let scene = Scene::parse(SCENE, "scenes/ball_on_floor.json")?;
    smash::reconstruct(&scene, &Options::default())
        .map_err(|error| error.mend("build again with the Ceres that is installed: ./setup"))?;
    Ok(())
}

impl Health {
    fn examine(solver_works: bool) -> Health {
        let lines = DEPENDENCIES.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        let dependencies: Vec<Dependency> = lines.map(Dependency::look_for).collect();
        let missing: Vec<_> =
            dependencies.iter().filter(|d| d.place.is_none()).map(|d| d.package).collect();
        let install =
            (!missing.is_empty()).then(|| format!("sudo apt-get install {}", missing.join(" ")));
        Health {
            version: env!("CARGO_PKG_VERSION"),
            ceres: smash::ceres_version(),
            solver_works,
            has_page: smash::report::has_page(),
            dependencies,
            install,
        }
    }

    fn in_words(&self) -> String {
        let mut lines = vec![format!("smash {}, built with Ceres {}", self.version, self.ceres)];
        lines.push(match self.solver_works {
            true => "The solver works.".into(),
            false => "The solver doesn't work.".into(),
        });
        lines.push(match self.has_page {
            true => "The page of reports is built in.".into(),
            false => {
                "It was built without the page of reports: install Node, and build again.".into()
            }
        });
        for (work, title) in
            [("build", "To build it:"), ("test", "To test it:"), ("style", "To check its style:")]
        {
            lines.push(format!("\n{title}"));
            lines.extend(self.dependencies.iter().filter(|d| d.work == work).map(|d| d.in_words()));
        }
        lines.push(match &self.install {
            Some(command) => format!("\nTo get what is missing (Debian): {command}"),
            None => "\nNothing is missing.".into(),
        });
        lines.join("\n")
    }
}

impl Dependency {
    /// Reads one line of the list, and looks on this machine.
    fn look_for(line: &'static str) -> Dependency {
        let mut words = line.split_whitespace();
        let mut next = || words.next().unwrap_or_default();
        let (work, probe, package) = (next(), next(), next());
        let purpose = words.collect::<Vec<_>>().join(" ");
        let (kind, name) = probe.split_once(':').unwrap_or_default();
        let folders = match kind {
            "command" => folders_of_path(),
            "header" => include_folders(),
            _ => vec!["/".into()],
        };
        let place = folders.iter().map(|folder| folder.join(name)).find(|path| path.exists());
        let version = if kind == "command" { place.as_deref().and_then(version_of) } else { None };
        let place = place.map(|path| path.display().to_string());
        Dependency { package, work, purpose, place, version }
    }

    fn in_words(&self) -> String {
        match (&self.place, &self.version) {
            (None, _) => format!("  missing  {}: {}", self.package, self.purpose),
            (Some(place), None) => format!("  found    {}: {place}", self.package),
            (Some(place), Some(version)) => {
                format!("  found    {}: {place} ({version})", self.package)
            }
        }
    }
}

fn folders_of_path() -> Vec<PathBuf> {
    std::env::var_os("PATH").map(|path| std::env::split_paths(&path).collect()).unwrap_or_default()
}

fn include_folders() -> Vec<PathBuf> {
    let named = std::env::var_os("SMASH_CERES_INCLUDE").map(PathBuf::from);
    named.into_iter().chain(INCLUDE_FOLDERS.map(PathBuf::from)).collect()
}

/// The first line of what the program says to `--version`.
fn version_of(program: &Path) -> Option<String> {
    let output = Command::new(program).arg("--version").output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout);
    text.lines().next().map(str::to_owned)
}
