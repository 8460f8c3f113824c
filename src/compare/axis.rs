//! The axes along which causes show, at each pose.

use nalgebra::{UnitVector3, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Channel;
use super::residuals::PoseResidual;
use crate::Scene;

/// A direction that turns with a body's motion, or that of gravity or sight. Along `x`, `y` and `z`
/// of the world causes would be spread over all three.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Axis {
    /// Position along the velocity: ahead is positive. Drag, a time offset.
    AlongVelocity,
    /// Position across the velocity, level: to the right of one who flies along is positive. A side
    /// force.
    AcrossVelocityLevel,
    /// Position across the velocity, in its vertical plane: above the path is positive. Lift.
    AcrossVelocityUpward,
    /// Position against gravity: above is positive. Its size or direction, a wrong scale.
    AgainstGravity,
    /// Position along ω × v: the Magnus force.
    OmegaCrossVelocity,
    /// Position away from the camera: farther is positive. Wrong depths.
    LineOfSight,
    /// Orientation about the spin: turned further is positive. Spin lost to the air.
    AboutSpin,
    /// Orientation about the level axis across the spin.
    AcrossSpinLevel,
    /// Orientation about the other axis across the spin. Both: a wrong inertia.
    AcrossSpinUpward,
}

impl Axis {
    /// All, in the order in which they are told.
    pub const ALL: [Axis; 9] = [
        Axis::AlongVelocity,
        Axis::AcrossVelocityLevel,
        Axis::AcrossVelocityUpward,
        Axis::AgainstGravity,
        Axis::OmegaCrossVelocity,
        Axis::LineOfSight,
        Axis::AboutSpin,
        Axis::AcrossSpinLevel,
        Axis::AcrossSpinUpward,
    ];

    /// What is looked at along it.
    pub fn channel(self) -> Channel {
        match self {
            Axis::AboutSpin | Axis::AcrossSpinLevel | Axis::AcrossSpinUpward => {
                Channel::Orientation
            }
            _ => Channel::Position,
        }
    }

    /// In words, for a table or a plot.
    pub fn label(self) -> &'static str {
        match self {
            Axis::AlongVelocity => "along its path",
            Axis::AcrossVelocityLevel => "sideways",
            Axis::AcrossVelocityUpward => "above its path",
            Axis::AgainstGravity => "upward",
            Axis::OmegaCrossVelocity => "along ω × v",
            Axis::LineOfSight => "away from the camera",
            Axis::AboutSpin => "about its spin",
            Axis::AcrossSpinLevel => "across its spin, level",
            Axis::AcrossSpinUpward => "across its spin, upward",
        }
    }

    /// The unit vector at `pose`; `None` where there is none: at rest, without spin or camera.
    pub(super) fn at(self, pose: &PoseResidual, scene: &Scene) -> Option<UnitVector3<f64>> {
        let up = scene.up_in_world();
        let (v, omega) = (pose.velocity_in_world, pose.omega_in_world);
        let direction = match self {
            Axis::AlongVelocity => v,
            Axis::AcrossVelocityLevel => level_across(&v, &up)?,
            Axis::AcrossVelocityUpward => level_across(&v, &up)?.cross(&v),
            Axis::AgainstGravity => up.into_inner(),
            Axis::OmegaCrossVelocity => omega?.cross(&v),
            Axis::LineOfSight => pose.seen_in_world - Vector3::from(scene.camera()?.position),
            Axis::AboutSpin => omega?,
            Axis::AcrossSpinLevel => level_across(&omega?, &up)?,
            Axis::AcrossSpinUpward => level_across(&omega?, &up)?.cross(&omega?),
        };
        // Slower than a millimetre or a milliradian a second it points anywhere.
        UnitVector3::try_new(direction, 1e-6)
    }
}

/// Level, and across `along`; of what is upright, the level axis that is nearest to the world's.
fn level_across(along: &Vector3<f64>, up: &Vector3<f64>) -> Option<Vector3<f64>> {
    /// The sine of an angle to the vertical, below which the plane of both is noise.
    const UPRIGHT: f64 = 1e-3;
    let across = along.cross(up);
    let speed = along.norm();
    if across.norm() > UPRIGHT * speed {
        return Some(across / across.norm());
    }
    let least = Vector3::ith(up.iamin(), 1.0);
    (speed > 0.0).then(|| up.cross(&least).normalize())
}
