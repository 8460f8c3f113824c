//! The way of each body by the numbers in a result: from its state at the collision, outwards.

use nalgebra::{UnitQuaternion, Vector3};

use super::Segment;
use crate::reconstruct::BodyResult;
use crate::rigid_body::quaternion::from_wxyz;
use crate::rigid_body::{RigidBody, omega_in_world, rotate_freely, turning_bound_rad};
use crate::scene::{Observation, Shape};
use crate::{Error, ErrorKind, Reconstruction, Result, Scene};

/// Some second of work; no annotator follows a body through so many turns.
const MOST_TURNING_RAD: f64 = 1e5;

/// Where the model has a body when a pose of it was annotated, and how it moves there.
pub(super) struct Prediction {
    pub(super) position_in_world: Vector3<f64>,
    pub(super) velocity_in_world: Vector3<f64>,
    /// `None` where the result doesn't tell the spin.
    pub(super) rotation: Option<PredictedRotation>,
}

/// How the model has a body turned.
#[derive(Clone, Copy)]
pub(super) struct PredictedRotation {
    pub(super) world_from_body: UnitQuaternion<f64>,
    pub(super) omega_in_world: Vector3<f64>,
}

/// Where the motion in `result` has each body of `scene` at each of its poses, in their order;
/// `None` without a collision time to fly from. No other place knows how bodies fly.
///
/// # Errors
/// A body turns so often that following it would seem to hang.
pub(super) fn predictions(
    scene: &Scene,
    result: &Reconstruction,
) -> Result<Option<Vec<Vec<Prediction>>>> {
    let Some(collision_time_s) = result.collision_time.value else { return Ok(None) };
    let scenes_own = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
    let gravity_in_world = result.gravity.map_or(scenes_own, Vector3::from);
    let bodies = scene.bodies().iter().zip(&result.bodies).enumerate();
    let flown = bodies.map(|(index, (body, at_collision))| {
        let split = body.observations.partition_point(|pose| pose.time_s < collision_time_s);
        let (before, after) = body.observations.split_at(split);
        let mut all = Vec::new();
        for (segment, poses) in [(Segment::Before, before), (Segment::After, after)] {
            let flight =
                Flight::new(at_collision, &body.shape, segment, collision_time_s, gravity_in_world);
            let side = flight.predictions(poses);
            all.extend(side.map_err(|error| error.at(format!("bodies[{index}]")))?);
        }
        Ok(all)
    });
    flown.collect::<Result<_>>().map(Some)
}

/// A body at the collision, and how it flies from there.
struct Flight {
    collision_time_s: f64,
    gravity_in_world: Vector3<f64>,
    position_in_world: Vector3<f64>,
    velocity_in_world: Vector3<f64>,
    rotation: Option<Rotation>,
}

/// How a body of unit mass turns without a torque.
struct Rotation {
    world_from_body: UnitQuaternion<f64>,
    inertia: Vector3<f64>,
    k_in_world: Vector3<f64>,
}

impl Flight {
    /// The flight of `body`, which has this `shape`, in `segment`.
    fn new(
        body: &BodyResult,
        shape: &Shape,
        segment: Segment,
        collision_time_s: f64,
        gravity_in_world: Vector3<f64>,
    ) -> Flight {
        let (velocity, omega) = match segment {
            Segment::Before => (body.velocity_before, body.angular_velocity_before),
            Segment::After => (body.velocity_after, body.angular_velocity_after),
        };
        let rotation = body.orientation.zip(omega).map(|(orientation, omega)| {
            let world_from_body = from_wxyz(orientation);
            let solid = RigidBody { world_from_body, ..RigidBody::solid(shape, 1.0) };
            Rotation {
                world_from_body,
                inertia: solid.principal_inertia,
                k_in_world: solid.spinning(&omega.into()).angular_momentum_in_world,
            }
        });
        Flight {
            collision_time_s,
            gravity_in_world,
            position_in_world: body.position.into(),
            velocity_in_world: velocity.into(),
            rotation,
        }
    }

    /// Where the model has the body at each of `poses`, which are in order of time, on one side of
    /// the collision.
    fn predictions(&self, poses: &[Observation]) -> Result<Vec<Prediction>> {
        let rotations = match &self.rotation {
            Some(rotation) => rotation.at(self.collision_time_s, poses)?,
            None => vec![None; poses.len()],
        };
        let predictions = poses.iter().zip(rotations).map(|(pose, rotation)| {
            let t = pose.time_s - self.collision_time_s;
            let (v, g) = (self.velocity_in_world, self.gravity_in_world);
            Prediction {
                position_in_world: self.position_in_world + t * v + 0.5 * t * t * g,
                velocity_in_world: v + t * g,
                rotation,
            }
        });
        Ok(predictions.collect())
    }
}

impl Rotation {
    /// From pose to pose outwards from the collision, so that the work goes with the angle turned and
    /// not with the number of poses times it.
    fn at(
        &self,
        collision_time_s: f64,
        poses: &[Observation],
    ) -> Result<Vec<Option<PredictedRotation>>> {
        let farthest_s =
            poses.iter().map(|pose| (pose.time_s - collision_time_s).abs()).fold(0.0, f64::max);
        let turning_rad = turning_bound_rad(&self.inertia, &self.k_in_world, farthest_s);
        if turning_rad.is_nan() || turning_rad > MOST_TURNING_RAD {
            let problem = format!("turns {turning_rad:.0e} rad until the farthest pose");
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("check the spin, in rad/s; no flight turns so often"));
        }
        let mut outwards: Vec<usize> = (0..poses.len()).collect();
        let away_s = |index: &usize| (poses[*index].time_s - collision_time_s).abs();
        outwards.sort_by(|a, b| away_s(a).total_cmp(&away_s(b)));
        let mut found = vec![None; poses.len()];
        let (mut time_s, mut orientation) = (collision_time_s, self.world_from_body);
        for index in outwards {
            let duration_s = poses[index].time_s - time_s;
            orientation = rotate_freely(&orientation, &self.inertia, &self.k_in_world, duration_s);
            time_s = poses[index].time_s;
            found[index] = Some(PredictedRotation {
                world_from_body: orientation,
                omega_in_world: omega_in_world(&orientation, &self.inertia, &self.k_in_world),
            });
        }
        Ok(found)
    }
}
