//! From the solver's unknowns to a reconstruction in the world, in SI units.

use nalgebra::Vector3;

use super::super::collision::{NO_IMPULSE, States, body_result, contact, restitution};
use super::super::flags::{Doubts, flags};
use super::super::result::{Estimate, Preset, RESULT_SCHEMA, Reconstruction};
use super::super::scatter::position_scatter_m;
use super::super::{Options, PaperOptions};
use super::fit::fit;
use super::internal::InternalScene;
use super::phases::Solved;
use super::push;
use super::states::states;
use crate::{Result, Scene};

const NO_STD: &str = "the paper's weighted energy has no noise model, hence no standard deviation";

/// The reconstruction that `solved` stands for.
pub(super) fn reconstruction(
    scene: &Scene,
    internal: &InternalScene,
    options: &PaperOptions,
    solved: &Solved,
) -> Result<Reconstruction> {
    let states = states(scene, internal, solved)?;
    let fit = fit(scene, internal, solved)?;
    let jumps: Vec<f64> = states.iter().map(States::jump_m_s).collect();
    let push = push::visible(
        internal,
        solved,
        &jumps,
        scene.noise().map(|noise| noise.position),
        fit.position_rmse,
    );
    let impulse = world_vector(internal, solved.unknowns.impulse);
    let point = world_vector(internal, solved.unknowns.contact_point);
    let contact = contact(scene, &states, point, &impulse).filter(|_| push.any);
    let mass_ratio = (states.len() == 2).then(|| match push.any {
        true => estimate(solved.unknowns.mass_ratio),
        false => Estimate::unknown(NO_IMPULSE),
    });
    let restitution = match restitution(scene, contact, &states) {
        Ok(value) => estimate(value),
        Err(reason) => Estimate::unknown(reason),
    };
    let collision_time_s = internal.seconds(solved.collision_frames);
    let doubts = Doubts {
        mass_ratio: (states.len() == 2).then_some(solved.unknowns.mass_ratio),
        is_bounded: true,
        restitution: restitution.value,
        converged: solved.converged,
        push,
        scatter_m: position_scatter_m(scene, collision_time_s),
        ambiguous: false,
    };
    Ok(Reconstruction {
        schema: RESULT_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        preset: Preset::Paper,
        options: Some(Options::Paper(*options)),
        scene_fingerprint: Some(scene.fingerprint()),
        segment_by: options.segment_by,
        flags: flags(scene, &fit, &doubts),
        mass_ratio,
        restitution,
        collision_time: estimate(collision_time_s),
        contact_point: contact
            .filter(|_| tells_contact_point(internal, &states))
            .map(|contact| contact.point_in_world.into()),
        impulse: impulse.into(),
        normal: contact.map(|contact| contact.normal_in_world.into_inner().into()),
        bodies: scene.bodies().iter().zip(&states).map(|(b, s)| body_result(&b.name, s)).collect(),
        gravity: Some(gravity(scene, internal, solved.unknowns.tilt).into()),
        effects: Vec::new(),
        noise: None,
        uncertainty: None,
        alternatives: Vec::new(),
        outliers: Vec::new(),
        intervals: None,
        fit,
        phases: solved.phases.clone(),
        warnings: scene.warnings().iter().map(|warning| warning.text.clone()).collect(),
        setting: Some(scene.setting()),
    })
}

fn world_vector(internal: &InternalScene, v: [f64; 3]) -> Vector3<f64> {
    internal.frame.vector_to_world(v.into())
}

/// The acceleration that all parabolas share, in m/s²: along R e_y (SMASH eq. 6).
fn gravity(scene: &Scene, internal: &InternalScene, [tilt, heading]: [f64; 2]) -> Vector3<f64> {
    let along = [tilt.sin() * heading.sin(), tilt.cos(), tilt.sin() * heading.cos()];
    scene.gravity_m_s2() * world_vector(internal, along)
}

/// A jump in spin tells the line of action; else only that of balls, which passes their centres.
fn tells_contact_point(internal: &InternalScene, states: &[States]) -> bool {
    internal.paper.bodies.iter().any(|body| body.has_spin)
        || states.iter().all(States::surface_velocity_known)
}

fn estimate(value: f64) -> Estimate {
    Estimate { value: Some(value), std: None, interval_95: None, reason: Some(NO_STD.to_string()) }
}
