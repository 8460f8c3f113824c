//! A result's own motion, as the solver flies it: from the numbers in its file alone.

use nalgebra::Vector3;

use super::acting::Instance;
use super::model::refined_scene;
use crate::bridge::refined::ffi::{
    FlownState, RefinedMotion, RefinedScene, RefinedUnknowns, fly, launch, pose_times,
};
use crate::effect::Hook;
use crate::reconstruct::{BodyResult, Reconstruction, solver_error};
use crate::rigid_body::RigidBody;
use crate::rigid_body::quaternion::from_wxyz;
use crate::{Error, ErrorKind, Result, Scene};

/// As far as the solver follows a spin: three thousand turns.
const MOST_TURNING_RAD: f64 = 2e4;

/// A body when a pose of it was annotated.
pub(crate) struct FlownPose {
    pub(crate) is_after: bool,
    pub(crate) state: FlownState,
    /// Principal moments of unit mass, with the effects' factors, m²; `None` where the result
    /// doesn't tell the spin.
    pub(crate) inertia_per_mass: Option<Vector3<f64>>,
}

/// Each body of `scene` at each of its poses, in their order, by the motion in `result`: outwards
/// from the states before and after the collision, at `collision_time_s`.
///
/// # Errors
/// The result's effects or gravity can't be the scene's, or its motion can't be followed.
pub(crate) fn flown(
    scene: &Scene,
    result: &Reconstruction,
    collision_time_s: f64,
) -> Result<Vec<Vec<FlownPose>>> {
    let (refined, parameters) = model(scene, result)?;
    let [before, after] = [false, true].map(|is_after| {
        Side::new(scene, result, &refined, &parameters, collision_time_s, is_after)
    });
    let (before, after) = (before?, after?);
    let times_s = pose_times(&refined, &before.unknowns).map_err(solver_error)?;
    let mut times_s = times_s.into_iter();
    let mut bodies = Vec::new();
    for (index, body) in scene.bodies().iter().enumerate() {
        let stamps_s = body.observations.iter().map(|pose| pose.time_s);
        // The model's time, which effects may move, tells the side.
        let (late, early): (Vec<_>, Vec<_>) = stamps_s
            .zip(times_s.by_ref())
            .enumerate()
            .partition(|(_, (_, time_s))| *time_s >= collision_time_s);
        let mut poses = Vec::new();
        for (side, of_side) in [(&before, early), (&after, late)] {
            let stamps_s: Vec<f64> = of_side.iter().map(|(_, (stamp_s, _))| *stamp_s).collect();
            let flown = side.fly(index, &stamps_s);
            let flown = flown.map_err(|error| error.at(format!("bodies[{index}]")))?;
            poses.extend(of_side.iter().map(|(place, _)| *place).zip(flown));
        }
        poses.sort_by_key(|(place, _)| *place);
        bodies.push(poses.into_iter().map(|(_, pose)| pose).collect());
    }
    Ok(bodies)
}

/// When each pose of `scene`, body by body, is in the model: effects may move stamps.
///
/// # Errors
/// As [`flown`].
pub(crate) fn model_times(
    scene: &Scene,
    result: &Reconstruction,
    collision_time_s: f64,
) -> Result<Vec<f64>> {
    let (refined, parameters) = model(scene, result)?;
    let side = Side::new(scene, result, &refined, &parameters, collision_time_s, false)?;
    pose_times(&refined, &side.unknowns).map_err(solver_error)
}

/// The result's model of the scene but for what strikes at the collision, which its states before
/// and after tell already; and the effects' parameters.
fn model(scene: &Scene, result: &Reconstruction) -> Result<(RefinedScene, Vec<f64>)> {
    let mut refined = refined_scene(scene, scene.least_noise(), 1.0);
    refined.gravity_m_s2 = result.gravity.map_or(refined.gravity_m_s2, |g| Vector3::from(g).norm());
    let mut parameters = Vec::new();
    for (index, active) in result.effects.iter().enumerate() {
        let (instance, values) = Instance::of_result(scene, active, &format!("effects[{index}]"))?;
        instance.act_on(&mut refined);
        parameters.extend(values);
    }
    let strikes = [Hook::Impulse, Hook::ImpulsePoint, Hook::AngularImpulse].map(|hook| hook as u8);
    refined.laws.retain(|law| !strikes.contains(&law.hook));
    Ok((refined, parameters))
}

/// All bodies on one side of the collision.
struct Side {
    is_after: bool,
    refined: RefinedScene,
    unknowns: RefinedUnknowns,
    inertia_per_mass: Vec<Vector3<f64>>,
}

