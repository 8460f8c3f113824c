//! A rigid body at one instant.

use nalgebra::{UnitQuaternion, Vector3};

use super::{omega_in_world, principal_inertia_per_mass};
use crate::scene::Shape;

/// A rigid body at one instant: what it is, where it is, and how it moves.
///
/// Masses may be relative (body `a` has mass 1): impulses and momenta then are per unit mass
/// of a.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// Mass in kg, or relative to body a's.
    pub mass: f64,
    /// Principal moments of inertia about the body's axes, in m² times the unit of `mass`.
    pub principal_inertia: Vector3<f64>,
    /// Centre of mass, in m.
    pub position_in_world: Vector3<f64>,
    /// Orientation: maps the body to the world.
    pub world_from_body: UnitQuaternion<f64>,
    /// Velocity of the centre of mass, in m/s.
    pub velocity_in_world: Vector3<f64>,
    /// Angular momentum k about the centre of mass, in m²/s times the unit of `mass`.
    pub angular_momentum_in_world: Vector3<f64>,
}

impl RigidBody {
    /// A uniform solid of `shape` and `mass` at rest, at the origin, its axes the world's.
    pub fn solid(shape: &Shape, mass: f64) -> Self {
        RigidBody {
            mass,
            principal_inertia: mass * principal_inertia_per_mass(shape),
            position_in_world: Vector3::zeros(),
            world_from_body: UnitQuaternion::identity(),
            velocity_in_world: Vector3::zeros(),
            angular_momentum_in_world: Vector3::zeros(),
        }
    }

    /// The same body with the angular velocity `omega_in_world`, in rad/s: k = R I₀ Rᵀ ω.
    #[must_use]
    pub fn spinning(mut self, omega_in_world: &Vector3<f64>) -> Self {
        let omega_in_body = self.world_from_body.inverse_transform_vector(omega_in_world);
        let k_in_body = omega_in_body.component_mul(&self.principal_inertia);
        self.angular_momentum_in_world = self.world_from_body.transform_vector(&k_in_body);
        self
    }

    /// Angular velocity ω in the world, in rad/s.
    pub fn omega_in_world(&self) -> Vector3<f64> {
        omega_in_world(
            &self.world_from_body,
            &self.principal_inertia,
            &self.angular_momentum_in_world,
        )
    }

    /// Velocity v + ω × (x − p) of the body's point at x, in m/s.
    pub fn point_velocity_in_world(&self, point_in_world: &Vector3<f64>) -> Vector3<f64> {
        let lever = point_in_world - self.position_in_world;
        self.velocity_in_world + self.omega_in_world().cross(&lever)
    }

    /// Kinetic energy ½ m v² + ½ k·ω, in J for a mass in kg.
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity_in_world.norm_squared()
            + 0.5 * self.angular_momentum_in_world.dot(&self.omega_in_world())
    }

    /// Angular momentum about `point_in_world`: (p − point) × m v + k.
    pub fn angular_momentum_about(&self, point_in_world: &Vector3<f64>) -> Vector3<f64> {
        let lever = self.position_in_world - point_in_world;
        lever.cross(&(self.mass * self.velocity_in_world)) + self.angular_momentum_in_world
    }
}
