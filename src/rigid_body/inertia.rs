//! Inertia of the solid shapes, and the spin that goes with an angular momentum.

use nalgebra::{UnitQuaternion, Vector3};

use crate::scene::Shape;

/// Principal moments of inertia of a uniform solid of unit mass, in m², about the body's axes.
///
/// Box: (s_y² + s_z²)/12 and its cyclic companions; ball: 2 r²/5 (Goldstein, *Classical
/// Mechanics*, ch. 5).
pub fn principal_inertia_per_mass(shape: &Shape) -> Vector3<f64> {
    match *shape {
        Shape::Box { size: [x, y, z] } => {
            Vector3::new(y * y + z * z, z * z + x * x, x * x + y * y) / 12.0
        }
        Shape::Sphere { radius } => Vector3::repeat(0.4 * radius * radius),
    }
}

/// ω = R I₀⁻¹ Rᵀ k: the angular velocity in the world, in rad/s, of a body with the angular
/// momentum `k_in_world` in kg·m²/s and the principal moments `inertia` in kg·m² (SMASH eq. 9).
pub fn omega_in_world(
    world_from_body: &UnitQuaternion<f64>,
    inertia: &Vector3<f64>,
    k_in_world: &Vector3<f64>,
) -> Vector3<f64> {
    let k_in_body = world_from_body.inverse_transform_vector(k_in_world);
    world_from_body.transform_vector(&k_in_body.component_div(inertia))
}
