//! Reconstructions with effects beyond the base model: what adding one may and may not change, what
//! is said of its parameters, and what can't be asked for.

mod catalogue;
mod command;
mod comparison;
mod hostile;
mod parameters;

use std::path::PathBuf;

use serde_json::{Value, json};
use smash::effect::{Effect, EffectRequest};
use smash::reconstruct::RefinedOptions;
use smash::scene::Noise;
use smash::simulate::{NoiseSpec, RegularSampling, Sampling, SimulationSpec, simulate};
use smash::{Options, Reconstruction, Result, Scene, reconstruct};

fn scene_value(name: &str) -> Value {
    let path = format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// A scene of `scenes/`, seen by a camera, so that it can show all that its bodies can.
fn scene(name: &str) -> Scene {
    let mut value = scene_value(name);
    value["camera"] = json!({"position": [0.5, 1.0, 4.0]});
    Scene::parse(&value.to_string(), name).unwrap()
}

/// Two boxes in flight, annotated with a noise of 2 mm and 0.01 rad in every tenth frame.
fn noisy(seed: u64) -> Scene {
    let mut spec = SimulationSpec::random_cuboids(seed);
    spec.noise = NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 });
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 10, frame_count: 90, gap: None });
    let mut file = simulate(&spec).unwrap().scene_file;
    file.camera = serde_json::from_value(json!({"position": [0.5, 1.0, 6.0]})).unwrap();
    Scene::from_file(file).unwrap()
}

/// The body that an effect is put on.
fn first_body(scene: &Scene) -> &str {
    &scene.bodies()[0].name
}

fn example(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/effects").join(name)
}

fn fit(scene: &Scene, effects: &[EffectRequest]) -> Result<Reconstruction> {
    let options = RefinedOptions { effects: effects.to_vec(), ..RefinedOptions::default() };
    reconstruct(scene, &Options::Refined(options))
}

/// The reconstruction with effects as `--with` takes them.
fn with(scene: &Scene, effects: &[&str]) -> Result<Reconstruction> {
    let requests: Vec<EffectRequest> =
        effects.iter().map(|text| EffectRequest::parse(text).unwrap()).collect();
    fit(scene, &requests)
}

/// An effect of a user's, on the body of that name.
fn own(text: &str, body: &str) -> EffectRequest {
    let effect = Effect::parse(text, "own.toml").unwrap();
    EffectRequest { effect, body: Some(body.to_string()), fixed: Default::default() }
}

fn chi2(result: &Reconstruction) -> f64 {
    result.fit.chi2.unwrap()
}
