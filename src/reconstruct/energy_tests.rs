//! The energy of the C++ side (SMASH eq. 16) against the physics that it stands for.
//!
//! The cost that a solve starts with is the energy at its start: that evaluates it anywhere.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::gravity_frame::{from_wxyz, to_wxyz};
use super::internal::InternalScene;
use crate::Scene;
use crate::bridge::ffi::{
    self, PaperBody, PaperBodyUnknowns, PaperFlight, PaperObservation, PaperPhase, PaperScene,
    PaperUnknowns,
};
use crate::rigid_body::RigidBody;
use crate::simulate::{Sampling, SimulationSpec, simulate};

const PHASES: [PaperPhase; 3] = [
    PaperPhase::Trajectories,
    PaperPhase::Impulse,
    PaperPhase::ContactPoint,
];
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
            &internal
                .frame
                .orientation_from_world(&motion.before.world_from_body),
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
    Case {
        collision_frames: truth.collision_time * fps,
        unknowns,
        scene: internal.paper,
    }
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

/// The truth costs nothing but the error of Euler's steps: of a cuboid whose axis of rotation
/// wanders, first order in the step of a quarter frame, hence a quarter of the cost at twice the
/// frame rate. An error anywhere else would stay.
#[test]
fn the_truth_costs_only_the_error_of_eulers_steps() {
    for seed in 0..4 {
        let spec = |fps| seen_briefly(SimulationSpec::random_cuboids(seed), fps);
        for phase in [PaperPhase::Trajectories, PaperPhase::ContactPoint] {
            let [coarse, fine] = [480.0, 960.0].map(|fps| simulated(&spec(fps)).cost(phase));
            // Steps of 0.5 ms at some rad/s: an error of 1e-3 rad at most in each of 12 poses.
            assert!(
                coarse < 12.0 * HALF_OBSERVED * 1e-6,
                "seed {seed}: {coarse}"
            );
            // The next order is smaller by the angle of a step, below 1 %.
            let fall = coarse / fine;
            assert!((fall - 4.0).abs() < 0.1, "seed {seed}: falls {fall}-fold");
        }
    }
}

/// Balls turn about a fixed axis: Euler's normalised steps err by the tangent alone, third order in
/// the angle of a step.
#[test]
fn a_central_hit_of_balls_costs_nothing_in_any_phase() {
    let [coarse, fine] = [60.0, 120.0].map(|fps| spinning_balls(fps).costs());
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(coarse < 1e-8, "{coarse}");
        // Second order in the step, squared.
        let fall = coarse / fine;
        assert!((fall - 16.0).abs() < 0.5, "falls {fall}-fold");
    }
}

/// Moving an unknown changes the energy of just those phases whose terms hold it: no term is
/// missing, and none looks at what it shouldn't.
#[test]
fn each_unknown_matters_in_its_phases_alone() {
    type Move = fn(&mut PaperUnknowns);
    const ALL: [bool; 3] = [true; 3];
    let scene_wide: [(&str, [bool; 3], Move); 5] = [
        ("tilt", ALL, |u| u.tilt[0] += 0.1),
        ("heading", ALL, |u| u.tilt[1] += 0.1),
        ("mass ratio", ALL, |u| u.mass_ratio *= 1.1),
        ("J", [false, true, true], |u| u.impulse[0] += 0.1),
        ("x_c", [false, false, true], |u| move_across_impulse(u, 0.1)),
    ];
    let case = cuboids(0);
    let costs = case.costs();
    let check = |name: &str, matters: [bool; 3], moved: Case| {
        for (index, cost) in moved.costs().into_iter().enumerate() {
            let change = (cost - costs[index]).abs();
            let (place, is) = (format!("{name}, phase {}", index + 1), matters[index]);
            // The same sum of the same terms; or moved by a tenth, with no weight below 0.1.
            assert!(
                if is { change > 1e-6 } else { change == 0.0 },
                "{place}: {change}"
            );
        }
    };
    for (name, matters, change) in scene_wide {
        check(name, matters, case.edited(|c| change(&mut c.unknowns)));
    }
    for body in 0..2 {
        check(
            "q",
            ALL,
            case.edited(|c| turn(&mut c.unknowns.bodies[body].orientation, 0.1)),
        );
        for i in 0..3 {
            check(
                "b4",
                ALL,
                case.edited(|c| c.unknowns.bodies[body].position[i] += 0.1),
            );
            for after in [false, true] {
                let edit = |change: fn(&mut PaperFlight, usize)| {
                    case.edited(|c| {
                        let unknown = &mut c.unknowns.bodies[body];
                        change(
                            if after {
                                &mut unknown.after
                            } else {
                                &mut unknown.before
                            },
                            i,
                        );
                    })
                };
                check("flight", ALL, edit(|flight, i| flight.parabola[i] += 0.1));
                check(
                    "k",
                    ALL,
                    edit(|flight, i| flight.angular_momentum[i] += 0.1),
                );
            }
        }
    }
}

