//! The dynamics run forwards: from bodies and their collision to the scene that one would see.
//!
//! ```text
//! specification ──► check ──► motion ──► sample ──► noise ──► scene
//! (json)        (effects)         └─────────────────────────────► truth
//! ```

mod check;
mod clearance;
mod contact;
mod effects;
mod instant;
mod model;
mod motion;
mod noise;
mod observe;
mod random;
mod read;
mod sampling;
mod spec;
mod touch;
mod truth;

pub use effects::EffectSpec;
pub use motion::Motion;
pub use noise::{NoiseSpec, add_noise};
pub use sampling::{RegularSampling, Sampling, keep_frames};
pub use spec::{BodySpec, CollisionSpec, SIMULATION_SCHEMA, SimulationSpec};
pub use truth::{TRUTH_SCHEMA, TrueBody, Truth};

use std::sync::Arc;

use nalgebra::Vector3;

use crate::rigid_body::RigidBody;
use crate::scene::SceneFile;
use crate::{Result, Scene};
use check::{Setup, setup, staged};
use motion::Forced;
use observe::{check_effort, scene_file};
use truth::truth;

/// What was simulated.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// What is seen, as a file: noisy if the specification says so.
    pub scene_file: SceneFile,
    /// The same, checked: ready to be reconstructed.
    pub scene: Scene,
    /// What it was made with.
    pub truth: Truth,
    /// How the dynamic bodies really move, a first: their exact pose at any time.
    pub motions: Vec<Motion>,
}

/// Runs the dynamics of `spec` forwards and observes the bodies.
///
/// # Errors
/// The specification breaks a rule: the error names the field, the value and the mend.
pub fn simulate(spec: &SimulationSpec) -> Result<Simulation> {
    let setup = setup(spec)?;
    let motions = motions(spec, &setup)?;
    check_effort(&setup.stage, &motions)?;
    let seen =
        setup.stage.actors().zip(&motions).map(|(actor, motion)| motion.seen(&actor.instants));
    let exact = scene_file(spec, &setup.stage, &seen.collect::<Result<Vec<_>>>()?);
    let scene_file = add_noise(exact, &spec.noise, spec.seed);
    let scene = Scene::from_file(scene_file.clone())?;
    Ok(Simulation { scene_file, scene, truth: truth(spec, &setup, &motions), motions })
}

/// `spec` with these effects in place of its own, and each shape where it was at the collision:
/// effects that put the centre of mass off the shape's move the former.
///
/// # Errors
/// An effect doesn't fit the bodies.
pub(crate) fn with_effects(
    spec: &SimulationSpec,
    effects: Vec<EffectSpec>,
) -> Result<SimulationSpec> {
    let mut changed = SimulationSpec { effects, ..spec.clone() };
    let (was, is) = (shape_centres_in_world(spec)?, shape_centres_in_world(&changed)?);
    for ((index, was), (_, is)) in was.into_iter().zip(is) {
        if let Some(position) = &mut changed.bodies[index].position {
            *position = (Vector3::from(*position) + was - is).into();
        }
    }
    Ok(changed)
}

/// Of the dynamic bodies at the collision, with their places in `spec`.
fn shape_centres_in_world(spec: &SimulationSpec) -> Result<Vec<(usize, Vector3<f64>)>> {
    let (stage, model) = staged(spec)?;
    let centre = |(number, actor): (usize, &check::Actor)| {
        let centre = match &model {
            Some(model) => model.shape_centre_in_world(number)?,
            None => actor.before.position_in_world,
        };
        Ok((actor.index, centre))
    };
    stage.actors().enumerate().map(centre).collect()
}

/// How the dynamic bodies move, a first: **J** acts on a, −**J** on b.
fn motions(spec: &SimulationSpec, setup: &Setup) -> Result<Vec<Motion>> {
    let before = setup.stage.before();
    let gravity_in_world = -spec.gravity * setup.stage.up_in_world.into_inner();
    let motion = |before: RigidBody, after: RigidBody, forced: Option<Forced>| Motion {
        collision_time_s: spec.collision.time,
        gravity_in_world,
        before,
        after,
        forced,
    };
    let impulse_on_a = setup.strike.impulse_on_a;
    let Some(model) = &setup.model else {
        let point = &setup.strike.contact.point_in_world;
        let pushed = before.into_iter().zip([impulse_on_a, -impulse_on_a]);
        return Ok(pushed
            .map(|(body, push)| motion(body, body.pushed(point, &push), None))
            .collect());
    };
    let launched = model.launched(&before, &impulse_on_a)?;
    let model = Arc::new(model.clone());
    let forced = before.into_iter().zip(launched).enumerate().map(|(index, (body, to))| {
        motion(body, to.after, Some(Forced { model: Arc::clone(&model), index }))
    });
    Ok(forced.collect())
}
