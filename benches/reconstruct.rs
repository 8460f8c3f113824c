//! How long a reconstruction takes, by the number of poses: `cargo bench`.
//!
//! Times differ from machine to machine; quote ratios from one run.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use smash::simulate::{RegularSampling, Sampling, SimulationSpec, simulate};
use smash::{Options, Scene};

/// Two cuboids over 90 frames, every `interval`-th annotated.
fn cuboids(interval: u32) -> Scene {
    let mut spec = SimulationSpec::random_cuboids(2);
    spec.observations = Sampling::Regular(RegularSampling { interval, frame_count: 90, gap: None });
    let file = simulate(&spec).expect("a random collision is valid").scene_file;
    Scene::from_file(file).expect("a simulated scene is valid")
}

/// The `paper` preset on one thread, as the paper's own set-up runs.
fn paper(criterion: &mut Criterion) {
    smash::silence_solver_log();
    let one_thread =
        rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("one thread can be had");
    let mut group = criterion.benchmark_group("paper");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for interval in [19, 9, 4] {
        let scene = cuboids(interval);
        let poses = scene.bodies()[0].observations.len();
        group.bench_with_input(BenchmarkId::new("poses a body", poses), &scene, |bench, scene| {
            one_thread.install(|| bench.iter(|| smash::reconstruct(scene, &Options::paper())));
        });
    }
    group.finish();
}

criterion_group!(benches, paper);
criterion_main!(benches);
