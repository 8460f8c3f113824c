//! Scenes in which nothing is hidden.

use smash::diagnose::Verdict;
use smash::reconstruct::RefinedOptions;

use super::*;

/// Of 21 scenes with one false alarm in a hundred, three and more come with a probability of 0.1 %.
#[test]
fn nothing_is_found_where_nothing_is_hidden() {
    let draws = [boxes, box_on_floor, plain_balls];
    for is_stated in [true, false] {
        let mut alarms = Vec::new();
        for seed in 0..21 {
            let simulation = with(draws[seed as usize % 3](seed), &[]);
            let scene = if is_stated { simulation.scene.clone() } else { unstated(&simulation) };
            let diagnosis = smash::diagnose(&scene, &RefinedOptions::default(), &[]).unwrap();
            if diagnosis.verdict != Verdict::NothingMissing {
                alarms.push((seed, diagnosis.explanation));
            } else {
                assert!(diagnosis.explanation.contains("nothing is missing"));
            }
        }
        assert!(alarms.len() < 3, "stated {is_stated}: {alarms:?}");
    }
}

/// Its ladder is the base model alone, whose numbers are those of a reconstruction.
#[test]
fn nothing_is_added_where_nothing_is_hidden() {
    for simulation in [with(boxes(2), &[]), with(box_on_floor(3), &[])] {
        for scene in [simulation.scene.clone(), unstated(&simulation)] {
            let improvement = smash::improve(&scene, &RefinedOptions::default(), &[]).unwrap();
            assert_eq!(improvement.verdict, Verdict::NothingMissing);
            assert_eq!(improvement.ladder.len(), 1);
            assert_eq!(improvement.result.effects, []);
            assert_replayed(&scene, &improvement, "clean");
        }
    }
}
