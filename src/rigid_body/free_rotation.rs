//! Rotation of a body that no torque acts on: its angular momentum k stays, its spin needn't.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::omega_in_world;

/// The largest angle of one step, in rad. RKMK4's global error goes with its fourth power; at
/// this angle solids from cubes to rods are off by less than 1e-9 rad after 20 rad.
const LARGEST_STEP_RAD: f64 = 0.01;

/// The largest [`turning_bound_rad`] that [`rotate_freely`] integrates: some ten seconds of work.
pub const LARGEST_TURNING_RAD: f64 = 1e6;

/// The orientation `duration_s` seconds later (earlier when negative) of a body that rotates
/// freely with the constant angular momentum `k_in_world`.
///
/// `inertia` are the principal moments; their unit is free as long as k has the same one times
/// rad/s. Where they are equal the spin is constant and the answer exact. Otherwise q̇ = ½ ω(q) q
/// (SMASH eq. 8 to 10) is integrated by the Runge-Kutta-Munthe-Kaas method of order 4 (Munthe-Kaas,
/// *High order Runge-Kutta methods on manifolds*, 1999; Hairer, Lubich & Wanner, *Geometric
/// Numerical Integration*, IV.8), which stays on the rotation group; k is never integrated. The
/// time it takes grows with [`turning_bound_rad`]; if that is beyond [`LARGEST_TURNING_RAD`] or not
/// finite (a zero moment), the answer is NaN.
pub fn rotate_freely(
    world_from_body: &UnitQuaternion<f64>,
    inertia: &Vector3<f64>,
    k_in_world: &Vector3<f64>,
    duration_s: f64,
) -> UnitQuaternion<f64> {
    if is_isotropic(inertia) {
        return UnitQuaternion::new(k_in_world * (duration_s / inertia.x)) * world_from_body;
    }
    let turning_rad = turning_bound_rad(inertia, k_in_world, duration_s);
    if turning_rad.is_nan() || turning_rad > LARGEST_TURNING_RAD {
        return UnitQuaternion::new_unchecked(Quaternion::from([f64::NAN; 4]));
    }
    let steps = (turning_rad / LARGEST_STEP_RAD).ceil().max(1.0);
    let step_s = duration_s / steps;
    let turned = (0..steps as u64)
        .fold(*world_from_body, |q, _| munthe_kaas_step(&q, inertia, k_in_world, step_s));
    // Rounding in some thousand products of unit quaternions.
    UnitQuaternion::new_normalize(turned.into_inner())
}

/// An upper bound of the angle turned within `duration_s`, in rad; zero for isotropic inertia,
/// whose rotation costs nothing to compute.
pub fn turning_bound_rad(
    inertia: &Vector3<f64>,
    k_in_world: &Vector3<f64>,
    duration_s: f64,
) -> f64 {
    if is_isotropic(inertia) { 0.0 } else { k_in_world.norm() / inertia.min() * duration_s.abs() }
}

fn is_isotropic(inertia: &Vector3<f64>) -> bool {
    inertia.x == inertia.y && inertia.y == inertia.z
}

/// One step of order 4 with two commutators; [a, b] = a × b for rotation vectors.
fn munthe_kaas_step(
    q: &UnitQuaternion<f64>,
    inertia: &Vector3<f64>,
    k_in_world: &Vector3<f64>,
    step_s: f64,
) -> UnitQuaternion<f64> {
    let moved = |turn: Vector3<f64>| UnitQuaternion::new(turn) * q;
    let turn_at = |q: &UnitQuaternion<f64>| step_s * omega_in_world(q, inertia, k_in_world);
    let first = turn_at(q);
    let second = turn_at(&moved(first / 2.0));
    let third = turn_at(&moved(second / 2.0 - first.cross(&second) / 8.0));
    let fourth = turn_at(&moved(third));
    moved((first + 2.0 * (second + third) + fourth - first.cross(&fourth) / 2.0) / 6.0)
}
