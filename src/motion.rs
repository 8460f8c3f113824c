//! A result's motion, sampled in time: for pictures, films and tables.

use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effect::Scan;
use crate::reconstruct::refined::{FlownPose, flown, model_times};
use crate::rigid_body::omega_in_world;
use crate::rigid_body::quaternion::from_wxyz;
use crate::{Reconstruction, Result, Scene};

/// As many samples a body, whatever the film's length.
const MOST_SAMPLES: f64 = 20_000.0;

/// How the bodies move by a result, from each one's first pose to its last, as an annotator would see
/// it: by the film's clock and scale, and without single wrong annotations.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Motion {
    /// t_c in s.
    pub collision_time: f64,
    /// The dynamic bodies, the reference body first.
    pub bodies: Vec<BodyMotion>,
}

/// A body's way.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodyMotion {
    /// The body's name.
    pub name: String,
    /// Ends at the collision, by the body's stamps.
    pub before: Track,
    /// Begins at the collision, by the body's stamps.
    pub after: Track,
}

/// A body's way on one side of the collision. SI units, world frame.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Track {
    /// s, by the body's stamps.
    pub times: Vec<f64>,
    /// The annotated point, m.
    pub positions: Vec<[f64; 3]>,
    /// Quaternions [w, x, y, z], body to world, without jumps of sign; null where the result doesn't
    /// tell the spin.
    pub orientations: Option<Vec<[f64; 4]>>,
    /// Of the centre of mass, m/s.
    pub velocities: Vec<[f64; 3]>,
    /// rad/s; null where the result doesn't tell it.
    pub spins: Option<Vec<[f64; 3]>>,
}

/// Samples the motion in `result` of `scene`, at least `rate_hz` times a second; `None` where the
/// result has no collision time to fly from.
///
/// # Errors
/// The result's effects or gravity can't be the scene's, or its motion can't be followed.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let result = smash::reconstruct(&scene, &smash::Options::default())?;
/// let motion = smash::motion(&scene, &result, 60.0)?.expect("there is a collision time");
/// println!("{:?}", motion.bodies[0].before.positions.last());
/// # Ok::<(), smash::Error>(())
/// ```
pub fn motion(scene: &Scene, result: &Reconstruction, rate_hz: f64) -> Result<Option<Motion>> {
    sampled(scene, result, |first_s, last_s| between(first_s, last_s, rate_hz))
}

/// Samples the motion as [`motion`] does, at times of the caller's: `times` gives those from one time to
/// another, with both.
pub(crate) fn sampled(
    scene: &Scene,
    result: &Reconstruction,
    times: impl Fn(f64, f64) -> Vec<f64>,
) -> Result<Option<Motion>> {
    let Some(collision_time_s) = result.collision_time.value else { return Ok(None) };
    let result = without_wrong_poses(result)?;
    // By each body's own stamps, which an effect may have moved.
    let meetings = collision_stamps(scene, &result, collision_time_s)?;
    let stamps = |(index, meeting): (usize, &Meeting)| {
        let seen = scene.bodies()[index].observations.iter().map(|pose| pose.time_s);
        let first_s = seen.clone().fold(meeting.before_s, f64::min);
        let last_s = seen.fold(meeting.after_s, f64::max);
        let mut all = times(first_s, meeting.before_s);
        all.extend(times(meeting.after_s, last_s));
        all
    };
    let sampled = scene.sampled_at(meetings.iter().enumerate().map(stamps).collect());
    let flown = flown(&sampled, &result, collision_time_s)?;
    let bodies =
        sampled.bodies().iter().zip(flown).zip(&meetings).map(|((body, poses), meeting)| {
            let stamps = body.observations.iter().map(|sample| meeting.told(sample.time_s));
            let (after, before): (Vec<_>, Vec<_>) =
                stamps.zip(poses).partition(|(_, pose)| pose.is_after);
            let mut motion = BodyMotion {
                name: body.name.clone(),
                before: track(&before),
                after: track(&after),
            };
            motion.after.follow(&motion.before);
            motion
        });
    Ok(Some(Motion { collision_time: collision_time_s, bodies: bodies.collect() }))
}

