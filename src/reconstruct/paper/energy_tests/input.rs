//! What the C++ side refuses.

use super::{Case, PHASES, cuboids};
use crate::bridge::paper::ffi::{self, PaperPhase, PaperUnknowns};

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
        ("without observations", |c| c.scene.bodies[1].observations.clear()),
        ("frame rate", |c| c.scene.frames_per_second = 0.0),
        ("frame rate", |c| c.scene.frames_per_second = f64::NAN),
        ("frame rate", |c| c.scene.frames_per_second = f64::INFINITY),
        ("gravity", |c| c.scene.gravity_m_s2 = -1.0),
        ("gravity", |c| c.scene.gravity_m_s2 = f64::NAN),
        ("collision time", |c| c.collision_frames = f64::NAN),
        ("plane", |c| c.scene.plane_normal[1] = f64::INFINITY),
        ("plane", |c| c.scene.plane_height_m = f64::NAN),
        ("inertia", |c| c.scene.bodies[0].inertia_per_mass[2] = 0.0),
        ("inertia", |c| c.scene.bodies[0].inertia_per_mass[2] = f64::NAN),
        ("observation", |c| c.scene.bodies[0].observations[0].time_frames = f64::NAN),
        ("observation", |c| c.scene.bodies[0].observations[0].position[0] = f64::INFINITY),
        ("observation", |c| c.scene.bodies[0].observations[0].orientation[0] = f64::NAN),
        ("unit quaternion", |c| c.unknowns.bodies[1].orientation = [2.0, 0.0, 0.0, 0.0]),
        ("mass ratio", |c| c.unknowns.mass_ratio = 11.0),
        ("mass ratio", |c| c.unknowns.mass_ratio = f64::NAN),
    ];
    let case = cuboids(7);
    for (words, edit) in edits {
        let Case { scene, collision_frames, unknowns } = case.edited(edit);
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
    let Case { scene, collision_frames, unknowns } = &case;
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
        let Case { scene, collision_frames, unknowns } = case.edited(|c| edit(&mut c.unknowns));
        let phase = PaperPhase::ContactPoint;
        let solved = ffi::solve_paper_phase(&scene, collision_frames, phase, &unknowns);
        let message = solved.unwrap_err().to_string();
        assert!(message.contains("no usable solution"), "{message}");
    }
}
