//! What is allowed in a scene but often a mistake: too few poses, odd steps, fast spins.

use nalgebra::UnitQuaternion;

use super::bounds::{FEW_POSES, LEAST_POSES};
use super::{DynamicBody, Scene, Shape, Warning, gaps, units};
use crate::words::{counted, quoted};

/// A turn beyond this between neighbouring poses, in degrees, might as well be the other way
/// round: three quarters of the half turn at which the two are alike.
const LARGE_TURN_DEG: f64 = 135.0;
/// Steps within this fraction of the median are equal: the rounding of times to milliseconds.
const EQUAL_STEP: f64 = 0.1;
/// The fraction of equal steps that makes a body's sampling regular.
const REGULAR: f64 = 0.8;
/// The paper leaves out twice the interval around the collision, and rounding adds a little.
const GAP_AT_COLLISION: f64 = 2.1;
/// A step of so many medians is long in any sampling.
const LONG_STEP: f64 = 4.0;

/// Looks for the usual mistakes; empty on a scene in good order. `collision_s`: when it is, if that is
/// known.
pub(super) fn look(scene: &Scene, collision_s: Option<f64>) -> Vec<Warning> {
    let mut warnings = Vec::new();
    warnings.extend(few_poses(scene));
    for body in scene.bodies() {
        warnings.extend(unseen_spin(scene, body));
        warnings.extend(large_turns(body));
        warnings.extend(uneven_steps(scene, body, collision_s));
    }
    warnings.extend(units::look(scene));
    warnings
}

fn few_poses(scene: &Scene) -> Option<Warning> {
    gaps::with_poses(scene.bodies(), FEW_POSES).is_empty().then(|| Warning {
        text: format!("fewer than {FEW_POSES} poses of a body before or after the collision"),
        mend: "annotate more poses, or trust the result less: nothing checks the fit".into(),
    })
}

/// A box whose orientations don't determine the spin on both sides of any gap. A ball's spin
/// isn't missed: without marks on it nobody sees it.
fn unseen_spin(scene: &Scene, body: &DynamicBody) -> Option<Warning> {
    let Shape::Box { .. } = body.shape else {
        return None;
    };
    let seen = body.observations.iter().filter(|seen| seen.world_from_body.is_some()).count();
    let is_determined = scene.gaps().iter().any(|gap| {
        let before = &body.observations[..gaps::poses_before(body, gap)];
        let before = before.iter().filter(|seen| seen.world_from_body.is_some()).count();
        before >= LEAST_POSES && seen - before >= LEAST_POSES
    });
    (!is_determined).then(|| Warning {
        text: format!(
            "body {}: a box with {seen} orientations; its spin before and after isn't determined",
            quoted(&body.name)
        ),
        mend: format!(
            "annotate the orientation of {LEAST_POSES} or more poses on each side, or make it a \
             sphere"
        ),
    })
}

/// A turn between two neighbouring poses, the short way.
struct Turn {
    start_s: f64,
    step_s: f64,
    angle: f64,
}

/// Between two poses a body may have turned the short way or the long way: the quaternions are
/// the same. Suspicious is a large turn, and a small one over a step in which the spin on both
/// sides of it would give more than half a turn.
fn large_turns(body: &DynamicBody) -> Option<Warning> {
    let turns = turns(body);
    let spin = |turn: &Turn| turn.angle / turn.step_s;
    let is_suspicious = |index: usize| {
        let turn = &turns[index];
        let neighbours = turns[index.saturating_sub(1)..index].iter().chain(turns.get(index + 1));
        // The slower neighbour: at the collision the spin jumps, and only one side is fast.
        let slowest = neighbours.map(spin).min_by(f64::total_cmp).unwrap_or(0.0);
        turn.angle.to_degrees() > LARGE_TURN_DEG || slowest * turn.step_s > std::f64::consts::PI
    };
    let suspicious: Vec<_> = (0..turns.len()).filter(|&index| is_suspicious(index)).collect();
    let first = &turns[*suspicious.first()?];
    Some(Warning {
        text: format!(
            "body {}: may turn by more than half a turn between poses: {:.0}° or {:.0}° from {:.4} s \
             to {:.4} s ({})",
            quoted(&body.name),
            first.angle.to_degrees(),
            360.0 - first.angle.to_degrees(),
            first.start_s,
            first.start_s + first.step_s,
            counted(suspicious.len(), "such step")
        ),
        mend: "annotate poses in between, or check these orientations".into(),
    })
}

fn turns(body: &DynamicBody) -> Vec<Turn> {
    let seen =
        body.observations.iter().filter_map(|seen| Some((seen.time_s, seen.world_from_body?)));
    let seen: Vec<(f64, UnitQuaternion<f64>)> = seen.collect();
    let turn = |pair: &[(f64, UnitQuaternion<f64>)]| Turn {
        start_s: pair[0].0,
        step_s: pair[1].0 - pair[0].0,
        angle: pair[0].1.angle_to(&pair[1].1),
    };
    seen.windows(2).map(turn).collect()
}

/// Sampling that is regular but for some steps, or a step much longer than the others. One
/// longer step is as it should be: the collision may hide a few frames, and as many as it likes where
/// it can be nowhere else.
fn uneven_steps(scene: &Scene, body: &DynamicBody, collision_s: Option<f64>) -> Option<Warning> {
    let times: Vec<f64> = body.observations.iter().map(|seen| seen.time_s).collect();
    let only_gap = match scene.gaps().as_slice() {
        [only] => Some(only.midpoint_s()),
        _ => None,
    };
    let collision_s = collision_s.or(only_gap);
    let collides_in =
        |step: &[f64]| collision_s.is_some_and(|time_s| (step[0]..step[1]).contains(&time_s));
    let between: Vec<&[f64]> = times.windows(2).filter(|step| !collides_in(step)).collect();
    let steps: Vec<f64> = between.iter().map(|step| step[1] - step[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let median = *sorted.get(sorted.len() / 2)?;
    let is_odd = |step: f64| (step / median - 1.0).abs() > EQUAL_STEP;
    let odd: Vec<usize> = (0..steps.len()).filter(|&index| is_odd(steps[index])).collect();
    let longest = *sorted.last()? / median;
    let is_regular = (odd.len() as f64) <= (1.0 - REGULAR) * steps.len() as f64;
    let is_gap_at_collision = odd.len() == 1 && (1.0..=GAP_AT_COLLISION).contains(&longest);
    let slips = is_regular && !odd.is_empty() && !is_gap_at_collision;
    if !slips && longest <= LONG_STEP {
        return None;
    }
    let deviation = |index: &usize| (steps[*index] / median).ln().abs();
    let worst = *odd.iter().max_by(|one, other| deviation(one).total_cmp(&deviation(other)))?;
    Some(Warning {
        text: format!(
            "body {}: uneven steps: mostly {median:.6} s, but {:.6} s from {:.6} s to {:.6} s \
             ({})",
            quoted(&body.name),
            steps[worst],
            between[worst][0],
            between[worst][1],
            counted(odd.len(), "such step")
        ),
        mend: "check the frame numbers or times there; if frames are only missing, all is well"
            .into(),
    })
}
