//! Phase 1 over all segments: between which two observations did the bodies collide?
//! (SMASH section 4.1.)

use nalgebra::Vector3;
use rayon::prelude::*;

use super::super::progress::{Progress, Stage};
use super::super::{PaperOptions, SegmentCriterion};
use super::start::start_values;
use crate::bridge::paper::ffi::{self, PaperPhase, PaperScene, PaperSolution};
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
    options: &PaperOptions,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bridge::paper::ffi::{PaperBodyUnknowns, PaperFlight, PaperUnknowns};

    fn solution(positions: &[[f64; 3]]) -> PaperSolution {
        let flight = PaperFlight { parabola: [0.0; 3], angular_momentum: [0.0; 3] };
        let body = |position: &[f64; 3]| PaperBodyUnknowns {
            position: *position,
            orientation: [1.0, 0.0, 0.0, 0.0],
            before: flight,
            after: flight,
        };
        let unknowns = PaperUnknowns {
            bodies: positions.iter().map(body).collect(),
            tilt: [0.0; 2],
            contact_point: [0.0; 3],
            impulse: [0.0; 3],
            mass_ratio: 1.0,
        };
        let (cost_initial, cost_final) = (7.0, 0.25);
        PaperSolution { unknowns, cost_initial, cost_final, iterations: 1, converged: true }
    }

    /// A plane three metres up along y.
    fn scene() -> PaperScene {
        PaperScene {
            frames_per_second: 60.0,
            gravity_m_s2: 9.81,
            bodies: Vec::new(),
            plane_normal: [0.0, 1.0, 0.0],
            plane_height_m: 3.0,
        }
    }

    /// SMASH section 4.1: the closest connection points of the parabolas; on a plane, whichever
    /// side of it the centre is.
    #[test]
    fn distance_is_that_of_the_centres_or_from_the_plane() {
        let by_distance = |positions: &[[f64; 3]]| {
            score(&scene(), SegmentCriterion::Distance, &solution(positions))
        };
        assert_eq!(by_distance(&[[1.0, 2.0, 2.0], [1.0, -1.0, 6.0]]), 5.0);
        assert_eq!(by_distance(&[[9.0, 3.5, 0.0]]), 0.5);
        assert_eq!(by_distance(&[[9.0, 2.5, 0.0]]), 0.5);
    }

    #[test]
    fn cost_is_what_phase_1_ends_with() {
        assert_eq!(score(&scene(), SegmentCriterion::Cost, &solution(&[[0.0; 3]])), 0.25);
    }
}
