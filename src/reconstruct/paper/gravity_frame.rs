//! The frame that the paper computes in: y along gravity (its eq. 6 and 17 need b₁ > 0).

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

/// The rotation between the scene's world and the frame with y along gravity.
#[derive(Debug, Clone, Copy)]
pub(super) struct GravityFrame {
    gravity_from_world: UnitQuaternion<f64>,
}

impl GravityFrame {
    /// The frame for a scene whose `up_in_world` points against gravity.
    pub(super) fn new(up_in_world: &UnitVector3<f64>) -> Self {
        let down = -up_in_world.into_inner();
        // Opposite vectors have no shortest turn: half a turn about x is as good as any.
        let gravity_from_world = UnitQuaternion::rotation_between(&down, &Vector3::y())
            .unwrap_or_else(|| {
                UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
            });
        GravityFrame { gravity_from_world }
    }

    pub(super) fn vector_from_world(&self, v: &Vector3<f64>) -> [f64; 3] {
        (self.gravity_from_world * v).into()
    }

    pub(super) fn vector_to_world(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.gravity_from_world.inverse_transform_vector(&v)
    }

    pub(super) fn orientation_from_world(&self, q: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
        self.gravity_from_world * q
    }

    pub(super) fn orientation_to_world(&self, q: &UnitQuaternion<f64>) -> UnitQuaternion<f64> {
        self.gravity_from_world.inverse() * q
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_becomes_minus_y_for_any_up() {
        for up in [Vector3::y(), -Vector3::y(), Vector3::z(), Vector3::new(-0.3, 0.5, 0.2)] {
            let up = UnitVector3::new_normalize(up);
            let frame = GravityFrame::new(&up);
            let turned = Vector3::from(frame.vector_from_world(&up));
            assert!((turned + Vector3::y()).norm() < 1e-14, "{up:?} became {turned:?}");
            assert!((frame.vector_to_world(turned) - up.into_inner()).norm() < 1e-14);
        }
    }
}
