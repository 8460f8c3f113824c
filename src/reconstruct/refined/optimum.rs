//! Phase 3 from one start: everything at once, and what the result rests on.

use nalgebra::DMatrix;

use super::covariance::Covariance;
use super::start::Candidate;
use crate::bridge::refined::ffi::{
    self, RefinedHold, RefinedProblem, RefinedScene, RefinedSolution, RestitutionPin,
};
use crate::reconstruct::solver_error;
use crate::scene::Gap;
use crate::{Error, ErrorKind, Result};

const MOST_ITERATIONS: u32 = 50;

/// An optimum in one segment.
#[derive(Debug, Clone)]
pub(super) struct Optimum {
    pub(super) gap: Gap,
    pub(super) solution: RefinedSolution,
    pub(super) covariance: Covariance,
}

/// Minimises from where `unknowns` are, with nothing held.
pub(super) fn free_problem(unknowns: &ffi::RefinedUnknowns, gap: &Gap) -> RefinedProblem {
    let mut start = unknowns.clone();
    start.collision_time_s = start.collision_time_s.clamp(gap.start_s, gap.end_s);
    RefinedProblem {
        start,
        earliest_s: gap.start_s,
        latest_s: gap.end_s,
        hold: RefinedHold { collision_time: false, log_mass_ratio: false },
        restitution: RestitutionPin { value: 0.0, weight: 0.0 },
        most_iterations: MOST_ITERATIONS,
        with_jacobian: false,
    }
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

pub(super) fn optimised(
    scene: &RefinedScene,
    starts: &[Candidate],
    gaps: &[Gap],
) -> Result<Vec<Optimum>> {
    let optima = all_optima(scene, starts.iter().map(|start| (&start.unknowns, start.gap)))?;
    let mut walked: Vec<Optimum> =
        optima.into_iter().map(|optimum| walked(scene, optimum, gaps)).collect();
    sort(&mut walked);
    Ok(walked)
}

/// On to the next segment, and the next, as long as the collision time ends at a bound and χ² falls.
fn walked(scene: &RefinedScene, mut best: Optimum, gaps: &[Gap]) -> Optimum {
    const MOST_STEPS: usize = 50;
    for _ in 0..MOST_STEPS {
        let Gap { start_s, end_s } = best.gap;
        let margin_s = 1e-6 * (end_s - start_s);
        let time_s = best.solution.unknowns.collision_time_s;
        let next = match (time_s - start_s < margin_s, end_s - time_s < margin_s) {
            (true, _) => gaps.iter().find(|gap| gap.end_s == start_s),
            (_, true) => gaps.iter().find(|gap| gap.start_s == end_s),
            _ => None,
        };
        let Some(&gap) = next else { break };
        let next = optimum(scene, &free_problem(&best.solution.unknowns, &gap), gap);
        match next {
            // By more than rounding.
            Ok(other) if other.solution.cost < best.solution.cost * (1.0 - 1e-9) => best = other,
            _ => break,
        }
    }
    best
}

/// The optima from where they are: their noise has changed.
pub(super) fn warm(scene: &RefinedScene, optima: &[Optimum]) -> Result<Vec<Optimum>> {
    all_optima(scene, optima.iter().map(|known| (&known.solution.unknowns, known.gap)))
}

/// One that fails doesn't spoil the others.
fn all_optima<'a>(
    scene: &RefinedScene,
    starts: impl Iterator<Item = (&'a ffi::RefinedUnknowns, Gap)>,
) -> Result<Vec<Optimum>> {
    let mut optima = Vec::new();
    let mut failure = None;
    for (unknowns, gap) in starts {
        match optimum(scene, &free_problem(unknowns, &gap), gap) {
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

fn optimum(scene: &RefinedScene, problem: &RefinedProblem, gap: Gap) -> Result<Optimum> {
    let solution = ffi::solve_refined(scene, problem).map_err(solver_error)?;
    let sum = information(&solution, &solution.position_information)
        + information(&solution, &solution.orientation_information)
        + information(&solution, &solution.prior_information);
    Ok(Optimum { gap, covariance: Covariance::new(&sum), solution })
}
