//! Where each unknown's tangent stands in the information matrix, and steps along it.

use nalgebra::{UnitQuaternion, Vector3};

use super::model::{any_spin, has_plane};
use crate::bridge::refined::ffi::{RefinedScene, RefinedUnknowns};
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};

/// The order that the bridge states.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// Of each body: where it starts, and whether it has a spin.
    bodies: Vec<(usize, bool)>,
    pub(super) time: usize,
    pub(super) tilt: Option<usize>,
    pub(super) impulse: usize,
    /// Along the plane's normal only.
    normal: Option<Vector3<f64>>,
    pub(super) contact: Option<usize>,
    pub(super) log_mass: Option<usize>,
    /// Of each scalar of the effects' parameters; `None` where it is held.
    pub(super) parameters: Vec<Option<usize>>,
    pub(super) size: usize,
}

impl Layout {
    pub(super) fn new(scene: &RefinedScene) -> Self {
        let mut size = 0;
        let mut place = |count: usize| {
            size += count;
            size - count
        };
        let bodies = scene
            .bodies
            .iter()
            .map(|body| (place(if body.has_spin { 12 } else { 6 }), body.has_spin))
            .collect();
        let time = place(1);
        let tilt = (scene.gravity_m_s2 > 0.0).then(|| place(2));
        let normal = has_plane(scene).then(|| Vector3::from(scene.plane_normal));
        let impulse = place(if normal.is_some() { 1 } else { 3 });
        let contact = any_spin(scene).then(|| place(2));
        let log_mass = (scene.bodies.len() == 2).then(|| place(1));
        let parameters =
            scene.parameters.iter().map(|rule| (!rule.held).then(|| place(1))).collect();
        Layout { bodies, time, tilt, impulse, normal, contact, log_mass, parameters, size }
    }

    /// How many numbers the impulse has.
    pub(super) fn impulse_size(&self) -> usize {
        if self.normal.is_some() { 1 } else { 3 }
    }

    /// The unknowns after a step of `length` along coordinate `index`.
    pub(super) fn stepped(
        &self,
        unknowns: &RefinedUnknowns,
        index: usize,
        length: f64,
    ) -> RefinedUnknowns {
        let mut moved = unknowns.clone();
        for (&(start, has_spin), motion) in self.bodies.iter().zip(&mut moved.bodies) {
            match index.checked_sub(start) {
                Some(i @ 0..3) => motion.position[i] += length,
                Some(i @ 3..6) => motion.velocity_before[i - 3] += length,
                Some(i @ 6..9) if has_spin => motion.spin_before[i - 6] += length,
                Some(i @ 9..12) if has_spin => {
                    let turn = UnitQuaternion::new(Vector3::ith(i - 9, length));
                    motion.orientation = to_wxyz(&(turn * from_wxyz(motion.orientation)));
                }
                _ => continue,
            }
            return moved;
        }
        if index == self.time {
            moved.collision_time_s += length;
        }
        if let Some(i @ 0..2) = self.tilt.and_then(|tilt| index.checked_sub(tilt)) {
            moved.tilt[i] += length;
        }
        match (index.checked_sub(self.impulse), self.normal) {
            (Some(0), Some(normal)) => add(&mut moved.impulse, &(length * normal)),
            (Some(i @ 0..3), None) => moved.impulse[i] += length,
            _ => {}
        }
        if let Some(i @ 0..2) = self.contact.and_then(|contact| index.checked_sub(contact)) {
            let along = Vector3::from(moved.contact_basis[i]);
            add(&mut moved.contact_point, &(length * along));
        }
        if self.log_mass == Some(index) {
            moved.log_mass_ratio += length;
        }
        if let Some(number) = self.parameters.iter().position(|place| *place == Some(index)) {
            moved.parameters[number] += length;
        }
        moved
    }
}

fn add(to: &mut [f64; 3], step: &Vector3<f64>) {
    *to = (Vector3::from(*to) + step).into();
}
