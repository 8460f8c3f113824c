//! The energy of the C++ side (SMASH eq. 16) against the physics that it stands for.
//!
//! The cost that a solve starts with is the energy at its start: that evaluates it anywhere.

mod collision;
mod flight;
mod input;
mod truth;

use nalgebra::{UnitQuaternion, Vector3};

use super::internal::InternalScene;
use crate::Scene;
use crate::bridge::paper::ffi::{
    self, PaperBodyUnknowns, PaperFlight, PaperPhase, PaperScene, PaperUnknowns,
};
use crate::rigid_body::RigidBody;
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};
use crate::simulate::{Sampling, SimulationSpec, simulate};

const PHASES: [PaperPhase; 3] =
    [PaperPhase::Trajectories, PaperPhase::Impulse, PaperPhase::ContactPoint];
/// Half the weights of SMASH section 4.1: the cost of a residual of length 1.
const HALF_SOFT: f64 = 0.1 / 2.0;
const HALF_OBSERVED: f64 = 4.0 / 2.0;
/// Rounding of sums of some hundred squares, with a thousandfold margin.
const ROUNDING: f64 = 1e-11;

/// A collision as the energy sees it, and unknowns to evaluate it at.
#[derive(Clone)]
struct Case {
    scene: PaperScene,
    collision_frames: f64,
    unknowns: PaperUnknowns,
}

impl Case {
    fn cost(&self, phase: PaperPhase) -> f64 {
        ffi::solve_paper_phase(&self.scene, self.collision_frames, phase, &self.unknowns)
            .unwrap()
            .cost_initial
    }

    fn costs(&self) -> [f64; 3] {
        PHASES.map(|phase| self.cost(phase))
    }

    fn edited(&self, edit: impl Fn(&mut Case)) -> Case {
        let mut case = self.clone();
        edit(&mut case);
        case
    }

    /// Every annotation as the energy itself predicts it: the unknowns are then its exact zero.
    fn seen_as_predicted(mut self) -> Case {
        for index in 0..self.scene.bodies.len() {
            let observations = &self.scene.bodies[index].observations;
            let times: Vec<f64> = observations.iter().map(|o| o.time_frames).collect();
            let (scene, unknowns) = (&self.scene, &self.unknowns);
            let poses =
                ffi::predict_paper_poses(scene, self.collision_frames, unknowns, index, &times)
                    .unwrap();
            for (seen, pose) in self.scene.bodies[index].observations.iter_mut().zip(poses) {
                seen.position = pose.position;
                seen.orientation = pose.orientation;
            }
        }
        self
    }
}

/// Poses 2, 4 and 6 sixtieths of a second from the collision, on either side: few keep it fast.
fn seen_briefly(mut spec: SimulationSpec, fps: f64) -> SimulationSpec {
    spec.collision.time = 0.75;
    spec.fps = Some(fps);
    let offsets = [-6.0, -4.0, -2.0, 2.0, 4.0, 6.0];
    spec.observations = Sampling::Times(offsets.map(|frame| 0.75 + frame / 60.0).into());
    spec
}

/// A simulated collision, at its true unknowns.
fn simulated(spec: &SimulationSpec) -> Case {
    /// β_y1 is free where β_x is 0: any value will do, and 0 would hide mistakes.
    const HEADING: f64 = 0.3;
    let simulation = simulate(spec).unwrap();
    let truth = &simulation.truth;
    let scene = Scene::from_file(simulation.scene_file).unwrap();
    let internal = InternalScene::new(&scene).unwrap();
    let fps = internal.paper.frames_per_second;
    let to_frame = |v: Vector3<f64>| internal.frame.vector_from_world(&v);
    let flight = |body: &RigidBody| {
        let [x, down, z] = to_frame(body.velocity_in_world);
        PaperFlight {
            parabola: [down / fps, x.hypot(z) / fps, (-z).atan2(x) - HEADING],
            angular_momentum: to_frame(body.angular_momentum_in_world),
        }
    };
    let bodies = simulation.motions.iter().map(|motion| PaperBodyUnknowns {
        position: to_frame(motion.before.position_in_world),
        orientation: to_wxyz(
            &internal.frame.orientation_from_world(&motion.before.world_from_body),
        ),
        before: flight(&motion.before),
        after: flight(&motion.after),
    });
    let unknowns = PaperUnknowns {
        bodies: bodies.collect(),
        tilt: [0.0, HEADING],
        contact_point: to_frame(truth.contact_point.into()),
        impulse: to_frame(truth.impulse.into()),
        mass_ratio: truth.mass_ratio.unwrap_or(1.0),
    };
    Case { collision_frames: truth.collision_time * fps, unknowns, scene: internal.paper }
}

fn cuboids(seed: u64) -> Case {
    simulated(&seen_briefly(SimulationSpec::random_cuboids(seed), 60.0))
}

/// Two balls push each other along the line of their centres, where phase 2 puts the contact: with
/// their spins seen, all three phases are true.
fn spinning_balls(fps: f64) -> Case {
    let mut spec = seen_briefly(SimulationSpec::random_balls(1), fps);
    for body in &mut spec.bodies {
        body.measure_orientation = Some(true);
    }
    simulated(&spec)
}

fn turn(orientation: &mut [f64; 4], angle: f64) {
    let by = UnitQuaternion::from_scaled_axis(Vector3::new(0.6, 0.0, 0.8) * angle);
    *orientation = to_wxyz(&(by * from_wxyz(*orientation)));
}

fn move_across_impulse(unknowns: &mut PaperUnknowns, by_m: f64) {
    let across = Vector3::from(unknowns.impulse).cross(&Vector3::x()).normalize();
    unknowns.contact_point = (Vector3::from(unknowns.contact_point) + by_m * across).into();
}
