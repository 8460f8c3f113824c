//! Every rule of a specification, checked before anything is computed.

use std::ops::RangeInclusive;

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

use super::contact::{Strike, check_strike};
use super::instant::{Instant, instants};
use super::model::Model;
use super::{BodySpec, NoiseSpec, SIMULATION_SCHEMA, SimulationSpec};
use crate::json::check_schema;
use crate::rigid_body::RigidBody;
use crate::scene::body::{self, solid};
use crate::scene::bounds::{FPS, GRAVITY_M_S2, TIME_S};
use crate::scene::values::{
    check_name, check_noise, check_range, needed, position, refuse, unit_quaternion, unit_vector,
};
use crate::scene::{Shape, StaticPlane};
use crate::{Error, Result};

/// Speeds in m/s and spins in rad/s: far beyond what holds together.
const RATE: RangeInclusive<f64> = -1e5..=1e5;

/// A fly against a train is 1e-9; beyond it the heavier body may as well be static.
const MASS_RATIO: RangeInclusive<f64> = 1e-9..=1e9;

/// A specification after all checks, in the terms of mechanics.
pub(super) struct Setup {
    pub stage: Stage,
    pub strike: Strike,
    /// Where there are effects.
    pub model: Option<Model>,
}

/// Where, and who.
pub(super) struct Stage {
    pub up_in_world: UnitVector3<f64>,
    pub a: Actor,
    pub partner: Partner,
}

impl Stage {
    /// The dynamic bodies, a first.
    pub fn actors(&self) -> impl Iterator<Item = &Actor> {
        std::iter::once(&self.a).chain(self.partner.body())
    }

    /// The dynamic bodies just before the collision, a first.
    pub fn before(&self) -> Vec<RigidBody> {
        self.actors().map(|actor| actor.before).collect()
    }
}

/// A dynamic body.
pub(super) struct Actor {
    /// Its place among the specification's bodies.
    pub index: usize,
    pub name: String,
    pub shape: Shape,
    /// Just before the impulse, at its centre of mass.
    pub before: RigidBody,
    /// When it is seen.
    pub instants: Vec<Instant>,
}

/// What body a collides with.
pub(super) enum Partner {
    Body(Box<Actor>),
    Plane(StaticPlane),
}

impl Partner {
    pub fn body(&self) -> Option<&Actor> {
        match self {
            Partner::Body(actor) => Some(actor),
            Partner::Plane(_) => None,
        }
    }

    fn body_mut(&mut self) -> Option<&mut Actor> {
        match self {
            Partner::Body(actor) => Some(actor),
            Partner::Plane(_) => None,
        }
    }
}

pub(super) fn setup(spec: &SimulationSpec) -> Result<Setup> {
    let (stage, mut model) = staged(spec)?;
    let strike = check_strike(&spec.collision, &stage, model.as_ref())?;
    if let Some(model) = &mut model {
        model.strike(&strike.impulse_on_a);
    }
    Ok(Setup { stage, strike, model })
}

/// All but the collision.
pub(super) fn staged(spec: &SimulationSpec) -> Result<(Stage, Option<Model>)> {
    check_schema(&spec.schema, SIMULATION_SCHEMA)?;
    check_name("name", &spec.name)?;
    if let Some(fps) = spec.fps {
        check_range("fps", fps, &FPS, "give the frames per second")?;
    }
    let mend = "give gravity in m/s², such as 9.81";
    check_range("gravity", spec.gravity, &GRAVITY_M_S2, mend)?;
    check_noise_spec(&spec.noise)?;
    let up_in_world = unit_vector("up", spec.up)?;
    check_range("collision.time", spec.collision.time, &TIME_S, "give the time in s")?;
    position("collision.contact_point", spec.collision.contact_point)?;
    let (a, partner) = bodies(spec)?;
    let mut stage = Stage { up_in_world, a, partner };
    let mut model = Model::new(spec, &stage)?;
    if let Some(model) = &mut model {
        let Stage { a, partner, .. } = &mut stage;
        for (index, actor) in std::iter::once(a).chain(partner.body_mut()).enumerate() {
            model.complete(index, &mut actor.before)?;
        }
    }
    Ok((stage, model))
}