fn turn(orientation: &mut [f64; 4], angle: f64) {
    let by = UnitQuaternion::from_scaled_axis(Vector3::new(0.6, 0.0, 0.8) * angle);
    *orientation = to_wxyz(&(by * from_wxyz(*orientation)));
}

fn move_across_impulse(unknowns: &mut PaperUnknowns, by_m: f64) {
    let across = Vector3::from(unknowns.impulse)
        .cross(&Vector3::x())
        .normalize();
    unknowns.contact_point = (Vector3::from(unknowns.contact_point) + by_m * across).into();
}

/// The paper's zero set: along the impulse the contact point is free. Across it, both bodies feel
/// another torque: 0.1 m × |J|.
#[test]
fn the_contact_point_is_free_along_the_impulse() {
    let case = cuboids(2);
    let cost = case.cost(PaperPhase::ContactPoint);
    let along = case.edited(|c| {
        let point = Vector3::from(c.unknowns.contact_point) + Vector3::from(c.unknowns.impulse);
        c.unknowns.contact_point = point.into();
    });
    assert!((along.cost(PaperPhase::ContactPoint) - cost).abs() < ROUNDING);
    let across = case.edited(|c| move_across_impulse(&mut c.unknowns, 0.1));
    let torque = 0.1 * Vector3::from(case.unknowns.impulse).norm();
    let expected = cost + 2.0 * HALF_SOFT * torque * torque;
    assert!((across.cost(PaperPhase::ContactPoint) - expected).abs() < ROUNDING);
}

/// 1/2 w |f|² by hand: one annotation off by 3 cm, or turned by 0.2 rad, with nothing else wrong.
#[test]
fn an_annotation_costs_the_square_of_its_error() {
    let case = cuboids(3).seen_as_predicted();
    assert_eq!(
        case.cost(PaperPhase::Trajectories),
        case.edited(|_| {}).costs()[0]
    );
    assert!(case.cost(PaperPhase::ContactPoint) < 1e-25);
    for body in 0..2 {
        let displaced = case.edited(|c| {
            c.scene.bodies[body].observations[4].position[2] += 0.03;
        });
        let expected = HALF_OBSERVED * 0.03 * 0.03;
        assert!((displaced.cost(PaperPhase::ContactPoint) - expected).abs() < ROUNDING);
        let turned = case.edited(|c| {
            turn(&mut c.scene.bodies[body].observations[1].orientation, 0.2);
        });
        // The chord between two unit quaternions, half the angle apart.
        let chord = 2.0 * f64::sin(0.2 / 4.0);
        let expected = HALF_OBSERVED * chord * chord;
        assert!((turned.cost(PaperPhase::ContactPoint) - expected).abs() < ROUNDING);
    }
}

#[test]
fn a_quaternion_and_its_negative_are_the_same_pose() {
    let case = cuboids(4);
    let annotated = case.edited(|c| {
        for seen in c.scene.bodies.iter_mut().flat_map(|b| &mut b.observations) {
            seen.orientation = seen.orientation.map(|component| -component);
        }
    });
    assert_eq!(case.costs(), annotated.costs());
    let unknown = case.edited(|c| {
        let orientation = &mut c.unknowns.bodies[1].orientation;
        *orientation = orientation.map(|component| -component);
    });
    assert_eq!(case.costs(), unknown.costs());
}

