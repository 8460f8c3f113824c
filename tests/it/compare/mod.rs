//! `smash compare` and its library: residuals from the numbers in a result, and results side by
//! side.

mod command;
mod differences;
mod files;
mod residuals;
mod truth;

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use smash::compare::Quantity;
use smash::{Comparison, Options, Reconstruction, Scene, compare, reconstruct};
use tempfile::TempDir;

const SCENES: [&str; 4] = ["boxes", "uneven_times", "ball_on_floor", "box_on_floor"];

fn scene_path(name: &str) -> String {
    format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

fn scene(name: &str) -> Scene {
    Scene::read(scene_path(name)).unwrap()
}

fn paper(scene: &Scene) -> Reconstruction {
    reconstruct(scene, &Options::paper()).unwrap()
}

fn refined(scene: &Scene) -> Reconstruction {
    reconstruct(scene, &Options::default()).unwrap()
}

/// The comparison of these results, named by their order.
fn compared(scene: &Scene, results: &[&Reconstruction]) -> Comparison {
    let names = ["first", "second", "third"];
    let named: Vec<_> =
        names.iter().zip(results).map(|(name, &one)| (name.to_string(), one.clone())).collect();
    compare(scene, &named).unwrap()
}

fn quantity<'a>(comparison: &'a Comparison, name: &str) -> &'a Quantity {
    comparison.quantities.iter().find(|one| one.quantity == name).unwrap()
}

fn assert_near(found: f64, expected: f64, share: f64, what: &str) {
    assert!((found - expected).abs() <= share * expected, "{what}: {found}, not {expected}");
}

/// A folder with the scene and the results of both presets.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("boxes");
    fs::copy(scene_path("boxes"), folder.path().join("scene.json")).unwrap();
    fs::write(folder.path().join("paper.json"), paper(&scene).to_json()).unwrap();
    fs::write(folder.path().join("refined.json"), refined(&scene).to_json()).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .arg("compare")
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn success(output: Output) -> String {
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}
