//! The rules of the collision: where the bodies touch, that they approach, how hard they strike.

use nalgebra::{UnitVector3, Vector3};

use super::CollisionSpec;
use super::check::{Actor, Partner, Stage};
use super::model::Model;
use super::touch::Touch;
use crate::rigid_body::Contact;
use crate::scene::Shape;
use crate::scene::values::{needed, refuse, unit_vector};
use crate::words::rounded;
use crate::{Error, Result};

/// How far a contact point may be off a body's surface: what one rounds to by hand, in m.
const SURFACE_TOLERANCE_M: f64 = 1e-3;

/// How far a contact point may be off a static plane, in m.
const PLANE_TOLERANCE_M: f64 = 1e-6;

/// The collision, checked.
pub(super) struct Strike {
    pub contact: Contact,
    /// Per unit mass of a.
    pub impulse_on_a: Vector3<f64>,
    pub restitution: f64,
}

/// What the specification says of the collision's strength.
enum Strength {
    Restitution(f64),
    Impulse(Vector3<f64>),
}

pub(super) fn check_strike(
    spec: &CollisionSpec,
    stage: &Stage,
    model: Option<&Model>,
) -> Result<Strike> {
    let point_in_world = Vector3::from(spec.contact_point);
    check_on_plane(&stage.partner, &point_in_world)?;
    for (index, actor) in stage.actors().enumerate() {
        let centre = match model {
            Some(model) => model.shape_centre_in_world(index)?,
            None => actor.before.position_in_world,
        };
        check_on_surface(actor, &centre, &point_in_world)?;
    }
    let strength = strength(spec)?;
    let normal_in_world = normal(spec, &stage.partner, &strength)?;
    let contact = Contact { point_in_world, normal_in_world };
    let touch = Touch { contact, before: stage.before(), model };
    touch.check_approach()?;
    let (impulse_on_a, restitution) = match strength {
        Strength::Restitution(restitution) => (touch.impulse(restitution)?, restitution),
        Strength::Impulse(impulse) => (impulse, touch.checked_restitution(&impulse)?),
    };
    Ok(Strike { contact, impulse_on_a, restitution })
}

fn check_on_plane(partner: &Partner, point_in_world: &Vector3<f64>) -> Result<()> {
    let Partner::Plane(plane) = partner else {
        return Ok(());
    };
    let off_m = plane.normal_in_world.dot(point_in_world) - plane.height_m;
    if off_m.abs() <= PLANE_TOLERANCE_M {
        return Ok(());
    }
    let foot = point_in_world - off_m * plane.normal_in_world.into_inner();
    let problem = format!("is {:.6} m off the plane `{}`", off_m.abs(), plane.name);
    Err(Error::invalid("collision.contact_point", problem)
        .mend(format!("the nearest point of the plane is {}", shown(&foot))))
}

/// `centre` is that of the shape.
fn check_on_surface(
    actor: &Actor,
    centre: &Vector3<f64>,
    point_in_world: &Vector3<f64>,
) -> Result<()> {
    let body = &actor.before;
    let lever = point_in_world - centre;
    let in_body = body.world_from_body.inverse_transform_vector(&lever);
    let nearest = nearest_surface_point(&actor.shape, &in_body);
    let off_m = (nearest - in_body).norm();
    if off_m <= SURFACE_TOLERANCE_M {
        return Ok(());
    }
    let nearest_in_world = centre + body.world_from_body.transform_vector(&nearest);
    let problem = format!("is {off_m:.4} m off the surface of `{}`", actor.name);
    Err(Error::invalid("collision.contact_point", problem).mend(format!(
        "move the point or the body; the nearest point of its surface is {}",
        shown(&nearest_in_world)
    )))
}

fn nearest_surface_point(shape: &Shape, point_in_body: &Vector3<f64>) -> Vector3<f64> {
    match *shape {
        Shape::Sphere { radius } => {
            let out = point_in_body.try_normalize(0.0).unwrap_or_else(Vector3::x);
            radius * out
        }
        Shape::Box { size } => {
            let half = Vector3::from(size) / 2.0;
            let mut nearest = point_in_body.zip_map(&half, |x, h| x.clamp(-h, h));
            let depth = half - nearest.abs();
            if depth.min() > 0.0 {
                // Within: straight out through the nearest face.
                let axis = depth.imin();
                nearest[axis] = half[axis].copysign(point_in_body[axis]);
            }
            nearest
        }
    }
}

fn strength(spec: &CollisionSpec) -> Result<Strength> {
    match (spec.restitution, spec.impulse) {
        (Some(restitution), None) if (0.0..=1.0).contains(&restitution) => {
            Ok(Strength::Restitution(restitution))
        }
        (Some(restitution), None) => {
            Err(Error::invalid("collision.restitution", format!("is {restitution}"))
                .mend("give a number from 0 (no bounce) to 1 (no loss of energy)"))
        }
        (None, Some(impulse)) => Ok(Strength::Impulse(Vector3::from(impulse))),
        (None, None) => Err(Error::invalid("collision", "has neither `restitution` nor `impulse`")
            .mend("give one of them")),
        (Some(_), Some(_)) => Err(Error::invalid("collision", "has `restitution` and `impulse`")
            .mend("keep one of them: the other follows")),
    }
}

fn normal(
    spec: &CollisionSpec,
    partner: &Partner,
    strength: &Strength,
) -> Result<UnitVector3<f64>> {
    let is_there = spec.normal.is_some();
    match (partner, strength) {
        (Partner::Plane(plane), _) => {
            refuse("collision", "normal", is_there, "the static body has its own")?;
            if let Strength::Impulse(impulse) = strength {
                check_along_normal(impulse, &plane.normal_in_world)?;
            }
            Ok(plane.normal_in_world)
        }
        (Partner::Body(_), Strength::Impulse(impulse)) => {
            refuse("collision", "normal", is_there, "it is the impulse's direction")?;
            UnitVector3::try_new(*impulse, 0.0).ok_or_else(|| {
                Error::invalid("collision.impulse", "is zero").mend("give the push on a")
            })
        }
        (Partner::Body(_), Strength::Restitution(_)) => {
            let why = "the unit vector along the impulse on a, out of b into a";
            let normal = needed("collision", "normal", spec.normal, why)?;
            unit_vector("collision.normal", normal)
        }
    }
}

fn check_along_normal(impulse: &Vector3<f64>, normal: &UnitVector3<f64>) -> Result<()> {
    let along = normal.dot(impulse);
    let across = (impulse - along * normal.into_inner()).norm();
    if across <= 1e-9 * impulse.norm() {
        return Ok(());
    }
    let frictionless = along * normal.into_inner();
    let problem = format!("has {across:.6} N·s/kg across the plane's normal: friction");
    Err(Error::invalid("collision.impulse", problem).mend(format!(
        "without friction it is {}; for friction, add the effect `friction`",
        shown(&frictionless)
    )))
}

fn shown(point: &Vector3<f64>) -> String {
    format!("[{}]", [point.x, point.y, point.z].map(rounded).join(", "))
}
