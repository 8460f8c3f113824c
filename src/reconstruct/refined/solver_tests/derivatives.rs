//! The hand-made derivatives of a flight against automatic ones, and the information matrix against
//! the curvature of the cost.

use nalgebra::{DVector, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{BALL, BOX, BRICK, CUBE, Case};
use crate::bridge::flight_reference::ffi::compare_flights;
use crate::bridge::refined::ffi::{RefinedPose, solve_refined};
use crate::reconstruct::refined::layout::Layout;
use crate::reconstruct::refined::optimum::information;
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};

/// Poses as they are while the solver is still on its way: off by centimetres and a third of a
/// radian.
fn annotated_roughly(pose: &mut RefinedPose) {
    pose.position[1] += 0.03;
    let turn = UnitQuaternion::new(Vector3::new(0.2, -0.1, 0.25));
    pose.orientation = to_wxyz(&(from_wxyz(pose.orientation) * turn));
}

/// Every flight's residuals are the reference's to rounding (1e-16 of metres and radians over a
/// noise of 2 mm and 0.01 rad, through some hundred steps), and its derivatives to `tolerance`.
fn assert_agrees(name: &str, case: Case, tolerance: f64) {
    let rough = case.edited(|case| {
        for pose in case.scene.bodies.iter_mut().flat_map(|body| &mut body.poses) {
            annotated_roughly(pose);
        }
        case.problem.start.tilt = [0.01, -0.02];
    });
    for (state, case) in [("at the optimum", &case), ("on the way", &rough)] {
        let difference = compare_flights(&case.scene, &case.problem).unwrap();
        assert_eq!(difference.flights as usize, 2 * case.scene.bodies.len(), "{name}");
        let text = format!("{name}, {state}: {difference:?}");
        assert!(difference.value < 1e-10, "{text}");
        assert!(difference.derivative < tolerance, "{text}");
    }
}

/// Ψ is integrated in steps of 0.24 rad at most, in which it turns about twice as fast as the body:
/// Runge-Kutta's error of order 4 is some 0.5⁴ / 120 = 5e-4 of it, less where a step is shorter. The
/// optimum doesn't depend on it, and a deviation needs no more.
pub(super) const BY_STEPS: f64 = 1e-4;
/// Where inertia is isotropic Ψ has a closed form, and where a step is a few thousandths of
/// a radian its fourth power is 1e-11: the formulas themselves are right.
const EXACT: f64 = 1e-10;

#[test]
fn derivatives_of_boxes_are_those_of_automatic_differentiation() {
    assert_agrees("two boxes", Case::new(&[BOX, BRICK], false), BY_STEPS);
    assert_agrees("a box on a plane", Case::new(&[BRICK], true), BY_STEPS);
    let still = Case::new(&[BOX, BRICK], false).spinning(Vector3::zeros());
    assert_agrees("two boxes that don't turn before", still, BY_STEPS);
    for (shapes, plane) in [(&[BOX, BRICK][..], false), (&[BRICK][..], true)] {
        let slow = Case::new(shapes, plane).edited(|case| {
            case.problem.start.impulse = case.problem.start.impulse.map(|j| 0.001 * j);
        });
        let slow = slow.spinning(Vector3::new(0.01, -0.015, 0.008));
        assert_agrees("boxes that hardly turn", slow, EXACT);
    }
}

#[test]
fn derivatives_of_isotropic_bodies_are_those_of_automatic_differentiation() {
    assert_agrees("cube and ball", Case::new(&[CUBE, BALL], false), EXACT);
    assert_agrees("a cube on a plane", Case::new(&[CUBE], true), EXACT);
    let still = Case::new(&[CUBE, BALL], false).spinning(Vector3::zeros());
    assert_agrees("cube and ball that don't turn before", still, EXACT);
}

#[test]
fn derivatives_hold_without_gravity_or_spin_as_an_unknown() {
    let weightless = Case::new(&[BOX, BRICK], false).edited(|case| case.scene.gravity_m_s2 = 0.0);
    assert_agrees("without gravity", weightless.seen(), BY_STEPS);
    let plain = Case::new(&[BALL, BOX], false).edited(|case| case.scene.bodies[0].has_spin = false);
    assert_agrees("a plain ball and a box", plain, BY_STEPS);
}

/// At an exact optimum the cost grows by ½ δᵀ N δ, N the information, along every unknown and
/// along mixtures of all: what the covariance and every interval rest on.
#[test]
fn the_information_is_the_curvature_of_the_cost() {
    for (name, case) in [
        ("two boxes", Case::new(&[BOX, BRICK], false)),
        ("a cube on a plane", Case::new(&[CUBE], true)),
    ] {
        let solution = solve_refined(&case.scene, &case.problem).unwrap();
        let layout = Layout::new(&case.scene);
        assert_eq!(layout.size, solution.size, "{name}");
        let sum = information(&solution, &solution.position_information)
            + information(&solution, &solution.orientation_information)
            + information(&solution, &solution.prior_information);
        // Steps of a thousandth: a few deviations at most, the third order cancels.
        let cost = |step: &DVector<f64>| {
            let mut moved = case.clone();
            moved.problem.start = solution.unknowns.clone();
            for (index, length) in step.iter().enumerate() {
                moved.problem.start = layout.stepped(&moved.problem.start, index, *length);
            }
            solve_refined(&moved.scene, &moved.problem).unwrap().cost_initial
        };
        // At the optimum only the contact point's prior costs something.
        let least = cost(&DVector::zeros(layout.size));
        let mut random = ChaCha8Rng::seed_from_u64(3);
        let along = (0..layout.size)
            .map(|i| DVector::from_fn(layout.size, |row, _| if row == i { 1e-4 } else { 0.0 }));
        let mixed: Vec<DVector<f64>> = (0..20)
            .map(|_| DVector::from_fn(layout.size, |_, _| random.random_range(-1e-4..1e-4)))
            .collect();
        for step in along.chain(mixed) {
            let expected = step.dot(&(&sum * &step));
            let found = cost(&step) + cost(&-&step) - 2.0 * least;
            // The fourth order is 1e-4² of the second, times the square of some ten radians; Ψ's
            // error is below that.
            let error = (found - expected).abs();
            // The contact point's prior isn't in N: (2e-4 / 0.1)² for each body.
            let tolerance = 1e-4 * expected + 1e-5;
            assert!(error < tolerance, "{name}: along {} by {error:e}", step.imax());
        }
    }
}
