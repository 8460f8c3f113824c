//! How long a reconstruction takes, by preset and by the number of poses: `cargo bench`.
//!
//! Times differ from machine to machine; quote ratios from one run. Every frame of 90 in the paper's
//! method takes some minutes: `cargo bench -- refined` leaves that out.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use smash::scene::Noise;
use smash::simulate::{NoiseSpec, RegularSampling, Sampling, SimulationSpec, simulate};
use smash::{Options, Scene};

/// An annotator's, stated in the scene.
const NOISE: Noise = Noise { position: 0.002, orientation: 0.01 };

/// Two cuboids over 90 frames, every `interval`-th annotated.
fn cuboids(interval: u32) -> Scene {
    seen(Sampling::Regular(RegularSampling { interval, frame_count: 90, gap: None }))
}

/// Two cuboids over a second and a half, `count` poses of each.
fn often(count: u32) -> Scene {
    let step_s = 1.5 / f64::from(count);
    seen(Sampling::Times((0..count).map(|i| (f64::from(i) + 0.5) * step_s).collect()))
}

fn seen(observations: Sampling) -> Scene {
    let mut spec = SimulationSpec::random_cuboids(2);
    spec.noise = NoiseSpec::Gaussian(NOISE);
    spec.observations = observations;
    let file = simulate(&spec).expect("a random collision is valid").scene_file;
    Scene::from_file(file).expect("a simulated scene is valid")
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

criterion_group!(benches, presets, scaling);
criterion_main!(benches);
