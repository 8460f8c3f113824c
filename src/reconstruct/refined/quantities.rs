//! What is reported, as a function of the unknowns, and its derivatives.

use nalgebra::{DMatrix, UnitQuaternion, Vector3};

use super::layout::Layout;
use super::model::any_spin;
use super::optimum::Optimum;
use crate::Scene;
use crate::bridge::refined::ffi::{RefinedScene, RefinedUnknowns, launch};
use crate::reconstruct::collision::{States, contact, restitution};
use crate::reconstruct::solver_error;
use crate::rigid_body::quaternion::from_wxyz;
use crate::rigid_body::{Contact, RigidBody};
use crate::scene::Shape;

/// A collision in the terms of the result.
#[derive(Debug, Clone)]
pub(super) struct Collision {
    pub(super) mass_ratio: Option<f64>,
    pub(super) restitution: Result<f64, &'static str>,
    pub(super) time_s: f64,
    pub(super) impulse: Vector3<f64>,
    /// `None` without an impulse.
    pub(super) contact: Option<Contact>,
    pub(super) states: Vec<States>,
    /// The acceleration that all flights share, in m/s²: the scene's, tilted.
    pub(super) gravity: Vector3<f64>,
}

/// The collision that `unknowns` stand for.
pub(super) fn collision(
    scene: &Scene,
    refined: &RefinedScene,
    unknowns: &RefinedUnknowns,
) -> crate::Result<Collision> {
    let impulse = Vector3::from(unknowns.impulse);
    let mut unknowns = unknowns.clone();
    // Without any spin nothing tells the line of action: between the centres, as of balls.
    if !any_spin(refined) {
        let centres = unknowns.bodies.iter().map(|motion| Vector3::from(motion.position));
        let middle = centres.sum::<Vector3<f64>>() / unknowns.bodies.len() as f64;
        unknowns.contact_point = middle.into();
    }
    let mass_ratio = (scene.bodies().len() == 2).then(|| unknowns.log_mass_ratio.exp());
    let launches = launch(refined, &unknowns).map_err(solver_error)?;
    let states: Vec<States> = (0..scene.bodies().len())
        .map(|index| {
            let mass = if index == 0 { 1.0 } else { mass_ratio.unwrap_or(1.0) };
            let motion = &unknowns.bodies[index];
            let launch = &launches[index];
            let has_spin = refined.bodies[index].has_spin;
            let shape = &scene.bodies()[index].shape;
            let before = RigidBody {
                mass,
                principal_inertia: mass * Vector3::from(launch.inertia_per_mass),
                position_in_world: motion.position.into(),
                world_from_body: from_wxyz(motion.orientation),
                velocity_in_world: motion.velocity_before.into(),
                angular_momentum_in_world: mass * Vector3::from(motion.spin_before),
            };
            let after = |velocity: [f64; 3], spin: [f64; 3]| RigidBody {
                velocity_in_world: velocity.into(),
                // Without a spin only what acts at the centre is known.
                angular_momentum_in_world: match has_spin {
                    true => mass * Vector3::from(spin),
                    false => before.angular_momentum_in_world,
                },
                ..before
            };
            States {
                after: after(launch.velocity_after, launch.spin_after),
                contact_after: after(launch.contact_velocity_after, launch.contact_spin_after),
                before,
                spin_before_known: has_spin,
                spin_after_known: has_spin,
                is_ball: matches!(shape, Shape::Sphere { .. }),
            }
        })
        .collect();
    let contact = contact(scene, &states, unknowns.contact_point.into(), &impulse);
    Ok(Collision {
        mass_ratio,
        restitution: restitution(scene, contact, &states),
        time_s: unknowns.collision_time_s,
        impulse,
        contact,
        states,
        gravity: gravity(refined, unknowns.tilt),
    })
}

fn gravity(scene: &RefinedScene, tilt: [f64; 2]) -> Vector3<f64> {
    let [first, second] = scene.across.map(Vector3::from);
    let along = Vector3::from(scene.down) + tilt[0] * first + tilt[1] * second;
    scene.gravity_m_s2 * along.normalize()
}

