//! The bodies just before and just after the collision, from the solver's unknowns.

use nalgebra::Vector3;

use super::internal::InternalScene;
use super::phases::Solved;
use super::solver_error;
use crate::bridge::paper::ffi::{self, PaperBody, PaperFlight};
use crate::rigid_body::RigidBody;
use crate::rigid_body::quaternion::from_wxyz;
use crate::scene::Shape;
use crate::{Result, Scene};

/// A body just before and just after the collision, in the world.
pub(super) struct States {
    pub(super) before: RigidBody,
    pub(super) after: RigidBody,
    /// Whether the poses tell the spin.
    pub(super) spin_before_known: bool,
    pub(super) spin_after_known: bool,
    is_ball: bool,
}

impl States {
    /// How much the velocity jumps, in m/s.
    pub(super) fn jump_m_s(&self) -> f64 {
        (self.after.velocity_in_world - self.before.velocity_in_world).norm()
    }

    /// Whether the velocity of a point on the surface is known along an impulse there: a smooth
    /// ball's spin plays no part in it, since the impulse passes through its centre.
    pub(super) fn surface_velocity_known(&self) -> bool {
        self.is_ball || (self.spin_before_known && self.spin_after_known)
    }
}

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
    Ok(States {
        before: moving(velocities.before, &unknown.before),
        after: moving(velocities.after, &unknown.after),
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

/// The contact point x_c on its line of action x + s J, along which nothing changes: where that
/// line meets the plane, or nearest to the middle between the centres.
pub(super) fn settle_on_line(
    scene: &Scene,
    states: &[States],
    point: Vector3<f64>,
    impulse: &Vector3<f64>,
) -> Vector3<f64> {
    let along = match scene.plane() {
        Some(plane) => {
            let towards = plane.normal_in_world.dot(impulse);
            (plane.height_m - plane.normal_in_world.dot(&point)) / towards
        }
        None => {
            let centres = states.iter().map(|states| states.before.position_in_world);
            let middle = centres.sum::<Vector3<f64>>() / states.len() as f64;
            impulse.dot(&(middle - point)) / impulse.norm_squared()
        }
    };
    if along.is_finite() { point + along * impulse } else { point }
}
