//! Phase 1 over all segments: between which two observations did the bodies collide?
//! (SMASH section 4.1.)

use nalgebra::Vector3;
use rayon::prelude::*;

use super::progress::{Progress, Stage};
use super::start::start_values;
use super::{Options, SegmentCriterion};
use crate::bridge::ffi::{self, PaperPhase, PaperScene, PaperSolution};
use crate::{Error, ErrorKind, Result};

/// A segment whose phase 1 was solved.
pub(super) struct SolvedSegment {
    /// The collision time: the segment's midpoint, in frames.
    pub(super) collision_frames: f64,
    pub(super) solution: PaperSolution,
    /// How long phase 1 took, in s.
    pub(super) seconds: f64,
}

/// Solves phase 1 with the collision at each of `collision_frames`, the segments' middles, and keeps
/// the best by the chosen criterion; the earlier of equals.
///
/// # Errors
/// No segment has a usable solution.
pub(super) fn search(
    scene: &PaperScene,
    collision_frames: &[f64],
    options: &Options,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<SolvedSegment> {
    let segments = collision_frames.len();
    let solved: Vec<Result<SolvedSegment>> = collision_frames
        .par_iter()
        .enumerate()
        .map(|(index, &collision_frames)| {
            let segment = solve_segment(scene, collision_frames, options.seed)?;
            let stage = Stage::Segment { number: index + 1, of: segments };
            progress(Progress { stage, cost: segment.solution.cost_final });
            Ok(segment)
        })
        .collect();
    let mut failure = None;
    let mut best: Option<(f64, SolvedSegment)> = None;
    for segment in solved {
        match segment {
            Ok(segment) => {
                let score = score(scene, options.segment_by, &segment.solution);
                if best.as_ref().is_none_or(|(least, _)| score < *least) {
                    best = Some((score, segment));
                }
            }
            Err(error) => failure = Some(error),
        }
    }
    match (best, failure) {
        (Some((_, segment)), _) => Ok(segment),
        (None, Some(error)) => Err(error),
        (None, None) => Err(Error::new(ErrorKind::Solve, "there is no segment to search")),
    }
}

fn solve_segment(scene: &PaperScene, collision_frames: f64, seed: u64) -> Result<SolvedSegment> {
    let started = std::time::Instant::now();
    let start = start_values(scene, collision_frames, seed);
    let solution =
        ffi::solve_paper_phase(scene, collision_frames, PaperPhase::Trajectories, &start)
            .map_err(super::solver_error)?;
    let seconds = started.elapsed().as_secs_f64();
    Ok(SolvedSegment { collision_frames, solution, seconds })
}

/// What the best segment has least of.
fn score(scene: &PaperScene, criterion: SegmentCriterion, solution: &PaperSolution) -> f64 {
    match criterion {
        SegmentCriterion::Cost => solution.cost_final,
        SegmentCriterion::Distance => {
            let bodies = &solution.unknowns.bodies;
            let a = Vector3::from(bodies[0].position);
            match bodies.get(1) {
                Some(b) => (a - Vector3::from(b.position)).norm(),
                None => (Vector3::from(scene.plane_normal).dot(&a) - scene.plane_height_m).abs(),
            }
        }
    }
}
