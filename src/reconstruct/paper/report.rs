//! From the solver's unknowns to a reconstruction in the world, in SI units.

use nalgebra::{UnitVector3, Vector3};

use super::super::PaperOptions;
use super::super::flags::{Doubts, flags};
use super::super::result::{BodyResult, Estimate, Preset, RESULT_SCHEMA, Reconstruction};
use super::super::scatter::position_scatter_m;
use super::fit::fit;
use super::internal::InternalScene;
use super::phases::Solved;
use super::push;
use super::states::{States, settle_on_line, states};
use crate::rigid_body::Contact;
use crate::rigid_body::quaternion::to_wxyz;
use crate::{Result, Scene};

const NO_STD: &str = "the paper's weighted energy has no noise model, hence no standard deviation";
const NO_PARTNER: &str = "a single body without a plane: what it hit is not known";
const NO_IMPULSE: &str = "the jumps in velocity don't stand out of the noise";
const NO_APPROACH: &str = "the touching points had no normal velocity before";
const NO_SPIN: &str = "too few orientations are annotated to tell the rotation";
const NO_SURFACE: &str = "it needs the spins, and too few orientations are annotated";

/// The reconstruction that `solved` stands for.
pub(super) fn reconstruction(
    scene: &Scene,
    internal: &InternalScene,
    options: &PaperOptions,
    solved: &Solved,
) -> Result<Reconstruction> {
    let states = states(scene, internal, solved)?;
    let fit = fit(internal, solved, scene.noise())?;
    let jumps: Vec<f64> = states.iter().map(States::jump_m_s).collect();
    let push = push::visible(
        internal,
        solved,
        &jumps,
        scene.noise().map(|noise| noise.position),
        fit.position_rmse,
    );
    let impulse = world_vector(internal, solved.unknowns.impulse);
    let contact = contact(scene, internal, solved, &states, &impulse).filter(|_| push.any);
    let mass_ratio = (states.len() == 2).then(|| match push.any {
        true => estimate(solved.unknowns.mass_ratio),
        false => unknown(NO_IMPULSE),
    });
    let restitution = restitution(scene, contact, &states);
    let collision_time_s = internal.seconds(solved.collision_frames);
    let doubts = Doubts {
        mass_ratio: (states.len() == 2).then_some(solved.unknowns.mass_ratio),
        restitution: restitution.value,
        converged: solved.converged,
        push,
        scatter_m: position_scatter_m(scene, collision_time_s),
    };
    Ok(Reconstruction {
        schema: RESULT_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        preset: Preset::Paper,
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
        effects: Vec::new(),
        fit,
        phases: solved.phases.clone(),
        warnings: scene.warnings().iter().map(|warning| warning.text.clone()).collect(),
    })
}

fn world_vector(internal: &InternalScene, v: [f64; 3]) -> Vector3<f64> {
    internal.frame.vector_to_world(v.into())
}

/// Where and along which normal the bodies touched; `None` without an impulse.
fn contact(
    scene: &Scene,
    internal: &InternalScene,
    solved: &Solved,
    states: &[States],
    impulse: &Vector3<f64>,
) -> Option<Contact> {
    let normal = match scene.plane() {
        Some(plane) => Some(plane.normal_in_world),
        None => UnitVector3::try_new(*impulse, f64::MIN_POSITIVE),
    };
    let point = world_vector(internal, solved.unknowns.contact_point);
    normal.map(|normal| Contact {
        point_in_world: settle_on_line(scene, states, point, impulse),
        normal_in_world: normal,
    })
}

/// A jump in spin tells the line of action; else only that of balls, which passes their centres.
fn tells_contact_point(internal: &InternalScene, states: &[States]) -> bool {
    internal.paper.bodies.iter().any(|body| body.has_spin)
        || states.iter().all(States::surface_velocity_known)
}

fn restitution(scene: &Scene, contact: Option<Contact>, states: &[States]) -> Estimate {
    if states.len() == 1 && scene.plane().is_none() {
        return unknown(NO_PARTNER);
    }
    let Some(contact) = contact else { return unknown(NO_IMPULSE) };
    if !states.iter().all(States::surface_velocity_known) {
        return unknown(NO_SURFACE);
    }
    let partner = states.get(1);
    let value = contact.restitution(
        (&states[0].before, partner.map(|b| &b.before)),
        (&states[0].after, partner.map(|b| &b.after)),
    );
    if value.is_finite() { estimate(value) } else { unknown(NO_APPROACH) }
}

fn body_result(name: &str, states: &States) -> BodyResult {
    let States { before, after, spin_before_known, spin_after_known, .. } = states;
    let if_known = |known: &bool, v: Vector3<f64>| known.then(|| v.into());
    let pose_known = *spin_before_known || *spin_after_known;
    BodyResult {
        name: name.to_string(),
        position: before.position_in_world.into(),
        orientation: pose_known.then(|| to_wxyz(&before.world_from_body)),
        velocity_before: before.velocity_in_world.into(),
        velocity_after: after.velocity_in_world.into(),
        angular_velocity_before: if_known(spin_before_known, before.omega_in_world()),
        angular_velocity_after: if_known(spin_after_known, after.omega_in_world()),
        angular_momentum_before: if_known(spin_before_known, before.angular_momentum_in_world),
        angular_momentum_after: if_known(spin_after_known, after.angular_momentum_in_world),
        reason: (!(*spin_before_known && *spin_after_known)).then(|| NO_SPIN.to_string()),
    }
}

fn estimate(value: f64) -> Estimate {
    Estimate { value: Some(value), std: None, reason: Some(NO_STD.to_string()) }
}

fn unknown(reason: &str) -> Estimate {
    Estimate { value: None, std: None, reason: Some(reason.to_string()) }
}
