//! The three phases (SMASH section 4.1): from large geometry to the details of the collision.

use std::time::Instant;

use super::super::PaperOptions;
use super::super::progress::{Progress, Stage};
use super::super::result::PhaseReport;
use super::segment_search;
use super::start::tied_contact_point;
use crate::Result;
use crate::bridge::paper::ffi::{self, PaperPhase, PaperScene, PaperSolution, PaperUnknowns};

/// The outcome of all three phases.
pub(super) struct Solved {
    pub(super) collision_frames: f64,
    /// How many segments were searched.
    pub(super) segments: usize,
    pub(super) unknowns: PaperUnknowns,
    pub(super) cost: f64,
    pub(super) converged: bool,
    pub(super) phases: Vec<PhaseReport>,
}

/// Runs the segment search with phase 1 in each, then phases 2 and 3 in the best.
pub(super) fn solve(
    scene: &PaperScene,
    collision_frames: &[f64],
    options: &PaperOptions,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Solved> {
    let segment = segment_search::search(scene, collision_frames, options, progress)?;
    let trajectories = segment.solution;
    let mut phases = vec![report("1 trajectories", &trajectories, segment.seconds)];
    let mut run = |name, phase, stage, start: &PaperUnknowns| -> Result<PaperSolution> {
        let started = Instant::now();
        let solution = ffi::solve_paper_phase(scene, segment.collision_frames, phase, start)
            .map_err(super::solver_error)?;
        phases.push(report(name, &solution, started.elapsed().as_secs_f64()));
        progress(Progress { stage, cost: solution.cost_final });
        Ok(solution)
    };
    let mut impulse =
        run("2 impulse", PaperPhase::Impulse, Stage::Impulse, &trajectories.unknowns)?;
    // Phase 2 has no contact point of its own: phase 3 starts from where it was tied to.
    impulse.unknowns.contact_point = tied_contact_point(scene, &impulse.unknowns.bodies);
    let contact =
        run("3 contact point", PaperPhase::ContactPoint, Stage::ContactPoint, &impulse.unknowns)?;
    Ok(Solved {
        collision_frames: segment.collision_frames,
        segments: collision_frames.len(),
        cost: contact.cost_final,
        converged: contact.converged,
        unknowns: contact.unknowns,
        phases,
    })
}

fn report(name: &str, solution: &PaperSolution, seconds: f64) -> PhaseReport {
    PhaseReport {
        name: name.to_string(),
        cost_initial: solution.cost_initial,
        cost_final: solution.cost_final,
        iterations: solution.iterations,
        seconds: Some(seconds),
    }
}
