//! Every rule of a specification, checked before anything is computed.

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

use super::contact::{Strike, check_strike};
use super::instant::{Instant, instants};
use super::value::{absent, direction, finite, orientation, positive, required, vector};
use super::{BodySpec, NoiseSpec, SIMULATION_SCHEMA, SimulationSpec};
use crate::rigid_body::RigidBody;
use crate::scene::{Shape, StaticPlane};
use crate::{Error, Result};

/// A specification after all checks, in the terms of mechanics.
pub(super) struct Setup {
    pub up_in_world: UnitVector3<f64>,
    pub a: Actor,
    pub partner: Partner,
    pub strike: Strike,
}

impl Setup {
    /// The dynamic bodies, a first.
    pub fn actors(&self) -> impl Iterator<Item = &Actor> {
        std::iter::once(&self.a).chain(self.partner.body())
    }
}

/// A dynamic body on the stage.
pub(super) struct Actor {
    /// Its place among the specification's bodies.
    pub index: usize,
    pub name: String,
    pub shape: Shape,
    /// Just before the impulse.
    pub before: RigidBody,
    pub instants: Vec<Instant>,
}

/// What body a collides with.
pub(super) enum Partner {
    Body(Actor),
    Plane(StaticPlane),
}

impl Partner {
    pub fn body(&self) -> Option<&Actor> {
        match self {
            Partner::Body(actor) => Some(actor),
            Partner::Plane(_) => None,
        }
    }
}

impl SimulationSpec {
    /// Checks every rule, as [`simulate`](super::simulate) does before it computes anything.
    ///
    /// # Errors
    /// The first broken rule: its field, the value and the mend.
    pub fn check(&self) -> Result<()> {
        setup(self).map(|_| ())
    }
}

pub(super) fn setup(spec: &SimulationSpec) -> Result<Setup> {
    if spec.schema != SIMULATION_SCHEMA {
        return Err(Error::invalid("schema", format!("is `{}`", spec.schema))
            .mend(format!("make it `{SIMULATION_SCHEMA}`")));
    }
    if let Some(fps) = spec.fps {
        positive("fps", fps)?;
    }
    if finite("gravity", spec.gravity)? < 0.0 {
        return Err(Error::invalid("gravity", format!("is {}", spec.gravity))
            .mend("give its strength, 0 or more; `up` says where it points from"));
    }
    check_noise(&spec.noise)?;
    let up_in_world = direction("up", spec.up)?;
    let (a, partner) = bodies(spec)?;
    let strike = check_strike(&spec.collision, &a, &partner)?;
    Ok(Setup {
        up_in_world,
        a,
        partner,
        strike,
    })
}

fn check_noise(noise: &NoiseSpec) -> Result<()> {
    match *noise {
        NoiseSpec::None => Ok(()),
        NoiseSpec::Gaussian(sigma) => {
            positive("noise.gaussian.position", sigma.position)?;
            positive("noise.gaussian.orientation", sigma.orientation).map(|_| ())
        }
        NoiseSpec::Uniform(fraction) if fraction > 0.0 && fraction < 1.0 => Ok(()),
        NoiseSpec::Uniform(fraction) => {
            Err(Error::invalid("noise.uniform", format!("is {fraction}"))
                .mend("give a fraction between 0 and 1, such as 0.05 for 5 %, or `\"none\"`"))
        }
    }
}

