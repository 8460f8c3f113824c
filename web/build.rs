//! Builds the page from `src/` by npm and esbuild. Without Node all else can be built: then there is no
//! page, and commands that need it say so.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const SOURCES: [&str; 5] = ["build.mjs", "package.json", "package-lock.json", "page.html", "src"];

fn main() {
    for source in SOURCES {
        println!("cargo:rerun-if-changed={source}");
    }
    println!("cargo:rerun-if-env-changed=DOCS_RS");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo names a folder"));
    let page = out.join("page.html");
    let embedded = match built(&page) {
        Ok(()) => format!("Some(include_str!({page:?}))"),
        Err(why) => {
            println!("cargo:warning=smash is built without its page (report, studio, demo): {why}");
            // What isn't there counts as changed: the next build tries again.
            println!("cargo:rerun-if-changed={}", out.join("no page").display());
            "None".to_string()
        }
    };
    fs::write(out.join("page.rs"), embedded).expect("cargo's folder can be written to");
}

/// Builds the page into a file.
fn built(page: &Path) -> Result<(), String> {
    if env::var_os("DOCS_RS").is_some() {
        return Err("documentation needs none".to_string());
    }
    if !has_packages() {
        // None of the packages has to run anything when it is installed.
        run(Command::new("npm").args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]))?;
    }
    run(Command::new("node").args(["build.mjs", "--out"]).arg(page))
}

/// Whether npm has installed what the lock file says.
fn has_packages() -> bool {
    let changed = |path: &str| fs::metadata(path).and_then(|file| file.modified());
    match (changed("node_modules/.package-lock.json"), changed("package-lock.json")) {
        (Ok(installed), Ok(locked)) => installed >= locked,
        _ => false,
    }
}

fn run(command: &mut Command) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| {
        format!("{program} can't be run ({error}); on Debian: sudo apt-get install nodejs npm")
    })?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let last: Vec<&str> = said.lines().rev().take(6).collect();
    let last: Vec<&str> = last.into_iter().rev().collect();
    Err(format!("{program} failed: {}", last.join(" / ")))
}
