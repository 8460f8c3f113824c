//! When bodies are seen.

use nalgebra::Vector3;
use smash::simulate::{RegularSampling, Sampling, SimulationSpec, simulate};

/// What is seen is the motion, at the frames asked for: left and right of a gap of twice the
/// interval, as in the paper.
#[test]
fn the_paper_s_sampling_leaves_a_gap_around_the_collision() {
    // "An interval of 19 frames means only four annotated poses": 45 − 2·19, 45 − 19, …
    let sampling = |interval| RegularSampling { interval, frame_count: 90, gap: None };
    assert_eq!(sampling(19).frame_numbers(45.2), [7, 26, 64, 83]);
    assert_eq!(sampling(14).frame_numbers(44.6), [3, 17, 31, 59, 73, 87]);
    for interval in [1, 4, 9, 14, 19] {
        for collision_frame in [40.0, 42.5, 44.01, 47.99] {
            let frames = sampling(interval).frame_numbers(collision_frame);
            let before = frames.iter().filter(|&&f| f64::from(f) < collision_frame).count();
            let gap = frames[before] - frames[before - 1];
            assert_eq!(gap, 2 * interval);
            let steps = frames.windows(2).map(|pair| pair[1] - pair[0]);
            assert_eq!(
                steps.filter(|&step| step != interval).count(),
                usize::from(gap != interval)
            );
        }
    }
    let all = RegularSampling::every_frame(90).frame_numbers(44.2);
    assert_eq!(all, (0..90).collect::<Vec<u32>>());
}

#[test]
fn a_scene_shows_the_motion_at_the_times_asked_for() {
    let mut spec = SimulationSpec::random_cuboids(3);
    let collision_s = spec.collision.time;
    let times = [-0.5, -0.41, -0.1, 0.13, 0.2, 0.61].map(|since| collision_s + since);
    spec.observations = Sampling::Times(times.into());
    spec.bodies[1].observations = Some(Sampling::Frames(vec![1.0, 7.5, 20.0, 60.0, 88.0]));
    let simulation = simulate(&spec).unwrap();
    let observations =
        |index: usize| simulation.scene_file.bodies[index].observations.as_ref().unwrap();
    let seen_times: Vec<f64> = observations(0).iter().filter_map(|seen| seen.time).collect();
    assert_eq!(seen_times, times);
    for seen in observations(1) {
        let body = simulation.motions[1].at(seen.frame.unwrap() / 60.0);
        assert_eq!(Vector3::from(seen.position), body.position_in_world);
    }
    assert_eq!(observations(1).len(), 5);
}

/// Neither a film of years nor a collision aeons off it costs time or memory.
#[test]
fn frames_of_endless_films_are_bounded() {
    let endless = RegularSampling::every_frame(u32::MAX);
    let frames = endless.frame_numbers(1e9);
    assert_eq!(frames.len(), 200_000);
    assert!(frames.contains(&999_999_999) && frames.contains(&1_000_000_001), "nearest first");
    for off_film in [1e300, f64::INFINITY] {
        let frames = endless.frame_numbers(off_film);
        assert_eq!((frames.len(), frames.last()), (100_000, Some(&(u32::MAX - 1))));
    }
    let sparse = RegularSampling { interval: 7, frame_count: 49, gap: None };
    assert_eq!(sparse.frame_numbers(f64::INFINITY).len(), 7, "one every 7 frames of 49");
    for off_film in [-1e300, f64::NEG_INFINITY] {
        assert_eq!(endless.frame_numbers(off_film).first(), Some(&0));
    }
}

/// By stepping, the same frames as by trying each of the film.
#[test]
fn frames_are_those_at_whole_intervals_from_the_gap() {
    for interval in 1..6 {
        for gap in 0..8 {
            for collision in -20..60 {
                let collision_frame = f64::from(collision) / 2.0 + 0.1;
                let sampling = RegularSampling { interval, frame_count: 20, gap: Some(gap) };
                let (interval, gap) = (i64::from(interval), i64::from(gap));
                let last = (collision_frame - gap as f64 / 2.0).round() as i64;
                let is_seen = |&frame: &u32| {
                    let (before, after) = (last - i64::from(frame), i64::from(frame) - last - gap);
                    [before, after].iter().any(|off| *off >= 0 && off % interval == 0)
                };
                let expected: Vec<u32> = (0..20).filter(is_seen).collect();
                assert_eq!(sampling.frame_numbers(collision_frame), expected, "{sampling:?}");
            }
        }
    }
}
