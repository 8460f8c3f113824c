//! A body's motion: a flight, one impulse, a flight.

use std::sync::Arc;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::instant::Instant;
use super::model::Model;
use super::observe::Pose;
use crate::Result;
use crate::rigid_body::quaternion::to_wxyz;
use crate::rigid_body::{RigidBody, rotate_freely, turning_bound_rad};

/// One body's motion at any time. Without effects it is exact: a parabola and a free rotation on
/// either side of the collision. With effects it is integrated.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// When the bodies collide, in s.
    pub collision_time_s: f64,
    /// The stated gravity's acceleration in the world, in m/s².
    /// Effects may change it.
    pub gravity_in_world: Vector3<f64>,
    /// The body at the collision, just before the impulse.
    pub before: RigidBody,
    /// The body at the collision, just after the impulse.
    pub after: RigidBody,
    pub(super) forced: Option<Forced>,
}

/// A body that effects act on.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Forced {
    pub model: Arc<Model>,
    /// Among the dynamic bodies.
    pub index: usize,
}

impl Motion {
    /// The body at `time_s`; at the collision itself, just after it.
    ///
    /// Its orientation is within 1e-9 rad of the exact one for the first 20 rad that it turns. With
    /// effects the answer is NaN where the spin is too fast to be integrated.
    pub fn at(&self, time_s: f64) -> RigidBody {
        match &self.forced {
            None => self.free(time_s),
            Some(Forced { model, index }) => model
                .state(*index, &self.before, time_s)
                .unwrap_or_else(|_| undefined(&self.before)),
        }
    }

    /// The poses that are annotated at `instants`.
    pub(super) fn seen(&self, instants: &[Instant]) -> Result<Vec<Pose>> {
        let stamps_s = instants.iter().map(|instant| instant.time_s);
        if let Some(Forced { model, index }) = &self.forced {
            return model.seen(*index, &stamps_s.collect::<Vec<_>>());
        }
        let pose = |time_s| {
            let body = self.free(time_s);
            Pose {
                position: body.position_in_world.into(),
                orientation: to_wxyz(&body.world_from_body),
            }
        };
        Ok(stamps_s.map(pose).collect())
    }

    fn free(&self, time_s: f64) -> RigidBody {
        let since_s = time_s - self.collision_time_s;
        let start = self.start(time_s);
        let gained = self.gravity_in_world * since_s;
        RigidBody {
            position_in_world: start.position_in_world
                + (start.velocity_in_world + gained / 2.0) * since_s,
            velocity_in_world: start.velocity_in_world + gained,
            world_from_body: rotate_freely(
                &start.world_from_body,
                &start.principal_inertia,
                &start.angular_momentum_in_world,
                since_s,
            ),
            ..*start
        }
    }

    /// A bound of the angle in rad that has to be integrated to reach `time_s`; what [`Motion::at`]
    /// costs goes with it.
    pub(super) fn integrated_angle_rad(&self, time_s: f64) -> f64 {
        let start = self.start(time_s);
        turning_bound_rad(
            &start.principal_inertia,
            &start.angular_momentum_in_world,
            time_s - self.collision_time_s,
        )
    }

    /// Without effects.
    fn start(&self, time_s: f64) -> &RigidBody {
        if time_s < self.collision_time_s { &self.before } else { &self.after }
    }
}

fn undefined(body: &RigidBody) -> RigidBody {
    let unknown = Vector3::repeat(f64::NAN);
    RigidBody {
        position_in_world: unknown,
        velocity_in_world: unknown,
        angular_momentum_in_world: unknown,
        world_from_body: UnitQuaternion::new_unchecked(Quaternion::from([f64::NAN; 4])),
        ..*body
    }
}
