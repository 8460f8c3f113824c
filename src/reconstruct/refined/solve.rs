//! Phase 3: everything at once, from each start that phase 2 leaves, and the noise if it isn't
//! stated.

use std::time::Instant;

use super::model::set_noise;
use super::noise::{KnownNoise, SETTLED, first_guess, positions, settle_noise, turns};
use super::optimum::{Optimum, optima_from};
use super::parabolas::{Parabolas, Paths, Segment};
use super::robust::{residual_cost, settle_robustly};
use super::spins::{Search, may_turn_otherwise};
use super::start::{Candidate, candidates};
use crate::Result;
use crate::bridge::refined::ffi::RefinedScene;
use crate::reconstruct::{Loss, PhaseReport};
use crate::scene::{Gap, Noise};

/// Segments that phase 2 looks into.
const MOST_SEGMENTS: usize = 4;
/// Starts that phase 3 is run from.
const MOST_STARTS: usize = 6;
/// Starts whose ½ χ² is larger than the best one's by so much are out of the question: phase 2 knows
/// it to a few.
const HOPELESS: f64 = 40.0;

/// All optima, best first; never empty.
pub(super) struct Solved {
    pub(super) optima: Vec<Optimum>,
    pub(super) noise: KnownNoise,
    pub(super) segments: usize,
    pub(super) phases: Vec<PhaseReport>,
}

/// Runs all phases. `scene` ends with the noise that was used.
pub(super) fn solve(
    scene: &mut RefinedScene,
    parabolas: &Parabolas,
    stated: Option<Noise>,
    loss: Loss,
) -> Result<Solved> {
    let started = Instant::now();
    let mut segments = parabolas.best_segments(MOST_SEGMENTS);
    let guess = stated.unwrap_or_else(|| first_guess(parabolas, segments[0].squares_m2));
    let worse_m2 = 2.0 * HOPELESS * guess.position.powi(2);
    let least_m2 = segments[0].squares_m2;
    segments.retain(|segment| segment.squares_m2 <= least_m2 + worse_m2);
    drop_neighbours(&mut segments, parabolas.gaps());
    let flights_s = started.elapsed().as_secs_f64();
    let solve_by = |scene: &mut RefinedScene, search| -> Result<Attempt> {
        set_noise(scene, guess);
        let started = Instant::now();
        let starts = starts(scene, parabolas, &segments, guess, search)?;
        let jumps_s = started.elapsed().as_secs_f64();
        let from: Vec<_> = starts.iter().map(|start| (start.unknowns.clone(), start.gap)).collect();
        let mut optima = optima_from(scene, &from)?;
        let cost_initial = optima[0].solution.cost_initial;
        let noise = match (loss, stated) {
            (Loss::Robust, _) => settle_robustly(scene, &mut optima, guess, stated)?,
            (Loss::Squares, Some(value)) => KnownNoise::stated(value),
            (Loss::Squares, None) => settle_noise(scene, &mut optima, guess, SETTLED)?,
        };
        let all_s = started.elapsed().as_secs_f64();
        let best = &optima[0].solution;
        let phases = vec![
            phase("2 impulse", starts[0].cost, starts[0].cost, 0, jumps_s),
            phase("3 everything", cost_initial, best.cost, best.iterations, all_s - jumps_s),
        ];
        Ok(Attempt { optima, noise, phases })
    };
    let mut attempt = solve_by(scene, Search::Turns)?;
    if misses_turns(scene, &attempt) {
        let poses = scene.clone();
        match solve_by(scene, Search::AllAxes) {
            Ok(other) if other.is_better_than(&attempt, scene, loss) => attempt = other,
            // With the noise, and maybe the weights, of the first.
            _ => *scene = poses,
        }
    }
    let position_cost = 0.5 * least_m2 / guess.position.powi(2);
    let mut phases = vec![phase("1 flights", position_cost, position_cost, 0, flights_s)];
    phases.append(&mut attempt.phases);
    let Attempt { optima, noise, .. } = attempt;
    Ok(Solved { optima, noise, segments: parabolas.gaps().len(), phases })
}

