//! At the truth, and about it.

use nalgebra::Vector3;

use super::{
    Case, HALF_OBSERVED, HALF_SOFT, PHASES, ROUNDING, cuboids, move_across_impulse, seen_briefly,
    simulated, spinning_balls, turn,
};
use crate::bridge::paper::ffi::{self, PaperFlight, PaperPhase, PaperUnknowns};
use crate::simulate::SimulationSpec;

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
            assert!(coarse < 12.0 * HALF_OBSERVED * 1e-6, "seed {seed}: {coarse}");
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
            assert!(if is { change > 1e-6 } else { change == 0.0 }, "{place}: {change}");
        }
    };
    for (name, matters, change) in scene_wide {
        check(name, matters, case.edited(|c| change(&mut c.unknowns)));
    }
    for body in 0..2 {
        check("q", ALL, case.edited(|c| turn(&mut c.unknowns.bodies[body].orientation, 0.1)));
        for i in 0..3 {
            check("b4", ALL, case.edited(|c| c.unknowns.bodies[body].position[i] += 0.1));
            for after in [false, true] {
                let edit = |change: fn(&mut PaperFlight, usize)| {
                    case.edited(|c| {
                        let unknown = &mut c.unknowns.bodies[body];
                        change(if after { &mut unknown.after } else { &mut unknown.before }, i);
                    })
                };
                check("flight", ALL, edit(|flight, i| flight.parabola[i] += 0.1));
                check("k", ALL, edit(|flight, i| flight.angular_momentum[i] += 0.1));
            }
        }
    }
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
        ("balls", &PHASES[..], spinning_balls(60.0).seen_as_predicted()),
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
            assert!(solution.cost_final < 1e-12 * solution.cost_initial, "{place}");
            let error = Vector3::from(found.impulse) - Vector3::from(case.unknowns.impulse);
            assert!(phase == PaperPhase::Trajectories || error.norm() < 1e-5, "{place}");
        }
    }
}
