//! Threads and progress.

use std::sync::Mutex;

use smash::Options;
use smash::reconstruct::{Progress, Stage, reconstruct_with_progress};
use smash::scene::SceneFile;
use smash::simulate::SimulationSpec;

use super::{
    every_ninth_frame, scene, simulated, six_of_a_drop, six_of_balls, six_of_cuboids, solved,
    text_without_seconds,
};

/// One after another, all at once from many threads, or on a single one: the same to the last bit.
#[test]
fn threads_change_no_bit() {
    let files: Vec<SceneFile> = (0..4)
        .flat_map(|seed| [six_of_cuboids(seed).0, six_of_a_drop(seed).0, six_of_balls(seed).0])
        .collect();
    let texts = || -> Vec<String> {
        files.iter().map(|file| text_without_seconds(&solved(file))).collect()
    };
    let one_after_another = texts();
    std::thread::scope(|threads| {
        let at_once: Vec<_> = (0..6).map(|_| threads.spawn(texts)).collect();
        for thread in at_once {
            assert_eq!(thread.join().unwrap(), one_after_another);
        }
    });
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(single.install(texts), one_after_another);
}

/// Nine times make eight segments, six of them with two poses on each side; each of these is told
/// once, then the two phases in their order.
#[test]
fn progress_tells_each_step_once() {
    let (file, _) = simulated(&every_ninth_frame(SimulationSpec::random_balls(8)));
    let told = Mutex::new(Vec::new());
    let result =
        reconstruct_with_progress(&scene(&file), &Options::paper_by_cost(), &|step: Progress| {
            told.lock().unwrap().push(step);
        })
        .unwrap();
    let mut told = told.into_inner().unwrap();
    let phases = told.split_off(6);
    let mut numbers: Vec<_> = told
        .iter()
        .map(|step| match step.stage {
            Stage::Segment { number, of: 6 } => number,
            other => panic!("{other:?} among the segments"),
        })
        .collect();
    numbers.sort_unstable();
    assert_eq!(numbers, [1, 2, 3, 4, 5, 6]);
    let least = told.iter().map(|step| step.cost).fold(f64::INFINITY, f64::min);
    assert_eq!(least, result.phases[0].cost_final);
    let ends = [(Stage::Impulse, 1), (Stage::ContactPoint, 2)];
    let expected =
        ends.map(|(stage, phase)| Progress { stage, cost: result.phases[phase].cost_final });
    assert_eq!(phases, expected);
}
