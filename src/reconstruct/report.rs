//! From the solver's unknowns to a reconstruction in the world, in SI units.

use nalgebra::{UnitVector3, Vector3};

use super::fit::fit;
use super::flags::{Flag, is_poor, mass_ratio_at_bound};
use super::gravity_frame::{from_wxyz, to_wxyz};
use super::internal::InternalScene;
use super::phases::Solved;
use super::result::{BodyResult, Estimate, RESULT_SCHEMA, Reconstruction};
use super::{Options, SegmentCriterion, push};
use crate::bridge::ffi::{PaperFlight, PaperObservation};
use crate::rigid_body::{Contact, RigidBody};
use crate::scene::Shape;
use crate::{Result, Scene};

const NO_STD: &str = "the paper's weighted energy has no noise model, hence no standard deviation";
const NO_PARTNER: &str = "a single body without a plane: what it hit is not known";
const NO_IMPULSE: &str = "the jumps in velocity don't stand out of the noise";
const NO_APPROACH: &str = "the touching points had no normal velocity before";
const NO_SPIN: &str = "too few orientations are annotated to tell the rotation";

/// A body just before and just after the collision, in the world.
struct States {
    before: RigidBody,
    after: RigidBody,
}

impl States {
    fn jump_m_s(&self) -> f64 {
        (self.after.velocity_in_world - self.before.velocity_in_world).norm()
    }
}

/// The reconstruction that `solved` stands for.
pub(super) fn reconstruction(
    scene: &Scene,
    internal: &InternalScene,
    options: &Options,
    solved: &Solved,
) -> Result<Reconstruction> {
    let states: Vec<States> =
        (0..scene.bodies().len()).map(|index| states(scene, internal, solved, index)).collect();
    let fit = fit(internal, solved, scene.noise())?;
    let poor = is_poor(&fit, shortest_extent_m(scene));
    let impulse = world_vector(internal, solved.unknowns.impulse);
    let contact_point = world_vector(internal, solved.unknowns.contact_point);
    let normal = match scene.plane() {
        Some(plane) => Some(plane.normal_in_world),
        None => UnitVector3::try_new(impulse, f64::MIN_POSITIVE),
    };
    let contact =
        normal.map(|normal| Contact { point_in_world: contact_point, normal_in_world: normal });
    let jumps: Vec<f64> = states.iter().map(States::jump_m_s).collect();
    let pushed = push::is_visible(internal, solved, &jumps, fit.position_rmse);
    let mass_ratio = (states.len() == 2).then(|| match pushed {
        true => estimate(solved.unknowns.mass_ratio),
        false => unknown(NO_IMPULSE),
    });
    let restitution = restitution(contact.filter(|_| pushed), &states, scene.plane().is_some());
    let bodies = (0..states.len()).map(|i| body_result(scene, internal, solved, i, &states[i]));
    Ok(Reconstruction {
        schema: RESULT_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        preset: "paper".to_string(),
        segment_by: match options.segment_by {
            SegmentCriterion::Distance => "distance".to_string(),
            SegmentCriterion::Cost => "cost".to_string(),
        },
        flags: flags(solved, pushed, &states, &restitution, poor),
        mass_ratio,
        restitution,
        collision_time: estimate(internal.seconds(solved.collision_frames)),
        contact_point: contact_point.into(),
        impulse: impulse.into(),
        normal: normal.map(|normal| normal.into_inner().into()),
        bodies: bodies.collect(),
        effects: Vec::new(),
        fit,
        phases: solved.phases.clone(),
        warnings: scene.warnings().iter().map(|warning| warning.text.clone()).collect(),
    })
}

fn world_vector(internal: &InternalScene, v: [f64; 3]) -> Vector3<f64> {
    internal.frame.vector_to_world(v.into())
}

fn states(scene: &Scene, internal: &InternalScene, solved: &Solved, index: usize) -> States {
    let unknown = &solved.unknowns.bodies[index];
    let mass = if index == 0 { 1.0 } else { solved.unknowns.mass_ratio };
    let orientation = from_wxyz(unknown.orientation);
    let pose = RigidBody {
        position_in_world: world_vector(internal, unknown.position),
        world_from_body: internal.frame.orientation_to_world(&orientation),
        ..RigidBody::solid(&scene.bodies()[index].shape, mass)
    };
    let moving = |flight: &PaperFlight| RigidBody {
        velocity_in_world: collision_velocity(internal, solved, flight),
        angular_momentum_in_world: world_vector(internal, flight.angular_momentum),
        ..pose
    };
    States { before: moving(&unknown.before), after: moving(&unknown.after) }
}

