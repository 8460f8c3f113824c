//! Where a law acts on the model.

use std::fmt;

use serde::Serialize;

use super::unit::Dimension;

/// What a law states. All vectors are in the world, but for [`Hook::Orientation`] and
/// [`Hook::Inertia`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
#[repr(u8)]
pub enum Hook {
    /// Added to gravity; vector, m/s².
    Acceleration = 0,
    /// Rate of the spin L, the angular momentum per unit of the body's own mass; vector, m²/s².
    Torque = 1,
    /// Factors on the solid's principal moments; vector.
    Inertia = 2,
    /// The time at which the model is compared with the stamp `t`; scalar, s.
    Time = 3,
    /// Where the annotated centre is seen; vector, m.
    Position = 4,
    /// Rotation vector in the body frame by which the annotation is turned off:
    /// q_seen = q · Exp(turn); vector, rad.
    Orientation = 5,
    /// Further impulse at the collision, per unit mass of a; vector, m/s.
    Impulse = 6,
    /// Where `impulse` acts; the centre of mass if it isn't given; vector, m.
    ImpulsePoint = 7,
    /// Further angular impulse at the collision, per unit mass of a; vector, m²/s.
    AngularImpulse = 8,
    /// When the further event happens; scalar, s.
    EventTime = 9,
    /// Change of the body's velocity at the event; vector, m/s.
    EventImpulse = 10,
    /// Change of L at the event; vector, m²/s.
    EventAngularImpulse = 11,
}

impl Hook {
    /// All, in the order of their numbers.
    pub const ALL: [Hook; 12] = [
        Hook::Acceleration,
        Hook::Torque,
        Hook::Inertia,
        Hook::Time,
        Hook::Position,
        Hook::Orientation,
        Hook::Impulse,
        Hook::ImpulsePoint,
        Hook::AngularImpulse,
        Hook::EventTime,
        Hook::EventImpulse,
        Hook::EventAngularImpulse,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Hook::Acceleration => "acceleration",
            Hook::Torque => "torque",
            Hook::Inertia => "inertia",
            Hook::Time => "time",
            Hook::Position => "position",
            Hook::Orientation => "orientation",
            Hook::Impulse => "impulse",
            Hook::ImpulsePoint => "impulse_point",
            Hook::AngularImpulse => "angular_impulse",
            Hook::EventTime => "event_time",
            Hook::EventImpulse => "event_impulse",
            Hook::EventAngularImpulse => "event_angular_impulse",
        }
    }

    /// How many numbers its result has: 1 or 3.
    pub fn length(self) -> usize {
        match self {
            Hook::Time | Hook::EventTime => 1,
            _ => 3,
        }
    }

    /// The unit of its result.
    pub fn dimension(self) -> Dimension {
        match self {
            Hook::Acceleration => Dimension::of(1, -2, 0),
            Hook::Torque => Dimension::of(2, -2, 0),
            Hook::Inertia | Hook::Orientation => Dimension::NONE,
            Hook::Time | Hook::EventTime => Dimension::of(0, 1, 0),
            Hook::Position | Hook::ImpulsePoint => Dimension::of(1, 0, 0),
            Hook::Impulse | Hook::EventImpulse => Dimension::of(1, -1, 0),
            Hook::AngularImpulse | Hook::EventAngularImpulse => Dimension::of(2, -1, 0),
        }
    }

    /// The names that its law may use, beside the parameters.
    pub(super) fn scope(self) -> &'static [&'static str] {
        match self {
            Hook::Acceleration | Hook::Torque => &[
                "t", "p", "v", "q", "w", "L", "up", "g", "camera", "normal", "size", "mass",
                "across1", "across2", "t_c",
            ],
            Hook::Inertia => &["size", "mass"],
            Hook::Time => &["t", "t_c"],
            Hook::Position | Hook::Orientation => {
                &["t", "p", "q", "up", "g", "camera", "normal", "size", "across1", "across2", "t_c"]
            }
            Hook::Impulse | Hook::ImpulsePoint | Hook::AngularImpulse => &[
                "p", "v", "q", "w", "L", "up", "g", "normal", "size", "mass", "J", "x", "slip",
                "across1", "across2", "t_c",
            ],
            Hook::EventTime => &["t_c"],
            Hook::EventImpulse | Hook::EventAngularImpulse => {
                &["p", "v", "q", "w", "L", "size", "up", "g", "across1", "across2"]
            }
        }
    }
}

impl fmt::Display for Hook {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(self.name())
    }
}
