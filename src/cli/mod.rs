//! The commands of `smash`, one file each.

mod again;
mod batch;
mod browser;
mod compare;
mod comparison;
mod cut;
mod demo;
mod diagnose;
mod doctor;
mod effects;
mod export;
mod import;
mod improve;
mod law_files;
mod ledger;
mod method;
mod power;
mod progress;
mod reconstruct;
mod report;
mod schema;
mod side_by_side;
mod simulate;
mod studio;
mod summary;
mod table;
mod throws;
mod typed;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};
use smash::files::Output;
use smash::{Error, ErrorKind};

/// Reconstructs how two rigid bodies collided, from a few annotated poses.
#[derive(Parser)]
#[command(name = "smash", version, arg_required_else_help = true)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Demo(demo::Arguments),
    Reconstruct(reconstruct::Arguments),
    Batch(batch::Arguments),
    Compare(compare::Arguments),
    Diagnose(diagnose::Arguments),
    Improve(improve::Arguments),
    Report(report::Arguments),
    Export(export::Arguments),
    Studio(studio::Arguments),
    Power(power::Arguments),
    Effects(effects::Arguments),
    Import(import::Arguments),
    Cut(cut::Arguments),
    Simulate(simulate::Arguments),
    Schema(schema::Arguments),
    Doctor(doctor::Arguments),
}

/// Runs the command that was typed: exit code 0 done, 1 the input or the run is at fault,
/// 2 wrong usage.
pub fn main() -> ExitCode {
    smash::silence_solver_log();
    let outcome = match Arguments::parse().command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Reconstruct(arguments) => reconstruct::run(&arguments),
        Command::Batch(arguments) => batch::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Diagnose(arguments) => diagnose::run(&arguments),
        Command::Improve(arguments) => improve::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Studio(arguments) => studio::run(&arguments),
        Command::Power(arguments) => power::run(&arguments),
        Command::Effects(arguments) => effects::run(&arguments),
        Command::Import(arguments) => import::run(&arguments),
        Command::Cut(arguments) => cut::run(&arguments),
        Command::Simulate(arguments) => simulate::run(&arguments),
        Command::Schema(arguments) => schema::run(&arguments),
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

/// Ends the program with a usage error of the command that was typed.
fn usage_error(kind: clap::error::ErrorKind, problem: &str) -> ! {
    let mut program = Arguments::command();
    program.build();
    let typed = std::env::args_os().nth(1).unwrap_or_default();
    let command = match program.find_subcommand(&typed) {
        Some(command) => &mut command.clone(),
        None => &mut program,
    };
    command.error(kind, problem).exit()
}

/// Tells of what looks odd, before the work starts.
fn warn(warnings: &[impl std::fmt::Display]) {
    for warning in warnings {
        // A closed standard error leaves nobody to tell.
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
}

/// Standard output can't carry the file and, for `--json`, the words on it.
fn refuse_json_beside(output: &Output, as_json: bool) -> smash::Result<()> {
    if output.is_standard_output() && as_json {
        return Err(Error::new(ErrorKind::Write, "carries the file: `--json` has no place on it")
            .in_file("(standard output)")
            .mend("write to a file, or leave `--json` out"));
    }
    Ok(())
}
