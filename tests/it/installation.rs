//! `./setup` and `smash doctor` say what is missing and how to get it, and never act unasked.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const SMASH: &str = env!("CARGO_BIN_EXE_smash");

/// Runs `./setup` in a copy of what it reads, with `dependencies` in place of the true list, no
/// terminal, and `path` as PATH.
fn setup(arguments: &[&str], dependencies: &str, path: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("scripts")).unwrap();
    for name in ["setup", "Cargo.toml", "scripts/dependencies.sh"] {
        fs::copy(Path::new(ROOT).join(name), folder.path().join(name)).unwrap();
    }
    fs::write(folder.path().join("scripts/dependencies.txt"), dependencies).unwrap();
    Command::new(folder.path().join("setup"))
        .args(arguments)
        .env("PATH", path)
        .env("CARGO_HOME", folder.path())
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A PATH with cargo and the system's tools.
fn whole_path() -> String {
    std::env::var("PATH").unwrap()
}

#[test]
fn without_a_terminal_setup_stops_before_it_uses_root() {
    let list = "build command:no-such-compiler no-such-package turns source into programs\n";
    let output = setup(&[], list, &whole_path());
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stdout);
    assert!(said.contains("missing  no-such-package: turns source into programs"), "{said}");
    // Which of the two stands there depends on the machine: no root, no apt-get, or no terminal.
    let errors = text(&output.stderr);
    assert!(errors.starts_with("error: ") && errors.matches("error:").count() == 1, "{errors}");
}

#[test]
fn a_dry_run_only_tells() {
    let list = "build command:no-such-compiler no-such-package turns source into programs\n\
                build command:bash bash runs this\n\
                style command:no-such-formatter no-such-formatter isn't needed to build\n";
    let output = setup(&["--dry-run"], list, &whole_path());
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stdout);
    assert!(said.contains("found    bash"), "{said}");
    assert!(!said.contains("no-such-formatter"), "{said}");
    let errors = text(&output.stderr);
    assert!(errors.contains("apt-get install no-such-package"), "{errors}");
}

#[test]
fn without_cargo_setup_says_how_to_get_rust() {
    let output = setup(&["--yes"], "", "/usr/bin:/bin");
    // A machine with cargo in /usr/bin has nothing to be told.
    if Path::new("/usr/bin/cargo").exists() {
        return;
    }
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("https://rustup.rs"), "{}", text(&output.stderr));
}

#[test]
fn an_unknown_option_is_wrong_usage() {
    let output = setup(&["--force"], "", &whole_path());
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("--help"));
}

#[test]
fn the_doctor_and_setup_look_for_the_same_things() {
    let output = Command::new(SMASH).args(["doctor", "--json"]).output().unwrap();
    let health: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = fs::read_to_string(Path::new(ROOT).join("scripts/dependencies.txt")).unwrap();
    let said = setup(&["--dry-run"], &list, &whole_path());
    let said = text(&said.stdout);
    let dependencies = health["dependencies"].as_array().unwrap();
    let to_build: Vec<_> = dependencies.iter().filter(|d| d["work"] == "build").collect();
    assert!(!to_build.is_empty());
    for dependency in to_build {
        let word = if dependency["place"].is_null() { "missing " } else { "found   " };
        let line = format!("{word} {}", dependency["package"].as_str().unwrap());
        assert!(said.contains(&line), "`{line}` isn't in:\n{said}");
    }
}

#[test]
fn the_doctor_names_the_command_that_gets_what_is_missing() {
    let output = Command::new(SMASH).arg("doctor").env("PATH", "/nowhere").output().unwrap();
    let said = text(&output.stdout);
    assert!(said.contains("missing  g++: compiles"), "{said}");
    let last = said.lines().last().unwrap();
    assert!(last.contains("sudo apt-get install g++"), "{last}");
}
