//! The way of each body by the numbers in a result: from its state at the collision, outwards.

use nalgebra::{UnitQuaternion, Vector3};

use super::Segment;
use crate::reconstruct::refined::{FlownPose, flown};
use crate::rigid_body::omega_in_world;
use crate::rigid_body::quaternion::from_wxyz;
use crate::{Reconstruction, Result, Scene};

/// Where the model has a body seen when a pose of it was annotated, and how it moves there.
pub(super) struct Prediction {
    /// The side of the collision, by the model's time.
    pub(super) segment: Segment,
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
/// An effect or gravity of the result can't be this scene's, or a body can't be followed.
pub(super) fn predictions(
    scene: &Scene,
    result: &Reconstruction,
) -> Result<Option<Vec<Vec<Prediction>>>> {
    let Some(collision_time_s) = result.collision_time.value else { return Ok(None) };
    let bodies = flown(scene, result, collision_time_s)?;
    Ok(Some(bodies.iter().map(|poses| poses.iter().map(prediction).collect()).collect()))
}

fn prediction(pose: &FlownPose) -> Prediction {
    let state = &pose.state;
    let rotation = pose.inertia_per_mass.map(|inertia| PredictedRotation {
        world_from_body: from_wxyz(state.seen_orientation),
        omega_in_world: omega_in_world(&from_wxyz(state.orientation), &inertia, &state.spin.into()),
    });
    Prediction {
        segment: if pose.is_after { Segment::After } else { Segment::Before },
        position_in_world: state.seen_position.into(),
        velocity_in_world: state.velocity.into(),
        rotation,
    }
}

/// The number of the first pose after the collision among a body's.
pub(super) fn first_after(poses: &[Prediction]) -> usize {
    poses.partition_point(|pose| pose.segment == Segment::Before)
}