/// A collision seen only at its own instant, where it is: no flight matters, and what is left are
/// eq. 11 to 14 and 17, written here a second time.
#[test]
fn the_collision_costs_its_breach_of_the_laws() {
    for seed in 0..10 {
        for spins in [
            vec![true, true],
            vec![true, false],
            vec![false, false],
            vec![true],
        ] {
            let case = instant(seed, &spins);
            for phase in PHASES {
                let (cost, expected) = (case.cost(phase), breach_of_laws(&case, phase));
                let error = (cost / expected - 1.0).abs();
                assert!(
                    error < ROUNDING,
                    "{spins:?}, {phase:?}: {cost} for {expected}"
                );
            }
        }
    }
}

/// Any unknowns; a single body stands over a slanted plane.
fn instant(seed: u64, spins: &[bool]) -> Case {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut numbers = || -> [f64; 3] { std::array::from_fn(|_| random.random_range(-1.0..1.0)) };
    let mut bodies = Vec::new();
    let mut unknowns = Vec::new();
    for &has_spin in spins {
        let [position, turned] = [numbers(), numbers()];
        let orientation = to_wxyz(&UnitQuaternion::from_scaled_axis(turned.into()));
        let mut flight = || PaperFlight {
            parabola: numbers(),
            angular_momentum: numbers(),
        };
        unknowns.push(PaperBodyUnknowns {
            position,
            orientation,
            before: flight(),
            after: flight(),
        });
        bodies.push(PaperBody {
            inertia_per_mass: [0.1, 0.2, 0.25],
            observations: vec![PaperObservation {
                time_frames: 7.0,
                position,
                orientation,
                has_orientation: true,
            }],
            has_spin,
        });
    }
    Case {
        scene: PaperScene {
            frames_per_second: 2.0,
            gravity_m_s2: 9.81,
            bodies,
            plane_normal: [0.6, -0.8, 0.0],
            plane_height_m: 0.4,
        },
        collision_frames: 7.0,
        unknowns: PaperUnknowns {
            bodies: unknowns,
            tilt: [0.4, -1.1],
            contact_point: numbers(),
            impulse: numbers(),
            mass_ratio: 1.7,
        },
    }
}

fn breach_of_laws(case: &Case, phase: PaperPhase) -> f64 {
    let (scene, unknowns) = (&case.scene, &case.unknowns);
    let [tilt, heading] = unknowns.tilt;
    let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    let tilted = about(Vector3::y_axis(), heading) * about(Vector3::x_axis(), tilt);
    let velocity = |flight: &PaperFlight| {
        let [b2, b3, azimuth] = flight.parabola;
        scene.frames_per_second
            * (tilted * about(Vector3::y_axis(), azimuth) * Vector3::new(b3, b2, 0.0))
    };
    let masses = [1.0, unknowns.mass_ratio];
    let momentum_jump = |i: usize| {
        let body = &unknowns.bodies[i];
        masses[i] * (velocity(&body.after) - velocity(&body.before))
    };
    let spin_jump = |i: usize| {
        let body = &unknowns.bodies[i];
        Vector3::from(body.after.angular_momentum) - Vector3::from(body.before.angular_momentum)
    };
    let position = |i: usize| Vector3::from(unknowns.bodies[i].position);
    let count = scene.bodies.len();

    let mut cost = (9.81 * (1.0 - tilt.cos())).powi(2) / 2.0;
    if count == 2 {
        cost += HALF_SOFT * (momentum_jump(0) + momentum_jump(1)).norm_squared();
        if scene.bodies.iter().all(|body| body.has_spin) {
            let about_origin = |i: usize| position(i).cross(&momentum_jump(i)) + spin_jump(i);
            cost += HALF_SOFT * (about_origin(0) + about_origin(1)).norm_squared();
        }
    }
    let normal = Vector3::from(scene.plane_normal);
    let point = match phase {
        PaperPhase::Trajectories => return cost,
        PaperPhase::ContactPoint => Vector3::from(unknowns.contact_point),
        _ if count == 2 => (position(0) + position(1)) / 2.0,
        _ => position(0) - (normal.dot(&position(0)) - scene.plane_height_m) * normal,
    };
    let impulse = Vector3::from(unknowns.impulse);
    for (i, on_body) in [impulse, -impulse].into_iter().enumerate().take(count) {
        let unexplained = (momentum_jump(i) - on_body) / masses[i];
        cost += HALF_SOFT * unexplained.norm_squared();
        if scene.bodies[i].has_spin {
            let torque = (point - position(i)).cross(&on_body);
            cost += HALF_SOFT * (spin_jump(i) - torque).norm_squared();
        }
    }
    cost
}

