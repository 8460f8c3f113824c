//! Starts from the base model solved anew, of the scene as an effect would have it: where the optimum
//! without the effect is of no use, since a spin or the segment is wrong because of it.

use super::acting::Acting;
use super::fitted::Fitted;
use super::model::refined_scene;
use super::parabolas::{Parabolas, Paths};
use super::solve::solve;
use super::starts::{MOST_POINTS, Start, points};
use crate::Scene;
use crate::reconstruct::Loss;
use crate::scene::Gap;

/// So few poses are all tried; of more, those whose absence lets the others lie on parabolas best.
const FEW_POSES: usize = 32;
/// Of more poses than these none is left out: the work goes with their square.
const MOST_POSES: usize = 500;

/// With a body's stamps moved: the delay may be more than a segment. Which delays are worth it the
/// parabolas tell.
pub(super) fn delayed(nested: &Fitted, scene: &Scene, acting: &Acting, place: usize) -> Vec<Start> {
    let mut moved: Vec<(f64, f64, Scene)> = points(scene, &acting.instance)
        .into_iter()
        .filter_map(|delay_s| {
            let moved = scene.delayed(acting.instance.body, -delay_s)?;
            let squares_m2 = Parabolas::new(&moved).best_segments(1).first()?.squares_m2;
            Some((squares_m2, delay_s, moved))
        })
        .collect();
    moved.sort_by(|a, b| a.0.total_cmp(&b.0));
    let likely = moved.into_iter().take(MOST_POINTS);
    let solved = likely
        .filter_map(|(_, delay_s, moved)| solved_anew(nested, &moved, acting, (place, delay_s)));
    solved.map(|solved| solved.start).collect()
}

/// Without each pose in turn, the best first; nothing where the poses are very many, or the model isn't far
/// off all of them.
pub(super) fn without_a_pose(
    nested: &Fitted,
    scene: &Scene,
    acting: &Acting,
    place: usize,
) -> Vec<Start> {
    let mut times_s = points(scene, &acting.instance);
    if times_s.len() > MOST_POSES || !nested.is_lost() {
        return Vec::new();
    }
    if times_s.len() > FEW_POSES {
        times_s = off_the_parabola(scene, acting, &times_s);
    }
    let mut solved: Vec<SolvedAnew> = times_s
        .into_iter()
        .filter_map(|time_s| {
            let rest = scene.without_pose(acting.instance.body, time_s)?;
            let mut solved = solved_anew(nested, &rest, acting, (place, time_s))?;
            // The gap that the pose was in, or ends.
            let collision_time_s = solved.start.0.collision_time_s;
            let holds = |gap: &Gap| (gap.start_s..=gap.end_s).contains(&collision_time_s);
            solved.start.1 = scene.gaps().into_iter().find(holds)?;
            Some(solved)
        })
        .collect();
    solved.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    solved.into_iter().take(MOST_POINTS).map(|solved| solved.start).collect()
}

/// The poses without which the others lie on parabolas best.
fn off_the_parabola(scene: &Scene, acting: &Acting, times_s: &[f64]) -> Vec<f64> {
    let mut left: Vec<(f64, f64)> = times_s
        .iter()
        .filter_map(|&time_s| {
            let rest = scene.without_pose(acting.instance.body, time_s)?;
            Some((Parabolas::new(&rest).best_segments(1).first()?.squares_m2, time_s))
        })
        .collect();
    left.sort_by(|a, b| a.0.total_cmp(&b.0));
    left.into_iter().take(MOST_POINTS).map(|(_, time_s)| time_s).collect()
}

struct SolvedAnew {
    cost: f64,
    start: Start,
}

/// The base model of `scene`, as a start for `nested` with `acting` added, whose scalar at `place` has
/// this value.
fn solved_anew(
    nested: &Fitted,
    scene: &Scene,
    acting: &Acting,
    (place, value): (usize, f64),
) -> Option<SolvedAnew> {
    let noise = nested.noise.value;
    let parabolas = Parabolas::new(scene);
    let mut refined = refined_scene(scene, noise, nested.refined.tilt_std_rad);
    let solved = solve(&mut refined, &parabolas, Some(noise), Loss::Squares).ok()?;
    let best = &solved.optima[0];
    let mut unknowns = best.solution.unknowns.clone();
    let known = &nested.best().solution.unknowns.parameters;
    unknowns.parameters = [known.as_slice(), &acting.instance.null()].concat();
    unknowns.parameters[acting.first + place] = value;
    Some(SolvedAnew { cost: best.solution.cost, start: (unknowns, best.gap) })
}
