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
