//! The whole story, from a scene in which an effect is hidden to a model that holds it: the comparison
//! fails, the diagnosis names it, the improvement adds it, and the collision's numbers are right.

mod clean;
mod command;
mod exact;
mod hidden;
mod misread;
mod noise;
mod objects;
mod pairs;
mod piped;
mod shared_errors;
mod soft_contact;
mod strange;
mod strong;
mod stuck;
mod swing;
mod throws;
mod unknown;

use std::collections::BTreeMap;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use smash::effect::EffectRequest;
use smash::improve::{Improvement, Rung};
use smash::reconstruct::{Number, ParameterEstimate, RefinedOptions};
use smash::scene::{Camera, Noise};
use smash::simulate::{
    EffectSpec, NoiseSpec, RegularSampling, Sampling, Simulation, SimulationSpec, simulate,
};
use smash::{Comparison, Options, Reconstruction, Scene, SchemaKind};

type Parameters = BTreeMap<String, ParameterEstimate>;

/// As a careful annotator's.
const NOISE: Noise = Noise { position: 0.001, orientation: 0.005 };

fn effect(name: &str, body: Option<&str>, parameters: &[(&str, &[f64])]) -> EffectSpec {
    let parameters =
        parameters.iter().map(|(name, value)| (name.to_string(), Number::from(value.to_vec())));
    EffectSpec { name: name.into(), body: body.map(String::from), parameters: parameters.collect() }
}

/// Every third frame, with a gap of twice that around the collision, and a stated noise.
fn annotated(mut spec: SimulationSpec, seed: u64) -> SimulationSpec {
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 3, frame_count: 90, gap: Some(3) });
    spec.camera = Some(Camera { position: [0.5, 1.0, 5.0], more: serde_json::Map::new() });
    spec.noise = NoiseSpec::Gaussian(NOISE);
    spec.seed = seed;
    spec
}

/// Two boxes in mid-air.
fn boxes(seed: u64) -> SimulationSpec {
    annotated(SimulationSpec::random_cuboids(seed), seed)
}

/// A box on a floor.
fn box_on_floor(seed: u64) -> SimulationSpec {
    annotated(SimulationSpec::random_box_drop(seed), seed)
}

/// Two balls whose orientations aren't seen.
fn plain_balls(seed: u64) -> SimulationSpec {
    annotated(SimulationSpec::random_balls(seed), seed)
}

fn with(mut spec: SimulationSpec, effects: &[EffectSpec]) -> Simulation {
    spec.effects = effects.to_vec();
    simulate(&spec).unwrap()
}

/// The same place of the shape of a, with its centre of mass moved in it.
fn loaded(mut spec: SimulationSpec, offset_in_body: Vector3<f64>) -> SimulationSpec {
    let [w, x, y, z] = spec.bodies[0].orientation.unwrap();
    let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let centre = Vector3::from(spec.bodies[0].position.unwrap());
    spec.bodies[0].position = Some((centre + q.transform_vector(&offset_in_body)).into());
    spec
}

/// The stamp of pose number `index` of a body.
fn stamp_s(spec: &SimulationSpec, body: usize, index: usize) -> f64 {
    simulate(spec).unwrap().scene.bodies()[body].observations[index].time_s
}

/// The scene without its noise stated.
fn unstated(simulation: &Simulation) -> Scene {
    let mut file = simulation.scene_file.clone();
    file.noise = None;
    Scene::from_file(file).unwrap()
}

fn requests(texts: &[String]) -> Vec<EffectRequest> {
    texts.iter().map(|text| EffectRequest::parse(text).unwrap()).collect()
}

fn fit(scene: &Scene, effects: &[String]) -> Reconstruction {
    let options = RefinedOptions { effects: requests(effects), ..RefinedOptions::default() };
    smash::reconstruct(scene, &Options::Refined(options)).unwrap()
}

/// Whether any channel fails in `smash compare`.
fn is_structured(scene: &Scene, result: &Reconstruction) -> bool {
    let comparison: Comparison =
        smash::compare(scene, &[("result.json".to_string(), result.clone())]).unwrap();
    comparison.results[0].structure.iter().any(|channel| channel.fails)
}

/// χ²/dof of a right model is within so many of its deviations √(2/dof) of 1: in all of `scenes`
/// with 95 %.
fn is_in_band(result: &Reconstruction, scenes: f64) -> bool {
    use statrs::distribution::{ContinuousCDF, Normal};
    let widest = Normal::standard().inverse_cdf(1.0 - 0.025 / scenes);
    let reduced = result.fit.reduced_chi2.unwrap();
    (reduced - 1.0).abs() < widest * (2.0 / result.fit.dof as f64).sqrt()
}

