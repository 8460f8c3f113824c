//! Whether bodies keep apart but for their collision.

use nalgebra::Vector3;

use super::check::{Partner, Setup, setup};
use super::{Motion, SimulationSpec, motions};
use crate::rigid_body::RigidBody;
use crate::scene::Shape;

/// How deep bodies may be in each other: rounding, and what an edge on an edge hides.
const LARGEST_OVERLAP_M: f64 = 1e-3;

/// Whether `spec` is valid and its bodies keep apart at every instant at which a is seen.
pub(super) fn is_clear(spec: &SimulationSpec) -> bool {
    let Ok(setup) = setup(spec) else { return false };
    let Ok(motions) = motions(spec, &setup) else { return false };
    setup
        .stage
        .a
        .instants
        .iter()
        .all(|instant| overlap_m(&setup, &motions, instant.time_s) <= LARGEST_OVERLAP_M)
}

/// Half the edges of the smallest box around `shape`, along the body's axes, in m.
pub(super) fn half_extent(shape: &Shape) -> Vector3<f64> {
    match *shape {
        Shape::Box { size } => Vector3::from(size) / 2.0,
        Shape::Sphere { radius } => Vector3::repeat(radius),
    }
}

/// How deep a corner of one body (or the rim of a ball) is within the other, in m.
fn overlap_m(setup: &Setup, motions: &[Motion], time_s: f64) -> f64 {
    let states: Vec<RigidBody> = motions.iter().map(|motion| motion.at(time_s)).collect();
    let stage = &setup.stage;
    match &stage.partner {
        Partner::Plane(plane) => {
            let height_m = |point: &Vector3<f64>| plane.normal_in_world.dot(point) - plane.height_m;
            let (points, rim_m) = outermost(&stage.a.shape, &states[0]);
            points.iter().map(|point| rim_m - height_m(point)).fold(f64::MIN, f64::max)
        }
        Partner::Body(b) => {
            let of_a = (&stage.a.shape, &states[0]);
            let of_b = (&b.shape, &states[1]);
            depth_within_m(of_a, of_b).max(depth_within_m(of_b, of_a))
        }
    }
}

fn depth_within_m(
    (guest, guest_state): (&Shape, &RigidBody),
    (host, host_state): (&Shape, &RigidBody),
) -> f64 {
    let (points, rim_m) = outermost(guest, guest_state);
    let depth_m = |point: &Vector3<f64>| {
        let lever = point - host_state.position_in_world;
        let in_host = host_state.world_from_body.inverse_transform_vector(&lever);
        match *host {
            Shape::Box { .. } => (half_extent(host) - in_host.abs()).min(),
            Shape::Sphere { radius } => radius - in_host.norm(),
        }
    };
    points.iter().map(|point| rim_m + depth_m(point)).fold(f64::MIN, f64::max)
}

/// The points that span a body, in the world, and how far its matter reaches around each, in m:
/// a box's corners, a ball's centre.
fn outermost(shape: &Shape, state: &RigidBody) -> (Vec<Vector3<f64>>, f64) {
    match *shape {
        Shape::Sphere { radius } => (vec![state.position_in_world], radius),
        Shape::Box { .. } => {
            let half = half_extent(shape);
            let corner = |index: u32| {
                let sign = |axis: u32| if index >> axis & 1 == 0 { -1.0 } else { 1.0 };
                let in_body = half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)));
                state.position_in_world + state.world_from_body.transform_vector(&in_body)
            };
            ((0..8).map(corner).collect(), 0.0)
        }
    }
}
