//! Phase 3 from one start: everything at once, and what the result rests on.

use nalgebra::DMatrix;

use super::along_bounds::{Effort, free_problem, is_at_an_end, is_better, margin_s, solve, solved};
use super::covariance::Covariance;
use crate::bridge::refined::ffi::{
    self, JacobianBy, RefinedBody, RefinedProblem, RefinedScene, RefinedSolution, RefinedUnknowns,
};
use crate::effect::Hook;
use crate::reconstruct::solver_error;
use crate::scene::bounds::LEAST_POSES;
use crate::scene::{Gap, gaps_between};
use crate::{Error, ErrorKind, Result};

/// Optima whose ½ χ² is larger than the best one's by more have lost.
pub(crate) const HOPELESS: f64 = 40.0;

/// An optimum in one segment.
#[derive(Debug, Clone)]
pub(crate) struct Optimum {
    pub(crate) gap: Gap,
    pub(crate) solution: RefinedSolution,
    pub(crate) covariance: Covariance,
}

impl Optimum {
    /// How many of a channel's numbers the fit used up: the trace of its hat matrix.
    pub(super) fn used(&self, channel: &[f64]) -> f64 {
        information(&self.solution, channel).component_mul(&self.covariance.matrix).sum()
    }
}

pub(super) fn information(solution: &RefinedSolution, channel: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(solution.size, solution.size, channel)
}

/// The optima that these starts lead to, best first; never empty. Those that have lost are not followed
/// to their end.
pub(super) fn optima_from(
    scene: &RefinedScene,
    starts: &[(RefinedUnknowns, Gap)],
) -> Result<Vec<Optimum>> {
    let from = starts.iter().map(|(unknowns, gap)| (unknowns, *gap));
    let found = all_optima(scene, from, Effort::UntilAtAnEnd)?;
    let mut optima: Vec<Optimum> =
        found.into_iter().map(|optimum| walked(scene, optimum, Effort::UntilAtAnEnd)).collect();
    sort(&mut optima);
    let least = optima[0].solution.cost;
    for best in optima.iter_mut().filter(|other| other.solution.cost <= least + HOPELESS) {
        if is_at_an_end(best.gap, &best.solution) {
            let along = optimum(scene, &best.solution.unknowns, best.gap, Effort::Whole)?;
            *best = walked(scene, along, Effort::Whole);
        }
    }
    sort(&mut optima);
    Ok(optima)
}

/// The optimum of a nested model as one of `scene`, where at `unknowns` it is the same model: cost
/// and residuals are its own to the last digit, whatever integrators differ by.
pub(super) fn nested_optimum(
    scene: &RefinedScene,
    unknowns: &RefinedUnknowns,
    nested: &Optimum,
) -> Result<Optimum> {
    let known = nested.solution.clone();
    let mut problem = free_problem(unknowns, &nested.gap);
    problem.most_iterations = 0;
    let solution = RefinedSolution {
        cost: known.cost,
        converged: known.converged,
        residuals: known.residuals,
        ..solve(scene, &problem)?
    };
    let covariance = Covariance::new(&total_information(&solution));
    Ok(Optimum { gap: nested.gap, covariance, solution })
}

/// On to the next segment, and the next, as long as the collision time ends at the bound ahead and χ²
/// falls. A time that comes back to the bound between two is best there: to and fro it would creep.
fn walked(scene: &RefinedScene, mut best: Optimum, effort: Effort) -> Optimum {
    const MOST_STEPS: usize = 50;
    let mut goes_down = None;
    for _ in 0..MOST_STEPS {
        if !is_at_an_end(best.gap, &best.solution) {
            break;
        }
        let Gap { start_s, end_s } = best.gap;
        let margin_s = margin_s(best.gap);
        let Ok(gaps) = gaps(scene, &best.solution.unknowns) else { break };
        let is_down = best.solution.unknowns.collision_time_s - start_s < margin_s;
        if *goes_down.get_or_insert(is_down) != is_down {
            break;
        }
        let next = match is_down {
            true => gaps.iter().rfind(|gap| gap.end_s <= start_s + margin_s),
            false => gaps.iter().find(|gap| gap.start_s >= end_s - margin_s),
        };
        let Some(&gap) = next else { break };
        match optimum(scene, &best.solution.unknowns, gap, effort) {
            Ok(other) if is_better(&other.solution, &best.solution) => best = other,
            _ => break,
        }
    }
    best
}

/// The optima from where they are: their noise has changed.
pub(super) fn warm(scene: &RefinedScene, optima: &[Optimum]) -> Result<Vec<Optimum>> {
    let from = optima.iter().map(|known| (&known.solution.unknowns, known.gap));
    all_optima(scene, from, Effort::Whole)
}