/// Where poses are dense the segments beside the best are nearly as good, and phase 3 finds its way
/// from one to the next: of short ones that touch, the best is start enough.
fn drop_neighbours(segments: &mut Vec<Segment>, gaps: &[Gap]) {
    /// Of all segments' time together.
    const SHORT: f64 = 1.0 / 15.0;
    let span_s = gaps.last().map_or(0.0, |last| last.end_s) - gaps[0].start_s;
    let is_short = |gap: &Gap| gap.end_s - gap.start_s < SHORT * span_s;
    let touch = |a: &Gap, b: &Gap| a.end_s == b.start_s || b.end_s == a.start_s;
    let mut chain: Vec<Gap> = Vec::new();
    segments.retain(|segment| {
        let is_neighbour =
            is_short(&segment.gap) && chain.iter().any(|known| touch(known, &segment.gap));
        chain.push(segment.gap);
        !is_neighbour
    });
}

/// What one search for the spins led to.
struct Attempt {
    optima: Vec<Optimum>,
    noise: KnownNoise,
    phases: Vec<PhaseReport>,
}

impl Attempt {
    /// By the likelihood, in which the noise counts too where it was estimated: −ln L is the cost of
    /// all residuals over the noise, and n ln σ.
    fn is_better_than(&self, other: &Attempt, scene: &RefinedScene, loss: Loss) -> bool {
        let score = |attempt: &Attempt| {
            let solution = &attempt.optima[0].solution;
            let noise = attempt.noise.value;
            let (position_count, _) = positions(scene, solution);
            let (turn_count, _) = turns(scene, solution);
            let poses = scene.bodies.iter().flat_map(|body| &body.poses).zip(&solution.residuals);
            let cost: f64 = poses.map(|(pose, r)| residual_cost(pose, r, noise, loss)).sum();
            cost + position_count * noise.position.ln() + turn_count * noise.orientation.ln()
        };
        score(self) < score(other)
    }
}

/// Whether a spin may be another: poses are missed by more than their stated noise, or orientations
/// by more than an annotator would be off.
fn misses_turns(scene: &RefinedScene, attempt: &Attempt) -> bool {
    /// Three degrees.
    const VISIBLE_RAD: f64 = 0.05;
    /// Noise alone exceeds so many deviations of its χ² in one scene of two hundred.
    const IMPROBABLE: f64 = 3.0;
    let solution = &attempt.optima[0].solution;
    let (count, squares) = turns(scene, solution);
    if count == 0.0 || !scene.bodies.iter().any(may_turn_otherwise) {
        return false;
    }
    match attempt.noise.orientation_dof {
        Some(spare) => squares > spare.max(1.0) * VISIBLE_RAD * VISIBLE_RAD,
        None => {
            let noise = attempt.noise.value;
            let (numbers, position_squares) = positions(scene, solution);
            let spare = (numbers + count - solution.size as f64).max(1.0);
            // From the residuals: weights of a robust fit would hide them.
            let chi2 =
                position_squares / noise.position.powi(2) + squares / noise.orientation.powi(2);
            chi2 > spare + IMPROBABLE * (2.0 * spare).sqrt()
        }
    }
}

/// The starts of phase 3, best first.
fn starts(
    scene: &RefinedScene,
    parabolas: &Parabolas,
    segments: &[Segment],
    noise: Noise,
    search: Search,
) -> Result<Vec<Candidate>> {
    let mut starts = Vec::new();
    for segment in segments {
        starts.extend(candidates(scene, parabolas, segment, noise, search)?);
    }
    starts.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let least = starts.first().map_or(0.0, |start| start.cost);
    starts.retain(|start| start.cost <= least + HOPELESS);
    starts.truncate(MOST_STARTS);
    Ok(starts)
}

fn phase(
    name: &str,
    cost_initial: f64,
    cost_final: f64,
    iterations: u32,
    seconds: f64,
) -> PhaseReport {
    let seconds = Some(seconds);
    PhaseReport { name: name.to_string(), cost_initial, cost_final, iterations, seconds }
}
