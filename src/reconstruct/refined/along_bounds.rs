//! One problem of phase 3 to its end, with what meets a bound held there: Ceres cuts whole steps short
//! at a bound, also of what could still move, and creeps or takes that for convergence.

use crate::Result;
use crate::bridge::refined::ffi::{
    self, JacobianBy, ParameterRule, RefinedHold, RefinedProblem, RefinedScene, RefinedSolution,
    RefinedUnknowns, RestitutionPin,
};
use crate::reconstruct::solver_error;
use crate::scene::Gap;

const MOST_ITERATIONS: u32 = 50;

/// How far an optimum is followed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Effort {
    /// To its end.
    Whole,
    /// To its end, unless the collision time stays at its segment's end: most often the optimum is in
    /// the next segment.
    UntilAtAnEnd,
}

/// Minimises from where `unknowns` are, with nothing held.
pub(super) fn free_problem(unknowns: &RefinedUnknowns, gap: &Gap) -> RefinedProblem {
    let mut start = unknowns.clone();
    start.collision_time_s = start.collision_time_s.clamp(gap.start_s, gap.end_s);
    RefinedProblem {
        start,
        earliest_s: gap.start_s,
        latest_s: gap.end_s,
        hold: RefinedHold { collision_time: false, log_mass_ratio: false },
        restitution: RestitutionPin { value: 0.0, weight: 0.0 },
        most_iterations: MOST_ITERATIONS,
        jacobian: JacobianBy::Nothing,
    }
}

/// The optimum of a problem. Where the collision time meets an end of its segment, or a parameter a
/// bound, that is held and the rest goes on; then all is let go again: the time may leave the end now.
pub(super) fn solved(
    scene: &RefinedScene,
    problem: &RefinedProblem,
    effort: Effort,
) -> Result<RefinedSolution> {
    const MOST_ROUNDS: usize = 3;
    let gap = Gap { start_s: problem.earliest_s, end_s: problem.latest_s };
    let mut best = solve(scene, problem)?;
    for _ in 0..MOST_ROUNDS {
        let holds_time =
            effort == Effort::Whole && !problem.hold.collision_time && is_at_an_end(gap, &best);
        let Some(along) = along_bounds(scene, problem, &best, holds_time)? else { break };
        best = along;
        if !holds_time {
            break;
        }
        match solve(scene, &from(&best, problem))? {
            freed if is_better(&freed, &best) => best = freed,
            _ => break,
        }
    }
    Ok(best)
}

/// The problem, with the start where a solution is.
fn from(solution: &RefinedSolution, problem: &RefinedProblem) -> RefinedProblem {
    RefinedProblem { start: solution.unknowns.clone(), ..problem.clone() }
}

/// The scene with the parameters held that are at a bound; `None` where none is.
fn held_at_bounds(scene: &RefinedScene, unknowns: &RefinedUnknowns) -> Option<RefinedScene> {
    let mut held = scene.clone();
    for (rule, value) in held.parameters.iter_mut().zip(&unknowns.parameters) {
        rule.held |= *value <= rule.low || *value >= rule.high;
    }
    let is_new = |(rule, known): (&ParameterRule, &ParameterRule)| rule.held && !known.held;
    held.parameters.iter().zip(&scene.parameters).any(is_new).then_some(held)
}

/// On from where something met its bound, which is held; `None` where nothing is.
fn along_bounds(
    scene: &RefinedScene,
    problem: &RefinedProblem,
    met: &RefinedSolution,
    holds_time: bool,
) -> Result<Option<RefinedSolution>> {
    let held = held_at_bounds(scene, &met.unknowns);
    if held.is_none() && !holds_time {
        return Ok(None);
    }
    let mut bound = from(met, problem);
    bound.hold.collision_time |= holds_time;
    let moved = solve(held.as_ref().unwrap_or(scene), &bound)?;
    if moved.cost >= met.cost {
        return Ok(Some(RefinedSolution {
            converged: met.converged || moved.converged,
            ..met.clone()
        }));
    }
    Ok(Some(RefinedSolution {
        cost_initial: met.cost_initial,
        iterations: met.iterations + moved.iterations,
        converged: moved.converged,
        ..solve(scene, &RefinedProblem { most_iterations: 0, ..from(&moved, problem) })?
    }))
}

pub(super) fn solve(scene: &RefinedScene, problem: &RefinedProblem) -> Result<RefinedSolution> {
    ffi::solve_refined(scene, problem).map_err(solver_error)
}

/// Nearer to a segment's end, a collision time is at it.
pub(super) fn margin_s(gap: Gap) -> f64 {
    1e-6 * (gap.end_s - gap.start_s)
}

pub(super) fn is_at_an_end(gap: Gap, solution: &RefinedSolution) -> bool {
    let time_s = solution.unknowns.collision_time_s;
    f64::min(time_s - gap.start_s, gap.end_s - time_s) < margin_s(gap)
}

/// By more than rounding.
pub(super) fn is_better(other: &RefinedSolution, best: &RefinedSolution) -> bool {
    other.cost < best.cost * (1.0 - 1e-9)
}