/// What a body's spin isn't measured for leaves no trace: its orientations may be anything.
#[test]
fn a_body_without_spin_has_no_orientation() {
    let case = cuboids(5).edited(|c| c.scene.bodies[0].has_spin = false);
    let turned = case.edited(|c| {
        turn(&mut c.unknowns.bodies[0].orientation, 1.0);
        turn(&mut c.scene.bodies[0].observations[0].orientation, 1.0);
        c.unknowns.bodies[0].before.angular_momentum = [1.0, 2.0, 3.0];
    });
    assert_eq!(case.costs(), turned.costs());
}

/// One body on a plane: the mass ratio is no unknown.
#[test]
fn a_static_partner_has_no_unknowns() {
    let case = simulated(&seen_briefly(SimulationSpec::random_box_drop(0), 120.0));
    assert_eq!(case.unknowns.bodies.len(), 1);
    let heavier = case.edited(|c| c.unknowns.mass_ratio = 9.0);
    assert_eq!(case.costs(), heavier.costs());
    let solution = ffi::solve_paper_phase(
        &heavier.scene,
        heavier.collision_frames,
        PaperPhase::ContactPoint,
        &heavier.unknowns,
    );
    assert_eq!(solution.unwrap().unknowns.mass_ratio, 9.0);
}

/// Only right derivatives lead down to nothing, and in a few steps: phase 3 holds every functor but
/// those of phase 2's contact point, which the balls need.
#[test]
fn every_phase_finds_back_to_the_truth() {
    let nearby = |case: &Case| {
        case.edited(|c| {
            c.unknowns.mass_ratio *= 1.1;
            c.unknowns.impulse[1] += 0.1;
            c.unknowns.contact_point[0] += 0.02;
            c.unknowns.tilt[0] = 0.02;
            for body in &mut c.unknowns.bodies {
                body.position[1] += 0.02;
                turn(&mut body.orientation, 0.05);
                for flight in [&mut body.before, &mut body.after] {
                    flight.parabola[0] *= 1.1;
                    flight.angular_momentum[2] *= 1.1;
                }
            }
        })
    };
    let drop = simulated(&seen_briefly(SimulationSpec::random_ball_drop(0), 120.0));
    for (name, phases, case) in [
        ("cuboids", &PHASES[2..], cuboids(6).seen_as_predicted()),
        (
            "balls",
            &PHASES[..],
            spinning_balls(60.0).seen_as_predicted(),
        ),
        ("drop", &PHASES[..], drop.seen_as_predicted()),
    ] {
        for &phase in phases {
            let start = nearby(&case).unknowns;
            let solution =
                ffi::solve_paper_phase(&case.scene, case.collision_frames, phase, &start).unwrap();
            let found = &solution.unknowns;
            let place = format!("{name}, {phase:?}: {solution:?}");
            assert!(solution.cost_initial > 1e-4, "{place}");
            assert!(solution.converged && solution.iterations < 50, "{place}");
            assert!(
                solution.cost_final < 1e-12 * solution.cost_initial,
                "{place}"
            );
            let error = Vector3::from(found.impulse) - Vector3::from(case.unknowns.impulse);
            assert!(
                phase == PaperPhase::Trajectories || error.norm() < 1e-5,
                "{place}"
            );
        }
    }
}

