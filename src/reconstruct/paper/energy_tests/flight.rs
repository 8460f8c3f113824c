//! What annotations cost (SMASH eq. 18 and 19), and the steps of eq. 10.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{HALF_OBSERVED, ROUNDING, cuboids, seen_briefly, simulated, turn};
use crate::bridge::paper::ffi::{self, PaperPhase};
use crate::rigid_body::omega_in_world;
use crate::rigid_body::quaternion::from_wxyz;
use crate::simulate::SimulationSpec;

/// Equal steps of a quarter frame at most: 1.1 frames take five, and so it goes back in time. Both
/// sides take the same steps, so that only rounding is left.
#[test]
fn rotation_goes_by_eulers_quarter_frames() {
    let case = cuboids(0);
    let (scene, unknowns) = (&case.scene, &case.unknowns);
    for (frames, steps) in [(1.1, 5), (-1.0, 4)] {
        for index in 0..2 {
            let (body, unknown) = (&scene.bodies[index], &unknowns.bodies[index]);
            let mass = [1.0, unknowns.mass_ratio][index];
            let inertia = mass * Vector3::from(body.inertia_per_mass);
            let flight = if frames < 0.0 { unknown.before } else { unknown.after };
            let step_s = frames / scene.frames_per_second / f64::from(steps);
            let mut q = from_wxyz(unknown.orientation);
            for _ in 0..steps {
                let omega = omega_in_world(&q, &inertia, &flight.angular_momentum.into());
                let turning = Quaternion::from_imag(omega) * q.into_inner();
                q = UnitQuaternion::new_normalize(q.into_inner() + turning * (step_s / 2.0));
            }
            let time = case.collision_frames + frames;
            let poses =
                ffi::predict_paper_poses(scene, case.collision_frames, unknowns, index, &[time]);
            let found = from_wxyz(poses.unwrap()[0].orientation);
            assert!(found.angle_to(&q) < 1e-12, "{}", found.angle_to(&q));
        }
    }
}

/// 1/2 w |f|² by hand: one annotation off by 3 cm, or turned by 0.2 rad, with nothing else wrong.
#[test]
fn an_annotation_costs_the_square_of_its_error() {
    let case = cuboids(3).seen_as_predicted();
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
