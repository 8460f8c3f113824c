//! The bodies with the effects that act on them, in the terms of the solver's bridge: what the
//! reconstruction fits is what the simulation runs.

use nalgebra::Vector3;

use super::check::Stage;
use super::observe::{Pose, scene_file};
use super::{EffectSpec, SimulationSpec};
use crate::bridge::refined::ffi::{
    ActingLaw, FlownState, RefinedMotion, RefinedScene, RefinedUnknowns, fly, launch, pose_times,
};
use crate::effect::{Hook, Need};
use crate::reconstruct::refined::acting::Acting;
use crate::reconstruct::refined::model::{across, refined_scene};
use crate::rigid_body::RigidBody;
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};
use crate::scene::{Noise, Scene};
use crate::{Error, Result};

/// Flights with effects are integrated in steps of milliseconds; no thrown body flies so long.
const LONGEST_FLIGHT_S: f64 = 1000.0;

/// A model with all its numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Model {
    effects: Vec<EffectSpec>,
    refined: RefinedScene,
    /// Which laws say how bodies move, and not how they are seen.
    moving: RefinedScene,
    /// Which laws say where a body's annotated centre is.
    shaping: RefinedScene,
    unknowns: RefinedUnknowns,
}

/// A body just after the collision.
pub(super) struct Launched {
    pub after: RigidBody,
    /// After what the contact alone does.
    pub contact_after: RigidBody,
}

impl Model {
    /// The model of `spec`, before any impulse; `None` without effects.
    pub fn new(spec: &SimulationSpec, stage: &Stage) -> Result<Option<Model>> {
        if spec.effects.is_empty() {
            return Ok(None);
        }
        let outline = outline(spec, stage)?;
        // The noise plays no part in how bodies move, nor does gravity's uncertainty.
        let mut refined = refined_scene(&outline, Noise { position: 1.0, orientation: 1.0 }, 1.0);
        // A ball spins, whether or not that is seen.
        refined.bodies.iter_mut().for_each(|body| body.has_spin = true);
        let mut acting = Vec::new();
        for (index, effect) in spec.effects.iter().enumerate() {
            for instance in effect.instances(&format!("effects[{index}]"), &outline)? {
                acting.push(instance.act_on(&mut refined));
            }
        }
        let is_of_the_camera = |law: &ActingLaw| {
            acting.get(law.effect).is_some_and(|a| a.instance.effect.needs.contains(&Need::Camera))
        };
        let moving = only(&refined, |law| {
            ![Hook::Time, Hook::Position, Hook::Orientation].map(number).contains(&law.hook)
        });
        let shaping =
            only(&refined, |law| law.hook == number(Hook::Position) && !is_of_the_camera(law));
        let unknowns = unknowns(spec, stage, &acting);
        let effects = acting.iter().map(|acting| active(acting, &outline)).collect();
        let model = Model { effects, refined, moving, shaping, unknowns };
        model.check_times(&outline)?;
        Ok(Some(model))
    }

    /// What acts, one by one.
    pub fn effects(&self) -> &[EffectSpec] {
        &self.effects
    }

    /// Gives `body` (by its index among the dynamic ones) the inertia that it has with the effects,
    /// at the same angular velocity.
    pub fn complete(&mut self, index: usize, body: &mut RigidBody) -> Result<()> {
        let launches = launch(&self.moving, &self.unknowns).map_err(not_computed)?;
        let omega_in_world = body.omega_in_world();
        body.principal_inertia = body.mass * Vector3::from(launches[index].inertia_per_mass);
        *body = body.spinning(&omega_in_world);
        self.unknowns.bodies[index] = bridged(body);
        Ok(())
    }

    /// Sets the impulse on a that the contact makes.
    pub fn strike(&mut self, impulse_on_a: &Vector3<f64>) {
        self.unknowns.impulse = (*impulse_on_a).into();
    }

    /// Whether any effect adds to the contact's own impulse.
    pub fn has_contact_laws(&self) -> bool {
        self.refined.laws.iter().any(|law| law.hook == number(Hook::ImpulsePoint))
    }

    /// The bodies, given just `before` the collision, just after `impulse_on_a` and all that goes
    /// with it.
    pub fn launched(
        &self,
        before: &[RigidBody],
        impulse_on_a: &Vector3<f64>,
    ) -> Result<Vec<Launched>> {
        let unknowns = RefinedUnknowns { impulse: (*impulse_on_a).into(), ..self.unknowns.clone() };
        let launches = launch(&self.moving, &unknowns).map_err(not_computed)?;
        let launched = |(body, to): (&RigidBody, &crate::bridge::refined::ffi::RefinedLaunch)| {
            let moving = |velocity: [f64; 3], spin: [f64; 3]| RigidBody {
                velocity_in_world: velocity.into(),
                angular_momentum_in_world: body.mass * Vector3::from(spin),
                ..*body
            };
            Launched {
                after: moving(to.velocity_after, to.spin_after),
                contact_after: moving(to.contact_velocity_after, to.contact_spin_after),
            }
        };
        Ok(before.iter().zip(&launches).map(launched).collect())
    }