/// One that fails doesn't spoil the others.
fn all_optima<'a>(
    scene: &RefinedScene,
    starts: impl Iterator<Item = (&'a RefinedUnknowns, Gap)>,
    effort: Effort,
) -> Result<Vec<Optimum>> {
    let mut optima = Vec::new();
    let mut failure = None;
    for (unknowns, gap) in starts {
        match optimum(scene, unknowns, gap, effort) {
            Ok(optimum) => optima.push(optimum),
            Err(error) => failure = Some(error),
        }
    }
    sort(&mut optima);
    match (optima.is_empty(), failure) {
        (false, _) => Ok(optima),
        (true, Some(error)) => Err(error),
        (true, None) => Err(Error::new(ErrorKind::Solve, "no start explains the poses")
            .at("bodies")
            .mend("check the poses for single ones far off, and the stated noise")),
    }
}

pub(super) fn sort(optima: &mut [Optimum]) {
    optima.sort_by(|a, b| a.solution.cost.total_cmp(&b.solution.cost));
}

/// The optimum from `unknowns`, with the collision in `gap`; where effects move the poses' times,
/// in the gap that theirs then make.
fn optimum(
    scene: &RefinedScene,
    unknowns: &RefinedUnknowns,
    gap: Gap,
    effort: Effort,
) -> Result<Optimum> {
    /// Times that move poses across the collision settle within a few.
    const MOST_ROUNDS: usize = 6;
    let mut solution = solved(scene, &free_problem(unknowns, &gap), effort)?;
    let mut gap = gap;
    if moves_times(scene) {
        for _ in 0..MOST_ROUNDS {
            let gaps = gaps(scene, &solution.unknowns)?;
            let now = nearest(&gaps, solution.unknowns.collision_time_s).unwrap_or(gap);
            let is_same = split(scene, &solution.unknowns, now)? == split(scene, unknowns, gap)?;
            gap = now;
            if is_same {
                break;
            }
            let from = solution.unknowns.clone();
            solution = solved(scene, &free_problem(&from, &gap), effort)?;
        }
    }
    Ok(Optimum { gap, covariance: Covariance::new(&total_information(&solution)), solution })
}

/// The model at `unknowns`; nothing is optimised.
pub(super) fn evaluated(
    scene: &RefinedScene,
    unknowns: &RefinedUnknowns,
    gap: Gap,
    jacobian: JacobianBy,
) -> Result<RefinedSolution> {
    let problem = free_problem(unknowns, &gap);
    solve(scene, &RefinedProblem { most_iterations: 0, jacobian, ..problem })
}

fn total_information(solution: &RefinedSolution) -> DMatrix<f64> {
    information(solution, &solution.position_information)
        + information(solution, &solution.orientation_information)
        + information(solution, &solution.prior_information)
}

/// Whether an effect says when poses were seen.
fn moves_times(scene: &RefinedScene) -> bool {
    scene.laws.iter().any(|law| law.hook == Hook::Time as u8)
}

/// The times of each body's poses in the model.
fn pose_times(scene: &RefinedScene, unknowns: &RefinedUnknowns) -> Result<Vec<Vec<f64>>> {
    if !moves_times(scene) {
        let times = |body: &RefinedBody| body.poses.iter().map(|pose| pose.time_s).collect();
        return Ok(scene.bodies.iter().map(times).collect());
    }
    let all = ffi::pose_times(scene, unknowns).map_err(solver_error)?;
    let mut rest = all.as_slice();
    let mut times = Vec::new();
    for body in &scene.bodies {
        let (own, others) = rest.split_at(body.poses.len());
        times.push(own.to_vec());
        rest = others;
    }
    Ok(times)
}

/// The gaps that the collision can be in, with the poses at their times in the model.
pub(super) fn gaps(scene: &RefinedScene, unknowns: &RefinedUnknowns) -> Result<Vec<Gap>> {
    Ok(gaps_between(&pose_times(scene, unknowns)?, LEAST_POSES))
}

/// How many poses of each body are before the gap.
fn split(scene: &RefinedScene, unknowns: &RefinedUnknowns, gap: Gap) -> Result<Vec<usize>> {
    let middle_s = gap.midpoint_s();
    let before = |times: &Vec<f64>| times.iter().filter(|time_s| **time_s < middle_s).count();
    Ok(pose_times(scene, unknowns)?.iter().map(before).collect())
}

/// The gap that holds `time_s`, or the nearest.
pub(super) fn nearest(gaps: &[Gap], time_s: f64) -> Option<Gap> {
    let distance = |gap: &Gap| (gap.start_s - time_s).max(time_s - gap.end_s).max(0.0);
    gaps.iter().min_by(|a, b| distance(a).total_cmp(&distance(b))).copied()
}
