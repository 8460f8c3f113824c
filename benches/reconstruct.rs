//! How long a reconstruction takes, by preset and by the number of poses: `cargo bench`.
//!
//! Times differ from machine to machine; quote ratios from one run. Every frame of 90 in the paper's
//! method takes some minutes: `cargo bench -- refined` leaves that out.

use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use smash::scene::Noise;
use smash::simulate::{EffectSpec, NoiseSpec, RegularSampling, Sampling, SimulationSpec, simulate};
use smash::studio::{Action, Change, Studio};
use smash::{Options, Scene};

/// An annotator's, stated in the scene.
const NOISE: Noise = Noise { position: 0.002, orientation: 0.01 };

/// Two cuboids over 90 frames, every `interval`-th annotated.
fn cuboids(interval: u32) -> Scene {
    seen(Sampling::Regular(RegularSampling { interval, frame_count: 90, gap: None }))
}

/// Two cuboids over a second and a half, `count` poses of each.
fn often(count: u32) -> Scene {
    seen(Sampling::Times(moments(count)))
}

/// `count` times in s, evenly over a second and a half.
fn moments(count: u32) -> Vec<f64> {
    let step_s = 1.5 / f64::from(count);
    (0..count).map(|i| (f64::from(i) + 0.5) * step_s).collect()
}

fn seen(observations: Sampling) -> Scene {
    let file = simulate(&spec(observations)).expect("a random collision is valid").scene_file;
    Scene::from_file(file).expect("a simulated scene is valid")
}

fn spec(observations: Sampling) -> SimulationSpec {
    let mut spec = SimulationSpec::random_cuboids(2);
    spec.noise = NoiseSpec::Gaussian(NOISE);
    spec.observations = observations;
    spec
}

/// Both presets on one thread, as the paper's own set-up runs.
fn presets(criterion: &mut Criterion) {
    smash::silence_solver_log();
    let one_thread =
        rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    for (name, options) in [("refined", Options::default()), ("paper", Options::paper())] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10).measurement_time(Duration::from_secs(5));
        for interval in [19, 9, 4, 1] {
            let scene = cuboids(interval);
            let poses = scene.bodies()[0].observations.len();
            let id = BenchmarkId::new("poses a body", poses);
            group.bench_with_input(id, &scene, |bench, scene| {
                one_thread.install(|| bench.iter(|| smash::reconstruct(scene, &options)));
            });
        }
        group.finish();
    }
}

/// Time a pose, from few to many.
fn scaling(criterion: &mut Criterion) {
    smash::silence_solver_log();
    let mut group = criterion.benchmark_group("refined, by poses");
    group.sample_size(10);
    for count in [10, 100, 1_000, 10_000] {
        let scene = often(count);
        group.throughput(Throughput::Elements(u64::from(2 * count)));
        group.bench_with_input(BenchmarkId::new("poses a body", count), &scene, |bench, scene| {
            bench.iter(|| smash::reconstruct(scene, &Options::default()));
        });
    }
    group.finish();
}

/// An act of the studio on two bodies with sixty poses each, on one thread: the fit from the one
/// before, the report, and the session's file.
fn studio(criterion: &mut Criterion) {
    smash::silence_solver_log();
    let one_thread =
        rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    let folder = tempfile::tempdir().expect("the system has a folder for temporary files");
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, dragged(60).to_json()).expect("the folder is new");
    let opened = || {
        // Of one that is there already the fit would be kept.
        let _ = std::fs::remove_file(folder.path().join("scene.session.json"));
        Studio::open(&scene, None).expect("a simulated scene can be fitted")
    };
    let mut group = criterion.benchmark_group("studio");
    group.sample_size(10);
    for effect in ["quadratic_drag@a", "magnus@a", "gravity_scale", "outlier@a", "second_impact@a"]
    {
        let add = || Action::Change(Change::Add { effect: effect.to_string() });
        group.bench_function(BenchmarkId::new("adds", effect), |bench| {
            one_thread.install(|| {
                bench.iter_batched(
                    opened,
                    |studio| studio.act(add()).expect("the scene can show it"),
                    BatchSize::PerIteration,
                );
            });
        });
    }
    group.finish();
}

/// Two cuboids with `count` poses each, of which one feels a drag.
fn dragged(count: u32) -> smash::scene::SceneFile {
    let mut spec = spec(Sampling::Times(moments(count)));
    let drag = EffectSpec::parse("quadratic_drag@a:k=0.03").expect("the catalogue has it");
    spec.effects = vec![drag];
    simulate(&spec).expect("a random collision is valid").scene_file
}

criterion_group!(benches, presets, scaling, studio);
criterion_main!(benches);
