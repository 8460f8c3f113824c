//! How impulse and restitution of a contact go together, with and without effects.

use nalgebra::Vector3;

use super::model::Model;
use crate::rigid_body::{Contact, RigidBody};
use crate::{Error, Result};

/// Rounding that a restitution computed from an impulse may show beyond 0 and 1.
const RESTITUTION_ROUNDING: f64 = 1e-9;

/// Where friction takes more than this times a smooth contact's impulse, nothing comes back.
const JAMMED: f64 = 1e6;

/// The bodies as they touch.
pub(super) struct Touch<'a> {
    pub contact: Contact,
    /// The dynamic bodies just before, a first.
    pub before: Vec<RigidBody>,
    pub model: Option<&'a Model>,
}

impl Touch<'_> {
    pub fn check_approach(&self) -> Result<()> {
        let parting = self.contact.normal_velocity(&self.before[0], self.before.get(1));
        if parting < 0.0 {
            return Ok(());
        }
        let problem = format!("the bodies don't approach there: they part with {parting:.6} m/s");
        Err(Error::invalid("collision", problem).mend(
            "velocities are those just before the impulse; the normal points out of b (or the \
             plane) into a",
        ))
    }

    /// The impulse on a that makes the touching points part with `restitution`.
    pub fn impulse(&self, restitution: f64) -> Result<Vector3<f64>> {
        let (a, other) = (&self.before[0], self.before.get(1));
        let smooth = self.contact.impulse_from_restitution(a, other, restitution);
        match self.model {
            Some(model) if model.has_contact_laws() => {
                let direction = self.contact.normal_in_world.into_inner();
                Ok(self.bisected(restitution, smooth.norm())? * direction)
            }
            _ => Ok(smooth),
        }
    }

    /// The restitution that `impulse` amounts to, if any.
    pub fn checked_restitution(&self, impulse: &Vector3<f64>) -> Result<f64> {
        let restitution = self.restitution(impulse)?;
        if (-RESTITUTION_ROUNDING..=1.0 + RESTITUTION_ROUNDING).contains(&restitution) {
            return Ok(restitution);
        }
        let [least, most] = [self.impulse(0.0)?.norm(), self.impulse(1.0)?.norm()];
        let problem = format!("makes the restitution {restitution:.6}");
        Err(Error::invalid("collision.impulse", problem).mend(format!(
            "give it a length from {least:.6} (no bounce) to {most:.6} N·s/kg (no loss of energy)"
        )))
    }

    fn restitution(&self, impulse: &Vector3<f64>) -> Result<f64> {
        let after: Vec<RigidBody> = match self.model {
            Some(model) => {
                let launched = model.launched(&self.before, impulse)?;
                launched.into_iter().map(|body| body.contact_after).collect()
            }
            None => {
                let point = &self.contact.point_in_world;
                let pushes = self.before.iter().zip([*impulse, -impulse]);
                pushes.map(|(body, push)| body.pushed(point, &push)).collect()
            }
        };
        let before = (&self.before[0], self.before.get(1));
        Ok(self.contact.restitution(before, (&after[0], after.get(1))))
    }

    /// The impulse's length, where the contact's own effects grow with it by laws of any kind: the
    /// restitution is halved in on, to the last bit. `smooth` is the length without them.
    fn bisected(&self, restitution: f64, smooth: f64) -> Result<f64> {
        let normal = self.contact.normal_in_world.into_inner();
        let falls_short = |length: f64| Ok(self.restitution(&(length * normal))? < restitution);
        let (mut low, mut high) = (0.0, smooth);
        while falls_short(high)? {
            if high > JAMMED * smooth {
                return Err(Error::invalid("effects", "jam the contact: no impulse makes it part")
                    .mend("give less friction, or a contact that slides the other way"));
            }
            (low, high) = (high, 2.0 * high);
        }
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Ok(high);
            }
            if falls_short(middle)? { low = middle } else { high = middle }
        }
    }
}
