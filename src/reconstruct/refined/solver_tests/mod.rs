//! The C++ side of the refined solver: its derivatives, its curvature, and what it refuses.

mod at_a_pose;
mod derivatives;
mod effects;
mod input;
mod lost;

use nalgebra::{UnitQuaternion, Vector3};

use super::model::across;
use crate::Scene;
use crate::bridge::refined::ffi::{
    JacobianBy, RefinedBody, RefinedHold, RefinedMotion, RefinedPose, RefinedProblem, RefinedScene,
    RefinedUnknowns, RestitutionPin,
};
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};
use crate::rigid_body::{principal_inertia_per_mass, rotate_freely};
use crate::scene::Shape;

/// Poses in s; the collision is at 0.01.
const TIMES_S: [f64; 7] = [-0.35, -0.2, -0.1, 0.1, 0.2, 0.3, 0.4];
const COLLISION_S: f64 = 0.01;
const BOX: Shape = Shape::Box { size: [0.1, 0.2, 0.3] };
const BRICK: Shape = Shape::Box { size: [0.25, 0.08, 0.15] };
const CUBE: Shape = Shape::Box { size: [0.2, 0.2, 0.2] };
const BALL: Shape = Shape::Sphere { radius: 0.1 };

/// A collision, and unknowns at which its poses are seen exactly.
#[derive(Clone)]
struct Case {
    scene: RefinedScene,
    problem: RefinedProblem,
}

impl Case {
    /// The first body, a metre below the second; with `plane` one that slopes.
    fn new(shapes: &[Shape], plane: bool) -> Case {
        let down = -Vector3::y();
        let normal = Vector3::new(0.2, 1.0, -0.1).normalize();
        let impulse = if plane { 1.4 * normal } else { Vector3::new(0.4, -1.1, 0.3) };
        let motions = [
            RefinedMotion {
                position: [0.1, 1.0, -0.2],
                velocity_before: [1.0, -0.5, 0.3],
                spin_before: [0.0; 3],
                orientation: to_wxyz(&UnitQuaternion::from_euler_angles(0.3, -0.8, 1.9)),
            },
            RefinedMotion {
                position: [0.2, 1.2, -0.1],
                velocity_before: [-1.2, 0.2, -0.4],
                spin_before: [0.0; 3],
                orientation: to_wxyz(&UnitQuaternion::from_euler_angles(-1.1, 0.4, 0.2)),
            },
        ];
        let count = shapes.len();
        let bodies = shapes
            .iter()
            .map(|shape| RefinedBody {
                inertia_per_mass: principal_inertia_per_mass(shape).into(),
                poses: Vec::new(),
                has_spin: true,
                size: [0.1; 3],
            })
            .collect();
        Case {
            scene: RefinedScene {
                gravity_m_s2: 9.81,
                down: down.into(),
                across: [across(&down).into(), down.cross(&across(&down)).into()],
                tilt_std_rad: 0.01,
                bodies,
                plane_normal: if plane { normal.into() } else { [0.0; 3] },
                camera: [0.0; 3],
                laws: Vec::new(),
                parameters: Vec::new(),
            },
            problem: RefinedProblem {
                start: RefinedUnknowns {
                    bodies: motions[..count].to_vec(),
                    collision_time_s: COLLISION_S,
                    tilt: [0.0; 2],
                    impulse: impulse.into(),
                    contact_point: [0.13, 1.08, -0.16],
                    contact_basis: [[0.0; 3]; 2],
                    log_mass_ratio: if count == 2 { 0.4 } else { 0.0 },
                    parameters: Vec::new(),
                },
                earliest_s: -0.05,
                latest_s: 0.06,
                hold: RefinedHold { collision_time: false, log_mass_ratio: false },
                restitution: RestitutionPin { value: 0.0, weight: 0.0 },
                most_iterations: 50,
                jacobian: JacobianBy::Nothing,
            },
        }
        .spinning(Vector3::new(4.0, -6.0, 3.0))
    }

    /// With ω = `omega_in_body` before the collision, all bodies.
    fn spinning(mut self, omega_in_body: Vector3<f64>) -> Case {
        for (body, motion) in self.scene.bodies.iter().zip(&mut self.problem.start.bodies) {
            let k_in_body = Vector3::from(body.inertia_per_mass).component_mul(&omega_in_body);
            motion.spin_before = (from_wxyz(motion.orientation) * k_in_body).into();
        }
        self.seen()
    }

    /// Seen exactly where it now is.
    fn seen(mut self) -> Case {
        let g = self.scene.gravity_m_s2 * Vector3::from(self.scene.down);
        let start = &self.problem.start;
        for (index, body) in self.scene.bodies.iter_mut().enumerate() {
            let motion = &start.bodies[index];
            let push = if index == 0 { 1.0 } else { -(-start.log_mass_ratio).exp() };
            let kick = push * Vector3::from(start.impulse);
            let position = Vector3::from(motion.position);
            let lever = Vector3::from(start.contact_point) - position;
            body.poses = TIMES_S
                .iter()
                .map(|&time_s| {
                    let t = time_s - start.collision_time_s;
                    let pushed = if t > 0.0 { kick } else { Vector3::zeros() };
                    let velocity = Vector3::from(motion.velocity_before) + pushed;
                    let q = rotate_freely(
                        &from_wxyz(motion.orientation),
                        &Vector3::from(body.inertia_per_mass),
                        &(Vector3::from(motion.spin_before) + lever.cross(&pushed)),
                        t,
                    );
                    RefinedPose {
                        time_s,
                        position: (position + t * velocity + 0.5 * t * t * g).into(),
                        position_std_m: 0.002,
                        orientation: to_wxyz(&q),
                        orientation_std_rad: 0.01,
                        has_orientation: true,
                        noise_scale: 1.0,
                    }
                })
                .collect();
        }
        self
    }

    fn edited(&self, edit: impl Fn(&mut Case)) -> Case {
        let mut case = self.clone();
        edit(&mut case);
        case
    }
}

fn read(file: &str) -> Scene {
    Scene::read(format!("{}/{file}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn options(effects: &[&str]) -> RefinedOptions {
    let effects = effects.iter().map(|text| EffectRequest::parse(text).unwrap()).collect();
    RefinedOptions { effects, ..RefinedOptions::default() }
}