/// The errors are the noise to 5 %, but for what the parameters take of it, and three deviations of a
/// root mean square of so many numbers, 1/√(2N).
fn assert_down_to_the_noise(scene: &Scene, improvement: &Improvement, what: &str) {
    let fit = &improvement.result.fit;
    let poses = || scene.bodies().iter().flat_map(|body| &body.observations);
    let positions = 3.0 * poses().count() as f64;
    let turns = 3.0 * poses().filter(|pose| pose.world_from_body.is_some()).count() as f64;
    let left = (fit.dof as f64 / (positions + turns)).sqrt();
    let near = |rmse: f64, noise: f64, numbers: f64| {
        let off = rmse / noise - left;
        let most = 0.05 + 3.0 / (2.0 * numbers).sqrt();
        assert!(off.abs() < most, "{what}: {rmse} against a noise of {noise}: {off} off {left}");
    };
    near(fit.position_rmse, NOISE.position, positions);
    if let Some(rmse) = fit.orientation_rmse {
        near(rmse, NOISE.orientation, turns);
    }
}

/// Mass ratio and restitution are the truth's, to four of the deviations that are stated with them.
fn assert_right(simulation: &Simulation, result: &Reconstruction, what: &str) {
    let near = |name: &str, estimate: &smash::reconstruct::Estimate, truth: f64| {
        let (value, std) = (estimate.value.unwrap(), estimate.std.unwrap());
        let off = (value - truth) / std;
        assert!(off.abs() < 4.0, "{what}: {name} {value} ± {std} isn't {truth}");
    };
    near("restitution", &result.restitution, simulation.truth.restitution);
    if let (Some(estimate), Some(truth)) = (&result.mass_ratio, simulation.truth.mass_ratio) {
        near("mass ratio", estimate, truth);
    }
}

/// Each rung is what a reconstruction with its `--with` gives. Another way to the same optimum ends
/// within the solver's tolerance of it.
fn assert_replayed(scene: &Scene, improvement: &Improvement, what: &str) {
    let value = |estimate: Option<f64>| estimate.unwrap_or(0.0);
    for rung in &improvement.ladder {
        let again = fit(scene, &rung.with);
        let pairs = [
            (rung.position_rmse, again.fit.position_rmse),
            (value(rung.orientation_rmse), value(again.fit.orientation_rmse)),
            (value(rung.reduced_chi2), value(again.fit.reduced_chi2)),
            (value(rung.restitution), value(again.restitution.value)),
            (
                value(rung.mass_ratio),
                value(again.mass_ratio.as_ref().and_then(|ratio| ratio.value)),
            ),
        ];
        for (told, found) in pairs {
            let off = (told - found).abs();
            assert!(off <= 1e-4 * found.abs(), "{what}: {:?} {told} {found}", rung.with);
        }
    }
    // Sizes are those in the model of the last rung.
    let with = &last(improvement).with;
    let model = fit(scene, with);
    for (step, rung) in improvement.ladder[1..].iter().enumerate() {
        assert_same_size(&rung.parameters, &model.effects[step].parameters, what);
        for other in &rung.look_alikes {
            let mut instead = with.clone();
            instead[step].clone_from(&other.effect);
            let model = fit(scene, &instead);
            assert_same_size(&other.parameters, &model.effects[step].parameters, what);
        }
    }
}

/// An effect is as large as was `told`, to a hundredth of its deviation.
fn assert_same_size(told: &Parameters, found: &Parameters, what: &str) {
    assert_eq!(told.keys().collect::<Vec<_>>(), found.keys().collect::<Vec<_>>(), "{what}");
    let components =
        |number: &Option<Number>| number.as_ref().map_or(Vec::new(), |n| n.components().to_vec());
    for (name, told) in told {
        let found = &found[name];
        let [values, others] = [&told.value, &found.value].map(components);
        assert_eq!((values.len(), &told.reason), (others.len(), &found.reason), "{what}: {name}");
        let stds = components(&found.std);
        for ((told, found), std) in values.iter().zip(&others).zip(stds) {
            assert!((told - found).abs() <= 0.01 * std, "{what}: {name} {told} {found} ± {std}");
        }
    }
}

fn last(improvement: &Improvement) -> &Rung {
    improvement.ladder.last().unwrap()
}

/// The names, without bodies.
fn names(labels: &[String]) -> Vec<&str> {
    labels.iter().map(|label| label.split('@').next().unwrap()).collect()
}

/// What is written fits the published schema.
fn assert_fits(kind: SchemaKind, json: &str) {
    let schema: Value = serde_json::from_str(&smash::schema(kind)).unwrap();
    let written: Value = serde_json::from_str(json).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    assert_eq!(validator.validate(&written).map_err(|e| e.to_string()), Ok(()));
}
