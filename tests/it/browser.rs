//! The page in a real browser: `web/tests/`, run by Node, with the program that was just built.

use std::env;
use std::path::Path;
use std::process::Command;

const WEB: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/web");

/// Runs a program in `web/`, and wants it to succeed.
fn run(program: &str, arguments: &[&str]) {
    let mut command = Command::new(program);
    command.args(arguments).current_dir(WEB).env("SMASH", env!("CARGO_BIN_EXE_smash"));
    let output = command.output().unwrap_or_else(|error| {
        panic!("{program} can't be run ({error}): ./check installs what the tests need")
    });
    let told =
        [output.stdout, output.stderr].map(|said| String::from_utf8_lossy(&said).into_owned());
    assert!(output.status.success(), "{program} {arguments:?} failed\n{}", told.concat());
}

#[test]
fn the_page_does_in_a_browser_what_it_should() {
    let chromium = env::var("CHROMIUM").unwrap_or_else(|_| "/usr/bin/chromium".to_string());
    assert!(
        Path::new(&chromium).exists(),
        "{chromium} is missing: ./check installs it, or the variable CHROMIUM names another one"
    );
    if !Path::new(WEB).join("node_modules/playwright-core").exists() {
        run("npm", &["ci", "--ignore-scripts"]);
    }
    run("npm", &["run", "check"]);
    run("npm", &["test"]);
}