    /// Where the centre of the shape of body `index` is at the collision; the effects may put the
    /// centre of mass off it.
    pub fn shape_centre_in_world(&self, index: usize) -> Result<Vector3<f64>> {
        let at = self.unknowns.collision_time_s;
        let states = fly(&self.shaping, &self.unknowns, index, &[at]).map_err(not_computed)?;
        Ok(states[0].seen_position.into())
    }

    /// How body `index`, which is `body` at the collision, truly moves at `time_s`.
    pub fn state(&self, index: usize, body: &RigidBody, time_s: f64) -> Result<RigidBody> {
        let states = fly(&self.moving, &self.unknowns, index, &[time_s]).map_err(not_computed)?;
        let FlownState { position, velocity, orientation, spin, .. } = states[0];
        Ok(RigidBody {
            position_in_world: position.into(),
            velocity_in_world: velocity.into(),
            world_from_body: from_wxyz(orientation),
            angular_momentum_in_world: body.mass * Vector3::from(spin),
            ..*body
        })
    }

    /// The poses of body `index` that are annotated with these stamps.
    pub fn seen(&self, index: usize, stamps_s: &[f64]) -> Result<Vec<Pose>> {
        let states = fly(&self.refined, &self.unknowns, index, stamps_s).map_err(not_computed)?;
        let pose = |state: &FlownState| Pose {
            position: state.seen_position,
            orientation: state.seen_orientation,
        };
        let poses: Vec<Pose> = states.iter().map(pose).collect();
        let numbers = poses.iter().flat_map(|pose| pose.position.iter().chain(&pose.orientation));
        if numbers.into_iter().all(|number| number.is_finite()) {
            return Ok(poses);
        }
        Err(Error::invalid("effects", "let a body's motion grow beyond all bounds").mend(MEND))
    }

    fn check_times(&self, outline: &Scene) -> Result<()> {
        let times_s = pose_times(&self.refined, &self.unknowns).map_err(not_computed)?;
        let off_s = |time_s: &f64| (time_s - self.unknowns.collision_time_s).abs();
        let farthest_s = times_s.iter().map(off_s).fold(0.0, f64::max);
        if farthest_s <= LONGEST_FLIGHT_S {
            return Ok(());
        }
        let names: Vec<&str> = outline.bodies().iter().map(|body| body.name.as_str()).collect();
        let problem = format!("see {} up to {farthest_s:.0} s off the collision", names.join(", "));
        Err(Error::invalid("observations", problem)
            .mend(format!("with effects, keep within {LONGEST_FLIGHT_S} s of it")))
    }
}

const MEND: &str = "give weaker effects: parameters are in SI units";

fn not_computed(error: cxx::Exception) -> Error {
    Error::invalid("effects", format!("can't be computed: {}", error.what())).mend(MEND)
}

/// The scene without its motion: each body where it collides, whenever it is seen.
fn outline(spec: &SimulationSpec, stage: &Stage) -> Result<Scene> {
    let poses = stage.actors().map(|actor| {
        let body = &actor.before;
        let pose = Pose {
            position: body.position_in_world.into(),
            orientation: to_wxyz(&body.world_from_body),
        };
        vec![pose; actor.instants.len()]
    });
    Scene::from_file(scene_file(spec, stage, &poses.collect::<Vec<_>>()))
}

fn number(hook: Hook) -> u8 {
    hook as u8
}

fn only(refined: &RefinedScene, is_kept: impl Fn(&ActingLaw) -> bool) -> RefinedScene {
    let mut few = refined.clone();
    few.laws.retain(is_kept);
    few
}

fn unknowns(spec: &SimulationSpec, stage: &Stage, acting: &[Acting]) -> RefinedUnknowns {
    let any = Vector3::x();
    RefinedUnknowns {
        bodies: stage.actors().map(|actor| bridged(&actor.before)).collect(),
        collision_time_s: spec.collision.time,
        tilt: [0.0; 2],
        impulse: [0.0; 3],
        contact_point: spec.collision.contact_point,
        contact_basis: [across(&any).into(), any.cross(&across(&any)).into()],
        log_mass_ratio: spec.mass_ratio.unwrap_or(1.0).ln(),
        parameters: acting.iter().flat_map(|acting| acting.instance.null()).collect(),
    }
}

/// A body just before the collision, as the bridge takes it.
fn bridged(body: &RigidBody) -> RefinedMotion {
    RefinedMotion {
        position: body.position_in_world.into(),
        velocity_before: body.velocity_in_world.into(),
        spin_before: (body.angular_momentum_in_world / body.mass).into(),
        orientation: to_wxyz(&body.world_from_body),
    }
}

/// What acts on one body, or on all, for the truth.
fn active(acting: &Acting, outline: &Scene) -> EffectSpec {
    let instance = &acting.instance;
    EffectSpec {
        name: instance.effect.name.clone(),
        body: instance.body.map(|body| outline.bodies()[body].name.clone()),
        parameters: instance
            .fixed
            .iter()
            .map(|(name, values)| (name.clone(), values.clone().into()))
            .collect(),
    }
}