impl Side {
    fn new(
        scene: &Scene,
        result: &Reconstruction,
        refined: &RefinedScene,
        parameters: &[f64],
        collision_time_s: f64,
        is_after: bool,
    ) -> Result<Side> {
        let mut refined = refined.clone();
        let log_mass_ratio = result.mass_ratio.as_ref().and_then(|ratio| ratio.value).map(f64::ln);
        let mut unknowns = RefinedUnknowns {
            bodies: result.bodies.iter().map(|body| motion(body, is_after)).collect(),
            collision_time_s,
            tilt: tilt(&refined, result)?,
            impulse: [0.0; 3],
            contact_point: [0.0; 3],
            contact_basis: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            log_mass_ratio: log_mass_ratio.unwrap_or(0.0),
            parameters: parameters.to_vec(),
        };
        let launches = launch(&refined, &unknowns).map_err(solver_error)?;
        let inertia_per_mass: Vec<_> =
            launches.iter().map(|body| Vector3::from(body.inertia_per_mass)).collect();
        for (index, body) in result.bodies.iter().enumerate() {
            let omega = match is_after {
                true => body.angular_velocity_after,
                false => body.angular_velocity_before,
            };
            let omega = body.orientation.and(omega);
            refined.bodies[index].has_spin = omega.is_some();
            let motion = &mut unknowns.bodies[index];
            let solid = RigidBody {
                world_from_body: from_wxyz(motion.orientation),
                principal_inertia: inertia_per_mass[index],
                ..RigidBody::solid(&scene.bodies()[index].shape, 1.0)
            };
            let omega = omega.map_or_else(Vector3::zeros, Vector3::from);
            motion.spin_before = solid.spinning(&omega).angular_momentum_in_world.into();
        }
        Ok(Side { is_after, refined, unknowns, inertia_per_mass })
    }

    fn fly(&self, body: usize, stamps_s: &[f64]) -> Result<Vec<FlownPose>> {
        let inertia_per_mass = self.inertia_per_mass[body];
        let away_s = |stamp_s: &f64| (stamp_s - self.unknowns.collision_time_s).abs();
        let farthest_s = stamps_s.iter().map(away_s).fold(0.0, f64::max);
        let spin = Vector3::from(self.unknowns.bodies[body].spin_before).norm();
        let turning_rad = spin / inertia_per_mass.min() * farthest_s;
        if turning_rad.is_nan() || turning_rad > MOST_TURNING_RAD {
            let problem = format!("turns {turning_rad:.0e} rad until the farthest pose");
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("check the spin, in rad/s; no flight turns so often"));
        }
        let states = fly(&self.refined, &self.unknowns, body, stamps_s).map_err(solver_error)?;
        if !states.iter().all(is_finite) {
            return Err(Error::new(ErrorKind::Invalid, "flies beyond all numbers")
                .mend("check the result's effects: a force may grow without limit"));
        }
        let inertia_per_mass = self.refined.bodies[body].has_spin.then_some(inertia_per_mass);
        let pose = |state| FlownPose { is_after: self.is_after, state, inertia_per_mass };
        Ok(states.into_iter().map(pose).collect())
    }
}

/// A body's numbers on one side, without its spin.
fn motion(body: &BodyResult, is_after: bool) -> RefinedMotion {
    RefinedMotion {
        position: body.position,
        velocity_before: if is_after { body.velocity_after } else { body.velocity_before },
        spin_before: [0.0; 3],
        orientation: body.orientation.unwrap_or([1.0, 0.0, 0.0, 0.0]),
    }
}

/// How far the result's gravity is from the scene's direction, in the solver's numbers.
fn tilt(refined: &RefinedScene, result: &Reconstruction) -> Result<[f64; 2]> {
    let Some(gravity) = result.gravity.map(Vector3::from).filter(|g| g.norm() > 0.0) else {
        return Ok([0.0; 2]);
    };
    let down = gravity.dot(&Vector3::from(refined.down));
    if down <= 0.0 {
        let where_to = if down < 0.0 { "upwards" } else { "sideways" };
        return Err(Error::invalid("gravity", format!("points {where_to} by this scene's `up`"))
            .mend("name the scene that this result was made from, or reconstruct it again"));
    }
    Ok(refined.across.map(|across| gravity.dot(&Vector3::from(across)) / down))
}

fn is_finite(state: &FlownState) -> bool {
    let vectors = [state.velocity, state.spin, state.seen_position];
    let quaternions = [state.orientation, state.seen_orientation];
    vectors.iter().flatten().chain(quaternions.iter().flatten()).all(|number| number.is_finite())
}
