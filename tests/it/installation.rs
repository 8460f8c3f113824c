//! `./setup` and `smash doctor` say what is missing and how to get it, and never act unasked.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const SMASH: &str = env!("CARGO_BIN_EXE_smash");

/// A list with one thing that is there, and one that is on no machine.
const LIST: &str = "build command:bash bash runs this\n\
                    build command:no-such-compiler no-such-package turns source into programs\n\
                    style command:no-such-formatter no-such-formatter isn't needed to build\n";

/// A machine of `./setup`'s own: the few tools it calls, and stand-ins for the rest.
struct Machine {
    folder: tempfile::TempDir,
}

impl Machine {
    /// With a recent cargo, and an apt-get that only notes what it was asked.
    fn new(dependencies: &str) -> Machine {
        let machine = Machine { folder: tempfile::tempdir().unwrap() };
        let at = |name: &str| machine.folder.path().join(name);
        fs::create_dir(at("scripts")).unwrap();
        fs::create_dir(at("bin")).unwrap();
        for name in ["setup", "Cargo.toml", "scripts/dependencies.sh"] {
            fs::copy(Path::new(ROOT).join(name), at(name)).unwrap();
        }
        fs::write(at("scripts/dependencies.txt"), dependencies).unwrap();
        for tool in ["bash", "cut", "dirname", "env", "head", "sed", "sort"] {
            symlink(Path::new("/usr/bin").join(tool), at("bin").join(tool)).unwrap();
        }
        machine.program("cargo", "echo cargo 99.0.0");
        machine.program("sudo", "exec \"$@\"");
        machine.program("apt-get", "echo \"$*\" >>apt.log");
        machine
    }

    fn program(&self, name: &str, script: &str) {
        let path = self.folder.path().join("bin").join(name);
        fs::write(&path, format!("#!/bin/bash\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    fn remove(&self, name: &str) {
        fs::remove_file(self.folder.path().join("bin").join(name)).unwrap();
    }

    /// Runs `./setup` without a terminal.
    fn setup(&self, arguments: &[&str]) -> Output {
        Command::new(self.folder.path().join("setup"))
            .args(arguments)
            .env("PATH", self.folder.path().join("bin"))
            .env("CARGO_HOME", self.folder.path())
            .env_remove("SMASH_CERES_INCLUDE")
            .stdin(Stdio::null())
            .output()
            .unwrap()
    }

    /// What apt-get was asked to change.
    fn changes(&self) -> String {
        let log = fs::read_to_string(self.folder.path().join("apt.log")).unwrap_or_default();
        let changes = log.lines().filter(|line| !line.contains("--simulate"));
        changes.collect::<Vec<_>>().join("\n")
    }
}

/// Asserts that `output` failed with one message that holds each of `parts`.
fn assert_stopped(output: &Output, parts: &[&str]) {
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{errors}");
    assert_eq!(errors.matches("error: ").count(), 1, "{errors}");
    for part in parts {
        assert!(errors.contains(part), "`{part}` isn't in: {errors}");
    }
}

#[test]
fn without_a_terminal_to_ask_at_nothing_is_installed() {
    let machine = Machine::new(LIST);
    let output = machine.setup(&[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("missing  no-such-package: turns source into programs"), "{said}");
    assert_stopped(&output, &["no terminal", "--yes"]);
    assert_eq!(machine.changes(), "");
}

#[test]
fn with_yes_only_what_is_missing_is_installed() {
    let machine = Machine::new(LIST);
    let output = machine.setup(&["--yes"]);
    assert_eq!(machine.changes(), "install --yes --no-install-recommends no-such-package");
    // This apt-get installs nothing, and setup looks again.
    assert_stopped(&output, &["still missing", "no-such-package"]);
}

#[test]
fn a_dry_run_tells_and_changes_nothing() {
    let machine = Machine::new(LIST);
    let output = machine.setup(&["--dry-run", "--yes"]);
    assert_stopped(&output, &["apt-get install no-such-package\n"]);
    assert_eq!(machine.changes(), "");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("found    bash") && !said.contains("no-such-formatter"), "{said}");
}

#[test]
fn lists_of_packages_that_are_absent_are_fetched_first() {
    let machine = Machine::new(LIST);
    // It knows no package before its lists are updated.
    machine.program(
        "apt-get",
        "echo \"$*\" >>apt.log; [[ $1 != update ]] || >updated; [[ -e updated ]]",
    );
    machine.setup(&["--yes"]);
    let install = "install --yes --no-install-recommends no-such-package";
    assert_eq!(machine.changes(), format!("update\n{install}"));
}

#[test]
fn a_system_without_apt_is_told_the_packages() {
    let machine = Machine::new(LIST);
    machine.remove("apt-get");
    assert_stopped(&machine.setup(&["--yes"]), &["no apt-get", "no-such-package"]);
}

#[test]
fn without_cargo_setup_says_how_to_get_rust() {
    let machine = Machine::new(LIST);
    machine.remove("cargo");
    assert_stopped(&machine.setup(&["--yes"]), &["https://rustup.rs"]);
}

#[test]
fn a_cargo_that_is_too_old_is_told_by_its_version() {
    let machine = Machine::new(LIST);
    machine.program("cargo", "echo cargo 1.63.0");
    assert_stopped(&machine.setup(&["--yes"]), &["1.63.0", env!("CARGO_PKG_RUST_VERSION")]);
}

#[test]
fn an_unknown_option_is_wrong_usage() {
    let output = Machine::new(LIST).setup(&["--force"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn the_doctor_and_setup_look_for_the_same_things() {
    let doctor = Command::new(SMASH).args(["doctor", "--json"]).output().unwrap();
    let health: serde_json::Value = serde_json::from_slice(&doctor.stdout).unwrap();
    let setup = Command::new(Path::new(ROOT).join("setup")).arg("--dry-run").output().unwrap();
    let said = String::from_utf8_lossy(&setup.stdout);
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
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("missing  g++: compiles"), "{said}");
    let last = said.lines().last().unwrap();
    assert!(last.contains("sudo apt-get install g++"), "{last}");
}

/// JSON is UTF-8, paths needn't be.
#[test]
fn the_doctor_survives_a_path_that_is_no_text() {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    let odd = folder.path().join(std::ffi::OsStr::from_bytes(b"bin-\xff"));
    fs::create_dir(&odd).unwrap();
    for name in ["cmake", "g++", "cargo", "clang-format", "pkg-config"] {
        fs::write(odd.join(name), "").unwrap();
    }
    let output = Command::new(SMASH).args(["doctor", "--json"]).env("PATH", &odd).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let health: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(health["dependencies"].to_string().contains("bin-\u{fffd}"), "{health}");
}