/// The names of [`Collision::flat`], in its order.
pub(super) fn names(scene: &Scene) -> Vec<String> {
    let vector = |name: &str| ["x", "y", "z"].map(|axis| format!("{name}.{axis}"));
    let mut names: Vec<String> =
        ["mass_ratio", "restitution", "collision_time"].map(String::from).into();
    for name in ["contact_point", "impulse", "normal"] {
        names.extend(vector(name));
    }
    for body in scene.bodies() {
        for quantity in BODY_QUANTITIES {
            names.extend(vector(&format!("{}.{quantity}", body.name)));
        }
    }
    names.extend(vector("gravity"));
    names
}

/// Where the contact point stands in [`Collision::flat`].
pub(super) const CONTACT_POINT: usize = 3;
/// Where the impulse stands.
pub(super) const IMPULSE: usize = 6;

/// Where a body's vector `quantity` stands.
pub(super) fn body_place(body: usize, quantity: &str) -> usize {
    let number = BODY_QUANTITIES.iter().position(|name| *name == quantity).unwrap_or(0);
    12 + 3 * (BODY_QUANTITIES.len() * body + number)
}

const BODY_QUANTITIES: [&str; 8] = [
    "position",
    "orientation",
    "velocity_before",
    "velocity_after",
    "angular_velocity_before",
    "angular_velocity_after",
    "angular_momentum_before",
    "angular_momentum_after",
];

impl Collision {
    /// All numbers in a row; orientations as turns in the world from `base`'s. What doesn't exist
    /// is 0, and has no derivative.
    fn flat(&self, base: &Collision) -> Vec<f64> {
        let mut flat =
            vec![self.mass_ratio.unwrap_or(0.0), self.restitution.unwrap_or(0.0), self.time_s];
        let mut push = |v: &Vector3<f64>| flat.extend(v.iter());
        let (point, normal) =
            self.contact.map_or((Vector3::zeros(), Vector3::zeros()), |contact| {
                (contact.point_in_world, contact.normal_in_world.into_inner())
            });
        push(&point);
        push(&self.impulse);
        push(&normal);
        for (states, base) in self.states.iter().zip(&base.states) {
            let (before, after) = (&states.before, &states.after);
            let turn: UnitQuaternion<f64> =
                before.world_from_body * base.before.world_from_body.inverse();
            push(&before.position_in_world);
            push(&turn.scaled_axis());
            push(&before.velocity_in_world);
            push(&after.velocity_in_world);
            push(&before.omega_in_world());
            push(&after.omega_in_world());
            push(&before.angular_momentum_in_world);
            push(&after.angular_momentum_in_world);
        }
        push(&self.gravity);
        flat
    }
}

/// The derivatives of all reported numbers, and then of the effects' parameters, by the unknowns: by
/// central differences a small part of each unknown's own deviation wide, where the functions are as
/// good as linear.
pub(super) fn derivatives(
    scene: &Scene,
    layout: &Layout,
    optimum: &Optimum,
    refined: &RefinedScene,
) -> crate::Result<DMatrix<f64>> {
    /// In deviations: rounding and curvature both stay below a millionth.
    const STEP: f64 = 1e-3;
    let unknowns = &optimum.solution.unknowns;
    let base = collision(scene, refined, unknowns)?;
    let rows = base.flat(&base).len();
    let mut derivatives = DMatrix::zeros(rows + layout.parameters.len(), layout.size);
    for column in 0..layout.size {
        let std = optimum.covariance.matrix[(column, column)].sqrt();
        let length = (STEP * std).clamp(1e-7, 1e-3);
        let at = |length: f64| {
            let moved = collision(scene, refined, &layout.stepped(unknowns, column, length))?;
            crate::Result::Ok(moved.flat(&base))
        };
        for (row, (high, low)) in at(length)?.iter().zip(at(-length)?).enumerate() {
            derivatives[(row, column)] = (high - low) / (2.0 * length);
        }
    }
    for (index, column) in layout.parameters.iter().enumerate() {
        if let Some(column) = column {
            derivatives[(rows + index, *column)] = 1.0;
        }
    }
    Ok(derivatives)
}