fn bodies(spec: &SimulationSpec) -> Result<(Actor, Partner)> {
    let [first, second] = spec.bodies.as_slice() else {
        return Err(
            Error::invalid("bodies", format!("holds {}", spec.bodies.len()))
                .mend("give two: two dynamic ones, or a dynamic and a static one"),
        );
    };
    for (index, body) in spec.bodies.iter().enumerate() {
        if body.name.is_empty() {
            let place = format!("bodies[{index}].name");
            return Err(Error::invalid(place, "is empty").mend("give each body a name"));
        }
    }
    if first.name == second.name {
        return Err(
            Error::invalid("bodies[1].name", "is the same as the first body's")
                .mend("give each body a name of its own"),
        );
    }
    let is_static = |body: &BodySpec| body.is_static == Some(true);
    match (is_static(first), is_static(second)) {
        (true, true) => Err(Error::invalid("bodies", "are both static")
            .mend("make the first a dynamic body: `shape`, `position`, `velocity`")),
        (false, false) => {
            let why = "give the mass of the second body over that of the first";
            let ratio = required("mass_ratio", spec.mass_ratio, why)?;
            positive("mass_ratio", ratio)?;
            Ok((actor(spec, 0, 1.0)?, Partner::Body(actor(spec, 1, ratio)?)))
        }
        (true, false) | (false, true) => {
            let why = "leave it out: a static body's mass is infinite";
            absent("mass_ratio", &spec.mass_ratio, why)?;
            let (moving, standing) = if is_static(first) { (1, 0) } else { (0, 1) };
            Ok((
                actor(spec, moving, 1.0)?,
                Partner::Plane(plane(spec, standing)?),
            ))
        }
    }
}

fn actor(spec: &SimulationSpec, index: usize, mass: f64) -> Result<Actor> {
    let body = &spec.bodies[index];
    let at = |field: &str| format!("bodies[{index}].{field}");
    for (field, value) in [
        ("normal", body.normal.is_some()),
        ("height", body.height.is_some()),
    ] {
        let why = "only a static body has it; add `\"static\": true` if this is one";
        absent(&at(field), &value.then_some(()), why)?;
    }
    let why = "a dynamic body needs it; a plane needs `\"static\": true`";
    let shape = required(&at("shape"), body.shape, why)?;
    check_shape(&at("shape"), &shape)?;
    let at_rest = RigidBody::solid(&shape, mass);
    let position = required(&at("position"), body.position, why)?;
    let velocity = required(&at("velocity"), body.velocity, why)?;
    let world_from_body = match body.orientation {
        Some(value) => orientation(&at("orientation"), value)?,
        None => UnitQuaternion::identity(),
    };
    let omega_in_world = match body.angular_velocity {
        Some(value) => vector(&at("angular_velocity"), value)?,
        None => Vector3::zeros(),
    };
    let before = RigidBody {
        position_in_world: vector(&at("position"), position)?,
        velocity_in_world: vector(&at("velocity"), velocity)?,
        world_from_body,
        ..at_rest
    };
    Ok(Actor {
        index,
        name: body.name.clone(),
        shape,
        before: before.spinning(&omega_in_world),
        instants: instants(spec, index)?,
    })
}

fn check_shape(place: &str, shape: &Shape) -> Result<()> {
    match *shape {
        Shape::Sphere { radius } => positive(&format!("{place}.radius"), radius).map(|_| ()),
        Shape::Box { size } => size.into_iter().enumerate().try_for_each(|(axis, edge)| {
            positive(&format!("{place}.size[{axis}]"), edge).map(|_| ())
        }),
    }
}

fn plane(spec: &SimulationSpec, index: usize) -> Result<StaticPlane> {
    let body = &spec.bodies[index];
    let at = |field: &str| format!("bodies[{index}].{field}");
    for (field, value) in [
        ("shape", body.shape.is_some()),
        ("position", body.position.is_some()),
        ("orientation", body.orientation.is_some()),
        ("velocity", body.velocity.is_some()),
        ("angular_velocity", body.angular_velocity.is_some()),
        ("measure_orientation", body.measure_orientation.is_some()),
        ("observations", body.observations.is_some()),
    ] {
        let why = "a static body has only `name`, `static`, `normal` and `height`";
        absent(&at(field), &value.then_some(()), why)?;
    }
    let why = "a static body is the plane normal·p = height";
    let normal = required(&at("normal"), body.normal, why)?;
    let height = required(&at("height"), body.height, why)?;
    Ok(StaticPlane {
        name: body.name.clone(),
        normal_in_world: direction(&at("normal"), normal)?,
        height_m: finite(&at("height"), height)?,
    })
}
