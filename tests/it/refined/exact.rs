//! Poses without noise: the solver's answer is the truth.

use nalgebra::Vector3;
use smash::Reconstruction;
use smash::simulate::{SimulationSpec, Truth};

use super::{distance, every, solve};

/// How far a result may be from the truth, in SI units.
struct Tolerance {
    /// Of what positions tell: mass ratio (relative), time, impulse, normal, positions, velocities.
    linear: f64,
    /// Of the restitution, and of the contact point's line in m; of spins in a tenth of a rad/s.
    angular: f64,
}

/// Orientations are integrated to 1e-7 rad over ten rad; over tenths of a second that is 1e-6 rad/s
/// of spin, and as many m/s of a point a metre off the centre. Velocities feel it only through the
/// torque.
const WITH_SPINS: Tolerance = Tolerance { linear: 1e-7, angular: 1e-5 };
/// Parabolas have a closed form: what is left is rounding, some 1e-16 m over tenths of a second,
/// a hundred times amplified in t_c, and a thousand times more where the optimiser stops.
const WITHOUT_SPINS: Tolerance = Tolerance { linear: 1e-10, angular: 1e-10 };

/// Every number that the poses determine.
fn assert_is_truth(result: &Reconstruction, truth: &Truth, tolerance: &Tolerance) {
    let name = &truth.scene;
    let check = |what: &str, error: f64, tolerance: f64| {
        assert!(error < tolerance, "{name}: {what} is off by {error:e}");
    };
    let &Tolerance { linear, angular } = tolerance;
    assert_eq!(result.flags, [], "{name}");
    let found = result.mass_ratio.as_ref().map(|m| m.value.unwrap());
    assert_eq!(found.is_some(), truth.mass_ratio.is_some(), "{name}");
    if let (Some(found), Some(mass_ratio)) = (found, truth.mass_ratio) {
        check("the mass ratio", (found / mass_ratio - 1.0).abs(), linear);
    }
    let time_s = result.collision_time.value.unwrap();
    check("the time", (time_s - truth.collision_time).abs(), linear);
    check("the impulse", distance(result.impulse, truth.impulse), linear);
    check("the normal", distance(result.normal.unwrap(), truth.normal), linear);
    let restitution = result.restitution.value.unwrap();
    check("the restitution", (restitution - truth.restitution).abs(), angular);
    let lever = Vector3::from(result.contact_point.unwrap()) - Vector3::from(truth.contact_point);
    check("the line of action", lever.cross(&Vector3::from(truth.normal)).norm(), angular);
    for (found, truth) in result.bodies.iter().zip(&truth.bodies) {
        assert_eq!(found.name, truth.name);
        check("a position", distance(found.position, truth.position), linear);
        check("a velocity", distance(found.velocity_before, truth.velocity_before), linear);
        check("a velocity", distance(found.velocity_after, truth.velocity_after), linear);
        let spins = [
            (found.angular_velocity_before, truth.angular_velocity_before),
            (found.angular_velocity_after, truth.angular_velocity_after),
        ];
        for (found, truth) in spins {
            found.inspect(|&found| check("a spin", distance(found, truth), 10.0 * angular));
        }
    }
}

/// At an interval of 19 of 90 frames at 60 a second a spin of 15 rad/s turns by 4.7 rad from pose to
/// pose: more than half a turn, which only the collision can undo. In scene 3 the shortest turns lead
/// to a fit within twice an annotator's noise that is wrong.
#[test]
fn two_cuboids_are_found_exactly() {
    for (interval, seeds) in [(9, [0, 1, 2, 3]), (19, [0, 1, 3, 5])] {
        for seed in seeds {
            let (file, truth) = every(interval, SimulationSpec::random_cuboids(seed));
            let result = solve(&file);
            assert!(result.bodies.iter().all(|body| body.angular_velocity_after.is_some()));
            assert_is_truth(&result, &truth, &WITH_SPINS);
        }
    }
}

#[test]
fn a_box_that_bounces_is_found_exactly() {
    for interval in [9, 16] {
        for seed in 0..3 {
            let (file, truth) = every(interval, SimulationSpec::random_box_drop(seed));
            assert_is_truth(&solve(&file), &truth, &WITH_SPINS);
        }
    }
}

#[test]
fn plain_balls_are_found_exactly() {
    for seed in 0..3 {
        for interval in [9, 19] {
            let (file, truth) = every(interval, SimulationSpec::random_balls(seed));
            assert_is_truth(&solve(&file), &truth, &WITHOUT_SPINS);
        }
        for interval in [9, 16] {
            let (file, truth) = every(interval, SimulationSpec::random_ball_drop(seed));
            assert_is_truth(&solve(&file), &truth, &WITHOUT_SPINS);
        }
    }
}
