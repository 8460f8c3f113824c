//! The order of a body's poses: by time, each time once.

use super::bounds::{LONGEST_SPAN_S, SAME_TIME_S};
use super::{Observation, Warning};
use crate::words::{quoted, rounded};
use crate::{Error, Result};

/// Orientations nearer than this, in rad, are the same annotation: the rounding of its text.
const SAME_ORIENTATION_RAD: f64 = 1e-6;

/// The observations at `place` in order of time, the repeated ones merged.
///
/// # Errors
/// One time has two different poses, or the times span too much.
pub(super) fn sorted(
    name: &str,
    place: &str,
    observations: Vec<Observation>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Observation>> {
    let mut numbered: Vec<_> = observations.into_iter().enumerate().collect();
    let unordered = numbered.windows(2).find(|pair| pair[1].1.time_s < pair[0].1.time_s);
    if let Some(pair) = unordered {
        warnings.push(Warning {
            text: format!(
                "body {}: {place}[{}] is earlier than the one before it; the poses were sorted",
                quoted(name),
                pair[1].0
            ),
            mend: "check the frame numbers or times for slips".into(),
        });
        numbered.sort_by(|one, other| one.1.time_s.total_cmp(&other.1.time_s));
    }
    let mut kept: Vec<(usize, Observation)> = Vec::with_capacity(numbered.len());
    let mut repeated = Vec::new();
    for (index, observation) in numbered {
        match kept.last() {
            Some((first, last)) if observation.time_s - last.time_s < SAME_TIME_S => {
                if !is_same_pose(last, &observation) {
                    let at = format!("{place}[{index}]");
                    let time = rounded(observation.time_s);
                    let problem =
                        format!("has the time of {place}[{first}], {time} s, but another pose");
                    return Err(Error::invalid(at, problem).mend("keep the right one of the two"));
                }
                repeated.push(index);
            }
            _ => kept.push((index, observation)),
        }
    }
    if let Some(index) = repeated.first() {
        warnings.push(Warning {
            text: format!(
                "body {}: {place}[{index}] repeats a pose ({} in all); each was kept once",
                quoted(name),
                repeated.len()
            ),
            mend: "remove the repetitions".into(),
        });
    }
    if let (Some(first), Some(last)) = (kept.first(), kept.last()) {
        let span = last.1.time_s - first.1.time_s;
        if span > LONGEST_SPAN_S {
            let problem = format!("span {span:.6e} s, more than a day");
            return Err(Error::invalid(place, problem)
                .mend("check `fps` and the times; keep the poses around the collision"));
        }
    }
    Ok(kept.into_iter().map(|(_, observation)| observation).collect())
}

fn is_same_pose(one: &Observation, other: &Observation) -> bool {
    let same_orientation = match (one.world_from_body, other.world_from_body) {
        (Some(q), Some(r)) => q.angle_to(&r) < SAME_ORIENTATION_RAD,
        (None, None) => true,
        _ => false,
    };
    one.position_in_world == other.position_in_world
        && same_orientation
        && one.noise_scale == other.noise_scale
}