fn check_noise_spec(noise: &NoiseSpec) -> Result<()> {
    match *noise {
        NoiseSpec::None => Ok(()),
        NoiseSpec::Gaussian(sigma) => check_noise("noise.gaussian", &sigma),
        NoiseSpec::Uniform(fraction) if fraction > 0.0 && fraction < 1.0 => Ok(()),
        NoiseSpec::Uniform(fraction) => {
            Err(Error::invalid("noise.uniform", format!("{fraction:?} is not between 0 and 1"))
                .mend("give a fraction, such as 0.05 for 5 %, or write `\"noise\": \"none\"`"))
        }
    }
}

fn bodies(spec: &SimulationSpec) -> Result<(Actor, Partner)> {
    let [first, second] = spec.bodies.as_slice() else {
        return Err(Error::invalid("bodies", format!("holds {}", spec.bodies.len()))
            .mend("give two: two dynamic ones, or a dynamic and a static one"));
    };
    let is_static = |body: &BodySpec| body.is_static == Some(true);
    match (is_static(first), is_static(second)) {
        (true, true) => Err(Error::invalid("bodies", "are both static")
            .mend("make the first a dynamic body: `shape`, `position`, `velocity`")),
        (false, false) => {
            let why = "it is the mass of the second body over that of the first";
            let ratio = spec.mass_ratio.ok_or_else(|| {
                Error::invalid("mass_ratio", "is missing").mend(format!("add it: {why}"))
            })?;
            check_range("mass_ratio", ratio, &MASS_RATIO, why)?;
            Ok((actor(spec, 0, 1.0)?, Partner::Body(Box::new(actor(spec, 1, ratio)?))))
        }
        (true, false) | (false, true) => {
            if spec.mass_ratio.is_some() {
                return Err(Error::invalid("mass_ratio", "is out of place: one body is static")
                    .mend("remove `mass_ratio`"));
            }
            let (moving, standing) = if is_static(first) { (1, 0) } else { (0, 1) };
            Ok((actor(spec, moving, 1.0)?, Partner::Plane(plane(spec, standing)?)))
        }
    }
}

fn actor(spec: &SimulationSpec, index: usize, mass: f64) -> Result<Actor> {
    let body = &spec.bodies[index];
    let place = format!("bodies[{index}]");
    let shape = solid(&place, body.shape, body.normal, body.height)?;
    let why = "a dynamic body has a state just before the collision";
    let centre = needed(&place, "position", body.position, why)?;
    let velocity = needed(&place, "velocity", body.velocity, why)?;
    let spin = body.angular_velocity.unwrap_or_default();
    let world_from_body = match body.orientation {
        Some(wxyz) => unit_quaternion(&format!("{place}.orientation"), wxyz)?,
        None => UnitQuaternion::identity(),
    };
    let at_rest = RigidBody {
        position_in_world: position(&format!("{place}.position"), centre)?,
        world_from_body,
        ..RigidBody::solid(&shape, mass)
    };
    let spinning = at_rest.spinning(&rate(&format!("{place}.angular_velocity"), spin, "rad/s")?);
    let before = RigidBody {
        velocity_in_world: rate(&format!("{place}.velocity"), velocity, "m/s")?,
        ..spinning
    };
    Ok(Actor { index, name: body.name.clone(), shape, before, instants: instants(spec, index)? })
}

/// A velocity or an angular velocity.
fn rate(place: &str, value: [f64; 3], unit: &str) -> Result<Vector3<f64>> {
    for (axis, &component) in value.iter().enumerate() {
        check_range(&format!("{place}[{axis}]"), component, &RATE, &format!("give it in {unit}"))?;
    }
    Ok(Vector3::from(value))
}

fn plane(spec: &SimulationSpec, index: usize) -> Result<StaticPlane> {
    let body = &spec.bodies[index];
    let place = format!("bodies[{index}]");
    for (field, is_there) in [
        ("shape", body.shape.is_some()),
        ("position", body.position.is_some()),
        ("orientation", body.orientation.is_some()),
        ("velocity", body.velocity.is_some()),
        ("angular_velocity", body.angular_velocity.is_some()),
        ("measure_orientation", body.measure_orientation.is_some()),
        ("observations", body.observations.is_some()),
    ] {
        refuse(&place, field, is_there, "a static body is a plane")?;
    }
    body::plane(&place, body.name.clone(), body.normal, body.height)
}
