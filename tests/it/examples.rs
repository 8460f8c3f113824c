//! The examples run, and print what their first lines promise.

use std::path::Path;
use std::process::Command;

/// By `cargo run`, as a reader would: `cargo test --test it` doesn't build the examples, and an
/// old build of one would prove nothing. Cargo locks its folder only while it builds, so this
/// doesn't wait for the `cargo test` around it, and finds built what that built in this profile.
fn run(name: &str, arguments: &[&str]) -> String {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    let profile = if cfg!(debug_assertions) { "dev" } else { "release" };
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--locked", "--profile", profile, "--example", name])
        .arg("--target-dir")
        .arg(target)
        .arg("--")
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_first_example_reads_off_the_mass_ratio() {
    let text = run("first", &["scenes/boxes.json"]);
    let weighs = text.strip_prefix("b weighs ").unwrap().split(' ').next().unwrap();
    // The scene was made with 1.8; its noise of 2 mm and 0.01 rad moves that by a per cent or so.
    assert!((weighs.parse::<f64>().unwrap() - 1.8).abs() < 0.05, "{text}");
}

#[test]
fn recover_prints_one_row_a_noise_with_the_truth() {
    let text = run("recover", &[]);
    assert_eq!(text.lines().filter(|line| line.contains(" mm ")).count(), 3, "{text}");
}

#[test]
fn the_evaluation_prints_a_row_for_each_noise_and_method_and_draws() {
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("figure.svg");
    let arguments = ["--scenes", "1", "--intervals", "19", "--svg", figure.to_str().unwrap()];
    let text = run("evaluate", &arguments);
    assert_eq!(text.lines().count(), 2 + 4 * 3, "{text}");
    assert!(std::fs::read_to_string(figure).unwrap().ends_with("</svg>\n"));
}

/// With 20 scenes at 95 %, fewer than 14 covered is one in a hundred thousand.
#[test]
fn the_evaluation_tests_the_error_bars() {
    let text = run("evaluate", &["--coverage", "20", "--intervals", "9"]);
    let covered: Vec<f64> = text
        .lines()
        .filter_map(|line| line.strip_suffix(" % |")?.rsplit("| ").next()?.parse().ok())
        .collect();
    assert_eq!(covered.len(), 6, "{text}");
    assert!(covered.iter().all(|percent| *percent >= 70.0), "{text}");
}

/// A row for the kind asked for, in which the right effect explains what the base model doesn't.
#[test]
fn hidden_effects_are_drawn_strong_enough_and_found() {
    let nothing_else = ["--clean", "0", "--pairs", "0", "--outside", "0", "--timed", "0"];
    let singles = ["--scenes", "3", "--only", "linear_drag"];
    let text = run("evaluate_hidden", &[&singles[..], &nothing_else[..]].concat());
    // Drawn for a gain in χ² of 60 and more: none is overlooked.
    assert!(text.contains("| linear_drag | 3 | 100.0 % |"), "{text}");
}