/// v(t_c) = fps R (b₃, b₂, 0) (SMASH eq. 7, in the order of its eq. 5).
fn collision_velocity(
    internal: &InternalScene,
    solved: &Solved,
    flight: &PaperFlight,
) -> Vector3<f64> {
    let [b2, b3, azimuth] = flight.parabola;
    let [tilt, heading] = solved.unknowns.tilt;
    let turn = |axis, angle| nalgebra::UnitQuaternion::from_axis_angle(&axis, angle);
    let rotation = turn(Vector3::y_axis(), heading)
        * turn(Vector3::x_axis(), tilt)
        * turn(Vector3::y_axis(), azimuth);
    let per_frame = rotation * Vector3::new(b3, b2, 0.0);
    internal.frame.vector_to_world(per_frame * internal.paper.frames_per_second)
}

fn restitution(contact: Option<Contact>, states: &[States], on_plane: bool) -> Estimate {
    if states.len() == 1 && !on_plane {
        return unknown(NO_PARTNER);
    }
    let Some(contact) = contact else {
        return unknown(NO_IMPULSE);
    };
    let partner = states.get(1);
    let value = contact.restitution(
        (&states[0].before, partner.map(|b| &b.before)),
        (&states[0].after, partner.map(|b| &b.after)),
    );
    if value.is_finite() { estimate(value) } else { unknown(NO_APPROACH) }
}

fn flags(solved: &Solved, pushed: bool, states: &[States], c: &Estimate, poor: bool) -> Vec<Flag> {
    let two_bodies = states.len() == 2;
    let out_of_range = c.value.is_some_and(|c| !(0.0..=1.0).contains(&c));
    [
        (two_bodies && mass_ratio_at_bound(solved.unknowns.mass_ratio), Flag::MassRatioAtBound),
        (out_of_range, Flag::RestitutionOutOfRange),
        (!solved.converged, Flag::NotConverged),
        (two_bodies && !pushed, Flag::MassRatioUnidentifiable),
        (poor, Flag::PoorFit),
    ]
    .into_iter()
    .filter_map(|(raised, flag)| raised.then_some(flag))
    .collect()
}

fn shortest_extent_m(scene: &Scene) -> f64 {
    let extent = |shape: &Shape| match *shape {
        Shape::Box { size: [x, y, z] } => x.min(y).min(z),
        Shape::Sphere { radius } => 2.0 * radius,
    };
    scene.bodies().iter().map(|body| extent(&body.shape)).fold(f64::INFINITY, f64::min)
}

fn body_result(
    scene: &Scene,
    internal: &InternalScene,
    solved: &Solved,
    index: usize,
    states: &States,
) -> BodyResult {
    let observations = &internal.paper.bodies[index].observations;
    let seen = |before: bool| {
        let on_side = |o: &&PaperObservation| (o.time_frames < solved.collision_frames) == before;
        observations.iter().filter(on_side).filter(|o| o.has_orientation).count()
    };
    let (seen_before, seen_after) = (seen(true), seen(false));
    // Two orientations tell a flight's spin; one does where the other side gives the pose at t_c.
    let spin_before_known = seen_before >= 2 || (seen_before == 1 && seen_after >= 2);
    let spin_after_known = seen_after >= 2 || (seen_after == 1 && seen_before >= 2);
    let pose_known = spin_before_known || spin_after_known;
    let vector = |known: bool, v: Vector3<f64>| known.then(|| v.into());
    BodyResult {
        name: scene.bodies()[index].name.clone(),
        position: states.before.position_in_world.into(),
        orientation: pose_known.then(|| to_wxyz(&states.before.world_from_body)),
        velocity_before: states.before.velocity_in_world.into(),
        velocity_after: states.after.velocity_in_world.into(),
        angular_velocity_before: vector(spin_before_known, states.before.omega_in_world()),
        angular_velocity_after: vector(spin_after_known, states.after.omega_in_world()),
        angular_momentum_before: vector(spin_before_known, states.before.angular_momentum_in_world),
        angular_momentum_after: vector(spin_after_known, states.after.angular_momentum_in_world),
        reason: (!(spin_before_known && spin_after_known)).then(|| NO_SPIN.to_string()),
    }
}

fn estimate(value: f64) -> Estimate {
    Estimate { value: Some(value), std: None, reason: Some(NO_STD.to_string()) }
}

fn unknown(reason: &str) -> Estimate {
    Estimate { value: None, std: None, reason: Some(reason.to_string()) }
}
