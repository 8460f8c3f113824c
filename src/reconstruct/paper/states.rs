//! The bodies just before and just after the collision, from the solver's unknowns.

use super::super::collision::States;
use super::internal::InternalScene;
use super::phases::Solved;
use super::solver_error;
use crate::bridge::paper::ffi::{self, PaperBody, PaperFlight};
use crate::rigid_body::RigidBody;
use crate::rigid_body::quaternion::from_wxyz;
use crate::scene::Shape;
use crate::{Result, Scene};

/// The states of all dynamic bodies, the reference body first.
pub(super) fn states(
    scene: &Scene,
    internal: &InternalScene,
    solved: &Solved,
) -> Result<Vec<States>> {
    (0..scene.bodies().len()).map(|index| body_states(scene, internal, solved, index)).collect()
}

fn body_states(
    scene: &Scene,
    internal: &InternalScene,
    solved: &Solved,
    index: usize,
) -> Result<States> {
    let unknown = &solved.unknowns.bodies[index];
    let body = &scene.bodies()[index];
    let mass = if index == 0 { 1.0 } else { solved.unknowns.mass_ratio };
    let in_world = |v: [f64; 3]| internal.frame.vector_to_world(v.into());
    let orientation = from_wxyz(unknown.orientation);
    let pose = RigidBody {
        position_in_world: in_world(unknown.position),
        world_from_body: internal.frame.orientation_to_world(&orientation),
        ..RigidBody::solid(&body.shape, mass)
    };
    let velocities = ffi::paper_collision_velocities(&internal.paper, &solved.unknowns, index)
        .map_err(solver_error)?;
    let moving = |velocity: [f64; 3], flight: &PaperFlight| RigidBody {
        velocity_in_world: in_world(velocity),
        angular_momentum_in_world: in_world(flight.angular_momentum),
        ..pose
    };
    let (seen_before, seen_after) = seen(&internal.paper.bodies[index], solved.collision_frames);
    let after = moving(velocities.after, &unknown.after);
    Ok(States {
        before: moving(velocities.before, &unknown.before),
        after,
        contact_after: after,
        // Two orientations tell a flight's spin; one does where the other side tells the pose at
        // the collision.
        spin_before_known: seen_before >= 2 || (seen_before == 1 && seen_after >= 2),
        spin_after_known: seen_after >= 2 || (seen_after == 1 && seen_before >= 2),
        is_ball: matches!(body.shape, Shape::Sphere { .. }),
    })
}

/// How many orientations are annotated before and after.
fn seen(body: &PaperBody, collision_frames: f64) -> (usize, usize) {
    let annotated = body.observations.iter().filter(|o| o.has_orientation);
    let (before, after): (Vec<_>, Vec<_>) =
        annotated.partition(|o| o.time_frames < collision_frames);
    (before.len(), after.len())
}
