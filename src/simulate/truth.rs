//! What a simulated scene was made with, to compare a reconstruction against.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::{Actor, Setup};
use super::{EffectSpec, Motion, SimulationSpec};
use crate::rigid_body::quaternion::to_wxyz;

/// The value of a truth file's field `schema`.
pub const TRUTH_SCHEMA: &str = "smash.truth/1";

/// The truth behind a simulated scene: fields as in `smash.result/1`, as plain numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "smash.truth/1")]
pub struct Truth {
    /// Always `smash.truth/1`.
    #[schemars(extend("const" = TRUTH_SCHEMA))]
    pub schema: String,
    /// The scene's name.
    pub scene: String,
    /// Mass of b over mass of a; null against a static body.
    pub mass_ratio: Option<f64>,
    /// −(relative normal velocity after)/(before) by the contact alone.
    pub restitution: f64,
    /// When the bodies collide, in s.
    pub collision_time: f64,
    /// Where the bodies touch, in the world, in m.
    pub contact_point: [f64; 3],
    /// The impulse on a, per unit mass of a, in N·s/kg; without what effects add.
    pub impulse: [f64; 3],
    /// The impulse's direction; on a static plane, the plane's normal.
    pub normal: [f64; 3],
    /// The dynamic bodies, a first.
    pub bodies: Vec<TrueBody>,
    /// What acted beyond the base model, one by one.
    #[serde(default)]
    pub effects: Vec<EffectSpec>,
}

/// A dynamic body at the collision; all in the world.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrueBody {
    /// The body's name.
    pub name: String,
    /// Centre of mass, in m.
    pub position: [f64; 3],
    /// The quaternion [w, x, y, z] that maps the body to the world.
    pub orientation: [f64; 4],
    /// Velocity just before, in m/s.
    pub velocity_before: [f64; 3],
    /// Velocity just after all that happens at the collision, in m/s.
    pub velocity_after: [f64; 3],
    /// Angular velocity just before, in rad/s.
    pub angular_velocity_before: [f64; 3],
    /// Angular velocity just after, in rad/s.
    pub angular_velocity_after: [f64; 3],
    /// Angular momentum about the centre of mass just before, per unit mass of a, in m²/s.
    pub angular_momentum_before: [f64; 3],
    /// Angular momentum about the centre of mass just after, per unit mass of a, in m²/s.
    pub angular_momentum_after: [f64; 3],
}

pub(super) fn truth(spec: &SimulationSpec, setup: &Setup, motions: &[Motion]) -> Truth {
    Truth {
        schema: TRUTH_SCHEMA.into(),
        scene: spec.name.clone(),
        mass_ratio: spec.mass_ratio,
        restitution: setup.strike.restitution,
        collision_time: spec.collision.time,
        contact_point: spec.collision.contact_point,
        impulse: setup.strike.impulse_on_a.into(),
        normal: setup.strike.contact.normal_in_world.into_inner().into(),
        bodies: setup
            .stage
            .actors()
            .zip(motions)
            .map(|(actor, motion)| true_body(actor, motion))
            .collect(),
        effects: setup.model.as_ref().map_or(Vec::new(), |model| model.effects().to_vec()),
    }
}

fn true_body(actor: &Actor, Motion { before, after, .. }: &Motion) -> TrueBody {
    TrueBody {
        name: actor.name.clone(),
        position: before.position_in_world.into(),
        orientation: to_wxyz(&before.world_from_body),
        velocity_before: before.velocity_in_world.into(),
        velocity_after: after.velocity_in_world.into(),
        angular_velocity_before: before.omega_in_world().into(),
        angular_velocity_after: after.omega_in_world().into(),
        angular_momentum_before: before.angular_momentum_in_world.into(),
        angular_momentum_after: after.angular_momentum_in_world.into(),
    }
}
