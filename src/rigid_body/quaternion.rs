//! Unit quaternions as four numbers, in the one order of all files: w, x, y, z.

use nalgebra::{Quaternion, UnitQuaternion};

/// `[w, x, y, z]` of a quaternion.
pub(crate) fn to_wxyz(q: &UnitQuaternion<f64>) -> [f64; 4] {
    [q.w, q.i, q.j, q.k]
}

/// The quaternion of `[w, x, y, z]`, whose length is 1 already.
pub(crate) fn from_wxyz([w, x, y, z]: [f64; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An asymmetric rotation would come back wrong from any mix-up of the order.
    #[test]
    fn quaternions_survive_the_bridge_order() {
        let q = UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9);
        let wxyz = to_wxyz(&q);
        assert_eq!(wxyz[0], q.scalar());
        assert!(from_wxyz(wxyz).angle_to(&q) < 1e-15);
    }
}
