//! The bodies just before and just after the collision, and what follows from them.

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

use super::BodyResult;
use crate::Scene;
use crate::rigid_body::quaternion::to_wxyz;
use crate::rigid_body::{Contact, RigidBody};

pub(super) const NO_IMPULSE: &str = "the jumps in velocity don't stand out of the noise";
const NO_PARTNER: &str = "a single body without a plane: what it hit is not known";
const NO_APPROACH: &str = "the touching points had no normal velocity before";
const NO_SPIN: &str = "too few orientations are annotated to tell the rotation";
const NO_SURFACE: &str = "it needs the spins, and too few orientations are annotated";

/// A body just before and just after the collision, in the world.
#[derive(Debug, Clone, Copy)]
pub(super) struct States {
    pub(super) before: RigidBody,
    pub(super) after: RigidBody,
    /// After what the contact alone does: a third party's impulse is no part of the restitution.
    pub(super) contact_after: RigidBody,
    /// Whether the poses tell the spin.
    pub(super) spin_before_known: bool,
    pub(super) spin_after_known: bool,
    pub(super) is_ball: bool,
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

/// Where and along which normal the bodies touched; `None` without an impulse.
pub(super) fn contact(
    scene: &Scene,
    states: &[States],
    point_in_world: Vector3<f64>,
    impulse: &Vector3<f64>,
) -> Option<Contact> {
    let normal = match scene.plane() {
        Some(plane) => Some(plane.normal_in_world),
        None => UnitVector3::try_new(*impulse, f64::MIN_POSITIVE),
    };
    normal.map(|normal| Contact {
        point_in_world: settle_on_line(scene, states, point_in_world, impulse),
        normal_in_world: normal,
    })
}

/// The restitution, or why there is none.
pub(super) fn restitution(
    scene: &Scene,
    contact: Option<Contact>,
    states: &[States],
) -> Result<f64, &'static str> {
    if states.len() == 1 && scene.plane().is_none() {
        return Err(NO_PARTNER);
    }
    let contact = contact.ok_or(NO_IMPULSE)?;
    if !states.iter().all(States::surface_velocity_known) {
        return Err(NO_SURFACE);
    }
    let partner = states.get(1);
    let value = contact.restitution(
        (&states[0].before, partner.map(|b| &b.before)),
        (&states[0].contact_after, partner.map(|b| &b.contact_after)),
    );
    if value.is_finite() { Ok(value) } else { Err(NO_APPROACH) }
}

/// A body's part of the result; what its poses don't tell is null.
pub(super) fn body_result(name: &str, states: &States) -> BodyResult {
    let States { before, after, spin_before_known, spin_after_known, .. } = states;
    let if_known = |known: &bool, v: Vector3<f64>| known.then(|| v.into());
    let pose_known = *spin_before_known || *spin_after_known;
    // A solver's steps leave its length at 1 but for rounding, which adds up.
    let orientation = || UnitQuaternion::new_normalize(before.world_from_body.into_inner());
    BodyResult {
        name: name.to_string(),
        position: before.position_in_world.into(),
        orientation: pose_known.then(|| to_wxyz(&orientation())),
        velocity_before: before.velocity_in_world.into(),
        velocity_after: after.velocity_in_world.into(),
        angular_velocity_before: if_known(spin_before_known, before.omega_in_world()),
        angular_velocity_after: if_known(spin_after_known, after.omega_in_world()),
        angular_momentum_before: if_known(spin_before_known, before.angular_momentum_in_world),
        angular_momentum_after: if_known(spin_after_known, after.angular_momentum_in_world),
        reason: (!(*spin_before_known && *spin_after_known)).then(|| NO_SPIN.to_string()),
    }
}

/// The contact point x_c on its line of action x + s J, along which nothing changes: where that
/// line meets the plane, or nearest to the middle between the centres.
fn settle_on_line(
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
