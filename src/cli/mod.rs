//! The commands of `smash`, one file each.

mod doctor;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Reconstructs how two rigid bodies collided, from a few annotated poses.
#[derive(Parser)]
#[command(name = "smash", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Doctor(doctor::Arguments),
}

/// Runs the command that was typed: exit code 0 done, 1 the input or the run is at fault,
/// 2 wrong usage.
pub fn main() -> ExitCode {
    let outcome: smash::Result<()> = match Arguments::parse().command {
        Command::Doctor(arguments) => doctor::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // A closed standard error leaves nobody to tell.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}