/// When a body collides, by its own stamps.
struct Meeting {
    stamp_s: f64,
    /// The last number that is before it, and the first that isn't: their poses are those of the
    /// collision.
    before_s: f64,
    after_s: f64,
}

impl Meeting {
    /// The time that is told of a sample.
    fn told(&self, time_s: f64) -> f64 {
        if time_s == self.before_s || time_s == self.after_s { self.stamp_s } else { time_s }
    }
}

/// The stamp of each body at which its motion is that of the collision.
fn collision_stamps(
    scene: &Scene,
    result: &Reconstruction,
    collision_time_s: f64,
) -> Result<Vec<Meeting>> {
    /// A shift of the stamps is made up for at once, a stretched clock in a few rounds.
    const ROUNDS: usize = 8;
    let mut stamps = vec![collision_time_s; scene.bodies().len()];
    for _ in 0..ROUNDS {
        let sampled = scene.sampled_at(stamps.iter().map(|stamp| vec![*stamp]).collect());
        let times_s = model_times(&sampled, result, collision_time_s)?;
        for (stamp, time_s) in stamps.iter_mut().zip(times_s) {
            *stamp += collision_time_s - time_s;
        }
    }
    let meeting = |stamp_s: f64| match stamp_s == collision_time_s {
        true => Meeting { stamp_s, before_s: stamp_s.next_down(), after_s: stamp_s },
        // Away from the rounding of the stamp's own law.
        false => {
            let apart_s = 4.0 * (stamp_s.abs().max(collision_time_s.abs()) * f64::EPSILON);
            Meeting { stamp_s, before_s: stamp_s - apart_s, after_s: stamp_s + apart_s }
        }
    };
    Ok(stamps.into_iter().map(meeting).collect())
}

/// The result without effects of single poses, which move nothing.
fn without_wrong_poses(result: &Reconstruction) -> Result<Reconstruction> {
    let mut kept = result.clone();
    kept.effects.clear();
    for active in &result.effects {
        let parameters = &active.effect()?.parameters;
        if !parameters.iter().any(|p| p.scan == Some(Scan::ObservationTimes)) {
            kept.effects.push(active.clone());
        }
    }
    Ok(kept)
}

/// Evenly spaced times with both ends.
fn between(first_s: f64, last_s: f64, rate_hz: f64) -> Vec<f64> {
    let steps = ((last_s - first_s) * rate_hz).ceil().clamp(1.0, MOST_SAMPLES);
    // So written that both ends are exact.
    let time = |part: f64| (1.0 - part) * first_s + part * last_s;
    (0..=steps as usize).map(|step| time(step as f64 / steps)).collect()
}

fn track(poses: &[(f64, FlownPose)]) -> Track {
    let mut track = Track::default();
    for (stamp_s, pose) in poses {
        track.times.push(*stamp_s);
        track.positions.push(pose.state.seen_position);
        track.velocities.push(pose.state.velocity);
        let Some(inertia) = pose.inertia_per_mass else { continue };
        let world_from_body = from_wxyz(pose.state.orientation);
        let omega: Vector3<f64> =
            omega_in_world(&world_from_body, &inertia, &pose.state.spin.into());
        track.orientations.get_or_insert_default().push(pose.state.seen_orientation);
        track.spins.get_or_insert_default().push(omega.into());
    }
    track.follow(&Track::default());
    track
}

impl Track {
    /// Gives each quaternion, the same pose with either sign, that of its neighbour; the first one
    /// that of the last in `earlier`.
    fn follow(&mut self, earlier: &Track) {
        let mut last = earlier.orientations.as_ref().and_then(|all| all.last().copied());
        for pose in self.orientations.iter_mut().flatten() {
            let dot = |a: &[f64; 4]| a.iter().zip(pose.iter()).map(|(a, b)| a * b).sum::<f64>();
            if last.as_ref().is_some_and(|last| dot(last) < 0.0) {
                *pose = pose.map(|component| -component);
            }
            last = Some(*pose);
        }
    }
}
