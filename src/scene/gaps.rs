//! The gaps between observation times, in one of which the collision must be.

use super::bounds::{LEAST_POSES, SAME_TIME_S};
use super::{DynamicBody, Scene};
use crate::words::{counted, quoted};
use crate::{Error, Result};

/// A gap between two consecutive times of all bodies' observations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gap {
    /// The last time before the gap, in s.
    pub start_s: f64,
    /// The first time after the gap, in s.
    pub end_s: f64,
}

impl Gap {
    /// The time in the middle, in s.
    pub fn midpoint_s(&self) -> f64 {
        0.5 * (self.start_s + self.end_s)
    }
}

impl Scene {
    /// The gaps that the collision can be in: those with 2 or more poses of each body on each
    /// side. In order of time; never empty.
    pub fn gaps(&self) -> Vec<Gap> {
        with_poses(&self.bodies, LEAST_POSES)
    }
}

impl Scene {
    /// All gaps between consecutive times of all bodies' observations, in order of time.
    pub(crate) fn all_gaps(&self) -> Vec<Gap> {
        with_poses(&self.bodies, 0)
    }
}

/// The gaps with `least` or more poses of each body on each side, in order of time.
pub(super) fn with_poses(bodies: &[DynamicBody], least: usize) -> Vec<Gap> {
    let times_s: Vec<Vec<f64>> = bodies
        .iter()
        .map(|body| body.observations.iter().map(|seen| seen.time_s).collect())
        .collect();
    gaps_between(&times_s, least)
}

/// The gaps of the bodies' poses at these times, each body's in order, with `least` or more of each
/// on each side.
pub(crate) fn gaps_between(times_s: &[Vec<f64>], least: usize) -> Vec<Gap> {
    let mut all: Vec<f64> = times_s.iter().flatten().copied().collect();
    all.sort_by(f64::total_cmp);
    let has_enough = |gap: &Gap| {
        times_s.iter().all(|body| {
            let before = body.partition_point(|time_s| *time_s < gap.midpoint_s());
            before >= least && body.len() - before >= least
        })
    };
    let gaps = all.windows(2).map(|pair| Gap { start_s: pair[0], end_s: pair[1] });
    gaps.filter(|gap| gap.end_s - gap.start_s >= SAME_TIME_S).filter(has_enough).collect()
}

/// How many of the body's poses are before the gap.
pub(super) fn poses_before(body: &DynamicBody, gap: &Gap) -> usize {
    body.observations.partition_point(|seen| seen.time_s < gap.midpoint_s())
}

/// Checks that the collision can be somewhere.
pub(super) fn check(bodies: &[DynamicBody]) -> Result<()> {
    let needed = 2 * LEAST_POSES;
    for body in bodies {
        let poses = body.observations.len();
        if poses < needed {
            let problem =
                format!("body {} has {}", quoted(&body.name), counted(poses, "observation"));
            return Err(Error::invalid("bodies", problem).mend(format!(
                "annotate {LEAST_POSES} or more poses before and {LEAST_POSES} or more after the \
                 collision"
            )));
        }
    }
    if !with_poses(bodies, LEAST_POSES).is_empty() {
        return Ok(());
    }
    let spans: Vec<_> = bodies
        .iter()
        .map(|body| {
            let (first, last) = (body.observations.first(), body.observations.last());
            let time = |seen: Option<&super::Observation>| seen.map_or(0.0, |seen| seen.time_s);
            format!("{} from {} s to {} s", quoted(&body.name), time(first), time(last))
        })
        .collect();
    let problem = format!(
        "no moment has {LEAST_POSES} poses of each body before and after it: {}",
        spans.join(", ")
    );
    Err(Error::invalid("bodies", problem)
        .mend("annotate both bodies on both sides of the collision; check the time stamps"))
}
