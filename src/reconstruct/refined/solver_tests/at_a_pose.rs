//! Collisions at the very time of a pose: χ² has a kink there, at the bound of two segments.

use super::super::along_bounds::{Effort, free_problem, solved};
use super::super::fit;
use super::{options, read};
use crate::scene::Gap;

/// As an optimum's cost with all else at its own optimum, on either side of the kink.
#[test]
fn the_least_at_a_kink_is_found() {
    let scene = read("tests/data/stuck/depth_scale_seed_81002_throw_1.json");
    for effects in [&[][..], &["depth_scale@b"], &["com_offset@b"]] {
        let fitted = fit(&scene, &options(effects)).unwrap();
        let best = &fitted.best().solution;
        let Gap { start_s, end_s } = fitted.best().gap;
        let at_s = best.unknowns.collision_time_s;
        assert!(best.converged, "{effects:?}");
        assert!(f64::min(at_s - start_s, end_s - at_s) < 1e-9, "{effects:?}: {at_s} s");
        let held = |time_s: f64, gap: Gap| {
            let mut problem = free_problem(&best.unknowns, &gap);
            problem.start.collision_time_s = time_s;
            problem.hold.collision_time = true;
            solved(&fitted.refined, &problem, Effort::Whole).unwrap().cost
        };
        // Within rounding the same model, from the segment on either side.
        let [earlier, later] =
            [Gap { start_s: at_s - 0.01, end_s: at_s }, Gap { start_s: at_s, end_s: at_s + 0.01 }];
        for gap in [earlier, later] {
            assert!((held(at_s, gap) / best.cost - 1.0).abs() < 1e-6, "{effects:?}");
        }
        // A tenth of its deviation aside.
        for (time_s, gap) in [(at_s - 3e-4, earlier), (at_s + 3e-4, later)] {
            assert!(held(time_s, gap) > best.cost * (1.0 + 1e-6), "{effects:?}: {time_s} s");
        }
    }
}
