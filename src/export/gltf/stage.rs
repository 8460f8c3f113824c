//! What doesn't move: the way up, and the plane.

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};
use serde_json::{Value, json};

use super::super::frames::{Film, tracks};
use crate::scene::StaticPlane;

/// The plane's reach beyond the bodies', as a factor.
const MARGIN: f64 = 1.25;

/// A square of the plane below all that happens.
pub(super) struct Ground {
    centre: Vector3<f64>,
    /// Half of its edge, m.
    pub(super) half_m: f64,
    normal: UnitVector3<f64>,
}

impl Ground {
    /// That of `plane` in `film`.
    pub(super) fn below(film: &Film, plane: &StaticPlane) -> Ground {
        let tracks = || film.motion.bodies.iter().flat_map(tracks);
        let feet = || {
            let positions = tracks().flat_map(|track| &track.positions).copied();
            positions.map(|position| foot(plane, position.into()))
        };
        let centre = feet().sum::<Vector3<f64>>() / feet().count().max(1) as f64;
        let reach_m = feet().map(|foot| (foot - centre).norm()).fold(0.0, f64::max);
        let sizes =
            film.scene.bodies().iter().map(|body| Vector3::from(body.shape.edges_m()).norm());
        let half_m = MARGIN * (reach_m + sizes.fold(0.0, f64::max));
        Ground { centre, half_m, normal: plane.normal_in_world }
    }

    /// Its node.
    pub(super) fn node(&self, name: &str, mesh: usize) -> Value {
        json!({
            "name": name, "mesh": mesh,
            "translation": <[f64; 3]>::from(self.centre),
            "rotation": xyzw(&turn(&Vector3::y(), &self.normal)),
        })
    }
}

/// The turn that takes the scene's `up` to glTF's, +y; as x, y, z, w.
pub(super) fn upright(up: &Vector3<f64>) -> [f64; 4] {
    xyzw(&turn(up, &Vector3::y()))
}

/// The point of the plane below `position`.
fn foot(plane: &StaticPlane, position: Vector3<f64>) -> Vector3<f64> {
    let normal = plane.normal_in_world;
    position - (normal.dot(&position) - plane.height_m) * normal.into_inner()
}

/// The shortest turn from one direction to another; of half turns that about x.
fn turn(from: &Vector3<f64>, to: &Vector3<f64>) -> UnitQuaternion<f64> {
    let half = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    UnitQuaternion::rotation_between(from, to).unwrap_or_else(half)
}

fn xyzw(q: &UnitQuaternion<f64>) -> [f64; 4] {
    [q.i, q.j, q.k, q.w]
}
