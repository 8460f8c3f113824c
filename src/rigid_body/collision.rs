//! One instantaneous, frictionless impulse between a body and its partner.
//!
//! Sign rule: the impulse **J** acts on body a, −**J** on its partner b; the normal points along
//! **J**, out of the partner into a. A partner that is `None` can't move (a static plane).

use nalgebra::{UnitVector3, Vector3};

use super::RigidBody;

/// Where two bodies touch, and which way they push.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The contact point x_c, in m.
    pub point_in_world: Vector3<f64>,
    /// The direction of the impulse on a; on a static plane, the plane's normal.
    pub normal_in_world: UnitVector3<f64>,
}

impl Contact {
    /// The relative velocity n·(v_a − v_b) of the touching points along the normal, in m/s:
    /// negative when the bodies approach.
    pub fn normal_velocity(&self, a: &RigidBody, partner: Option<&RigidBody>) -> f64 {
        let of_a = a.point_velocity_in_world(&self.point_in_world);
        let of_partner = partner
            .map_or_else(Vector3::zeros, |b| b.point_velocity_in_world(&self.point_in_world));
        self.normal_in_world.dot(&(of_a - of_partner))
    }

    /// The restitution c = −(normal velocity after)/(normal velocity before) (SMASH eq. 15), from
    /// the states of body a and its partner just `before` and just `after` the collision.
    ///
    /// Not finite when the touching points had no normal velocity before.
    pub fn restitution(
        &self,
        before: (&RigidBody, Option<&RigidBody>),
        after: (&RigidBody, Option<&RigidBody>),
    ) -> f64 {
        -self.normal_velocity(after.0, after.1) / self.normal_velocity(before.0, before.1)
    }

    /// The impulse on a, in the unit of the masses times m/s, that makes the touching points part
    /// with `restitution`:
    /// J = −(1 + c) v_n / Σ (1/m + n·(I⁻¹(r × n)) × r) n (Eberly, *Game Physics*, ch. 6).
    pub fn impulse_from_restitution(
        &self,
        a: &RigidBody,
        partner: Option<&RigidBody>,
        restitution: f64,
    ) -> Vector3<f64> {
        let inverse_mass =
            self.inverse_mass_of(a) + partner.map_or(0.0, |b| self.inverse_mass_of(b));
        let approach = self.normal_velocity(a, partner);
        self.normal_in_world.into_inner() * (-(1.0 + restitution) * approach / inverse_mass)
    }

    /// How much the body's point at the contact gains along the normal per unit of impulse.
    fn inverse_mass_of(&self, body: &RigidBody) -> f64 {
        let at_rest = RigidBody {
            velocity_in_world: Vector3::zeros(),
            angular_momentum_in_world: Vector3::zeros(),
            ..*body
        };
        let pushed = at_rest.pushed(&self.point_in_world, &self.normal_in_world);
        self.normal_in_world.dot(&pushed.point_velocity_in_world(&self.point_in_world))
    }
}

impl RigidBody {
    /// The body just after an impulse at `point_in_world`: m v⁺ = m v⁻ + J and
    /// k⁺ = k⁻ + (x_c − p) × J (SMASH eq. 13 and 14); b gets −J. Its pose is the same.
    #[must_use]
    pub fn pushed(mut self, point_in_world: &Vector3<f64>, impulse: &Vector3<f64>) -> Self {
        let lever = point_in_world - self.position_in_world;
        self.velocity_in_world += impulse / self.mass;
        self.angular_momentum_in_world += lever.cross(impulse);
        self
    }
}