/// What would make Ceres end the process comes back as an error.
#[test]
fn impossible_input_is_refused() {
    type Edit = fn(&mut Case);
    let edits: [(&str, Edit); 21] = [
        ("one or two bodies", |c| c.scene.bodies.clear()),
        ("one or two bodies", |c| {
            let body = c.scene.bodies[0].clone();
            c.scene.bodies.push(body);
        }),
        ("differ in number", |c| c.unknowns.bodies.truncate(1)),
        ("differ in number", |c| c.scene.bodies.truncate(1)),
        ("without observations", |c| {
            c.scene.bodies[1].observations.clear()
        }),
        ("frame rate", |c| c.scene.frames_per_second = 0.0),
        ("frame rate", |c| c.scene.frames_per_second = f64::NAN),
        ("frame rate", |c| c.scene.frames_per_second = f64::INFINITY),
        ("gravity", |c| c.scene.gravity_m_s2 = -1.0),
        ("gravity", |c| c.scene.gravity_m_s2 = f64::NAN),
        ("collision time", |c| c.collision_frames = f64::NAN),
        ("plane", |c| c.scene.plane_normal[1] = f64::INFINITY),
        ("plane", |c| c.scene.plane_height_m = f64::NAN),
        ("inertia", |c| c.scene.bodies[0].inertia_per_mass[2] = 0.0),
        ("inertia", |c| {
            c.scene.bodies[0].inertia_per_mass[2] = f64::NAN
        }),
        ("observation", |c| {
            c.scene.bodies[0].observations[0].time_frames = f64::NAN
        }),
        ("observation", |c| {
            c.scene.bodies[0].observations[0].position[0] = f64::INFINITY
        }),
        ("observation", |c| {
            c.scene.bodies[0].observations[0].orientation[0] = f64::NAN
        }),
        ("unit quaternion", |c| {
            c.unknowns.bodies[1].orientation = [2.0, 0.0, 0.0, 0.0]
        }),
        ("mass ratio", |c| c.unknowns.mass_ratio = 11.0),
        ("mass ratio", |c| c.unknowns.mass_ratio = f64::NAN),
    ];
    let case = cuboids(7);
    for (words, edit) in edits {
        let Case {
            scene,
            collision_frames,
            unknowns,
        } = case.edited(edit);
        let predicted = ffi::predict_paper_poses(&scene, collision_frames, &unknowns, 0, &[1.0]);
        let refusals = PHASES
            .map(|phase| ffi::solve_paper_phase(&scene, collision_frames, phase, &unknowns).err())
            .into_iter()
            .chain([predicted.err()]);
        for refusal in refusals {
            let message = refusal.expect(words).to_string();
            assert!(message.contains(words), "{words}: {message}");
        }
    }
    let Case {
        scene,
        collision_frames,
        unknowns,
    } = &case;
    let nobody = ffi::predict_paper_poses(scene, *collision_frames, unknowns, 2, &[1.0]);
    assert!(nobody.unwrap_err().to_string().contains("no such body"));
}

/// A start that isn't a number anywhere else is found by the solver.
#[test]
fn a_start_that_is_no_number_is_refused() {
    type Edit = fn(&mut PaperUnknowns);
    let edits: [Edit; 5] = [
        |u| u.tilt[0] = f64::NAN,
        |u| u.impulse[0] = f64::NAN,
        |u| u.contact_point[0] = f64::INFINITY,
        |u| u.bodies[0].before.parabola[0] = f64::NAN,
        |u| u.bodies[1].after.angular_momentum[0] = f64::INFINITY,
    ];
    let case = cuboids(7);
    for edit in edits {
        let Case {
            scene,
            collision_frames,
            unknowns,
        } = case.edited(|c| edit(&mut c.unknowns));
        let phase = PaperPhase::ContactPoint;
        let solved = ffi::solve_paper_phase(&scene, collision_frames, phase, &unknowns);
        let message = solved.unwrap_err().to_string();
        assert!(message.contains("no usable solution"), "{message}");
    }
}
