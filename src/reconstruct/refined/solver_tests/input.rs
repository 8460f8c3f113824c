//! What the C++ side refuses: all that would make Ceres end the process, or never end.

use super::{BOX, BRICK, Case};
use crate::bridge::refined::ffi::{
    Jump, RefinedScene, RefinedUnknowns, SpinFlight, fit_jump, fit_spin, solve_refined,
};

const NAN: f64 = f64::NAN;
const INFINITE: f64 = f64::INFINITY;

/// Each edit of a good problem is refused with these words, and the problem itself isn't.
#[test]
fn impossible_problems_are_refused() {
    type Edit = fn(&mut Case);
    let edits: [(&str, Edit); 53] = [
        ("one or two bodies", |c| c.scene.bodies.clear()),
        ("one or two bodies", |c| {
            let body = c.scene.bodies[0].clone();
            c.scene.bodies.push(body);
        }),
        ("differ in number", |c| c.problem.start.bodies.truncate(1)),
        ("differ in number", |c| c.scene.bodies.truncate(1)),
        ("without poses", |c| c.scene.bodies[1].poses.clear()),
        ("poses out of order", |c| c.scene.bodies[0].poses.reverse()),
        ("poses out of order", |c| c.scene.bodies[1].poses.swap(3, 4)),
        ("pose that isn't finite", |c| c.scene.bodies[0].poses[6].time_s = INFINITE),
        ("pose that isn't finite", |c| c.scene.bodies[0].poses[2].position[1] = NAN),
        ("pose that isn't finite", |c| c.scene.bodies[1].poses[2].position[1] = -INFINITE),
        ("pose that isn't finite", |c| c.scene.bodies[1].poses[0].orientation[3] = NAN),
        ("an orientation isn't of length 1", |c| {
            c.scene.bodies[0].poses[0].orientation = [1.0, 0.1, 0.0, 0.0];
        }),
        ("an orientation isn't of length 1", |c| c.scene.bodies[0].poses[0].orientation = [0.0; 4]),
        ("standard deviation", |c| c.scene.bodies[0].poses[0].position_std_m = 0.0),
        ("standard deviation", |c| c.scene.bodies[0].poses[0].position_std_m = NAN),
        ("standard deviation", |c| c.scene.bodies[0].poses[0].position_std_m = INFINITE),
        ("standard deviation", |c| c.scene.bodies[1].poses[5].orientation_std_rad = -0.01),
        ("standard deviation", |c| c.scene.bodies[1].poses[5].orientation_std_rad = NAN),
        ("moment of inertia", |c| c.scene.bodies[0].inertia_per_mass[2] = 0.0),
        ("moment of inertia", |c| c.scene.bodies[0].inertia_per_mass[2] = NAN),
        ("moment of inertia", |c| c.scene.bodies[1].inertia_per_mass[0] = INFINITE),
        ("gravity", |c| c.scene.gravity_m_s2 = -9.81),
        ("gravity", |c| c.scene.gravity_m_s2 = NAN),
        ("gravity", |c| c.scene.gravity_m_s2 = INFINITE),
        ("gravity", |c| c.scene.tilt_std_rad = 0.0),
        ("gravity", |c| c.scene.tilt_std_rad = NAN),
        ("gravity", |c| c.scene.down = [NAN, -1.0, 0.0]),
        ("gravity", |c| c.scene.down = [0.0; 3]),
        ("gravity", |c| c.scene.across[0][2] = INFINITE),
        ("gravity", |c| c.scene.across[1][2] = NAN),
        ("a plane's normal isn't of length 1", |c| c.scene.plane_normal[1] = INFINITE),
        ("a plane's normal isn't of length 1", |c| c.scene.plane_normal[2] = NAN),
        ("a plane's normal isn't of length 1", |c| c.scene.plane_normal = [0.0, 2.0, 0.0]),
        ("collision time", |c| c.problem.start.collision_time_s = 0.07),
        ("collision time", |c| c.problem.start.collision_time_s = NAN),
        ("collision time", |c| c.problem.latest_s = c.problem.earliest_s),
        ("collision time", |c| c.problem.earliest_s = NAN),
        ("collision time", |c| c.problem.earliest_s = -INFINITE),
        ("collision time", |c| c.problem.latest_s = INFINITE),
        ("restitution", |c| c.problem.restitution.value = NAN),
        ("restitution", |c| c.problem.restitution.weight = INFINITE),
        ("a start that isn't finite", |c| c.problem.start.bodies[0].position[0] = NAN),
        ("a start that isn't finite", |c| c.problem.start.bodies[1].velocity_before[0] = INFINITE),
        ("a start that isn't finite", |c| c.problem.start.bodies[0].spin_before[0] = NAN),
        ("unit length", |c| c.problem.start.bodies[1].orientation = [2.0, 0.0, 0.0, 0.0]),
        ("a start that isn't finite", |c| c.problem.start.tilt[1] = NAN),
        ("a start that isn't finite", |c| c.problem.start.impulse[1] = INFINITE),
        ("a start that isn't finite", |c| c.problem.start.contact_point[2] = NAN),
        ("a start that isn't finite", |c| c.problem.start.log_mass_ratio = NAN),
        ("a start that isn't finite", |c| c.problem.start.log_mass_ratio = 21.0),
        // Ten thousand million turns a second, and what would lead to them.
        ("too fast", |c| c.problem.start.bodies[0].spin_before[0] = 1e9),
        ("too fast", |c| c.problem.start.impulse[0] = 1e12),
        ("too fast", |c| c.problem.earliest_s = -1e9),
    ];
    let case = Case::new(&[BOX, BRICK], false);
    assert!(solve_refined(&case.scene, &case.problem).unwrap().converged);
    for (words, edit) in edits {
        let Case { scene, problem } = case.edited(edit);
        let message = solve_refined(&scene, &problem).expect_err(words).to_string();
        assert!(message.contains(words), "{words}: {message}");
    }
}

/// As the first flight after the collision goes.
fn flight() -> SpinFlight {
    let case = Case::new(&[BOX], false);
    SpinFlight {
        inertia_per_mass: case.scene.bodies[0].inertia_per_mass,
        collision_time_s: 0.01,
        poses: case.scene.bodies[0].poses[3..].to_vec(),
        spin: [0.02, -0.03, 0.01],
        hopeless_cost: INFINITE,
    }
}

#[test]
fn impossible_spin_flights_are_refused() {
    type Edit = fn(&mut SpinFlight);
    let edits: [(&str, Edit); 12] = [
        ("without orientations", |f| f.poses.clear()),
        ("without orientations", |f| f.poses.iter_mut().for_each(|p| p.has_orientation = false)),
        ("moment of inertia", |f| f.inertia_per_mass[0] = 0.0),
        ("moment of inertia", |f| f.inertia_per_mass[0] = NAN),
        ("isn't finite", |f| f.collision_time_s = NAN),
        ("isn't finite", |f| f.collision_time_s = -INFINITE),
        ("isn't finite", |f| f.spin[2] = INFINITE),
        ("isn't finite", |f| f.poses[1].time_s = NAN),
        ("isn't finite", |f| f.poses[1].orientation[0] = NAN),
        ("length 1", |f| f.poses[1].orientation = [0.5, 0.0, 0.0, 0.0]),
        ("standard deviation", |f| f.poses[0].orientation_std_rad = 0.0),
        ("too fast", |f| f.spin[1] = 1e9),
    ];
    assert!(fit_spin(&flight()).unwrap().cost < 1.0);
    for (words, edit) in edits {
        let mut broken = flight();
        edit(&mut broken);
        let message = fit_spin(&broken).expect_err(words).to_string();
        assert!(message.contains(words), "{words}: {message}");
    }
}

#[test]
fn impossible_jumps_are_refused() {
    type Edit = fn(&mut RefinedScene, &mut Vec<Jump>, &mut RefinedUnknowns);
    let edits: [(&str, Edit); 10] = [
        ("differ in number", |_, jumps, _| jumps.truncate(1)),
        ("differ in number", |_, _, start| start.bodies.truncate(1)),
        ("one or two bodies", |scene, _, _| scene.bodies.clear()),
        ("jump that isn't finite", |_, jumps, _| jumps[0].position[0] = NAN),
        ("jump that isn't finite", |_, jumps, _| jumps[1].velocity[0] = INFINITE),
        ("jump that isn't finite", |_, jumps, _| jumps[0].velocity_weight[8] = NAN),
        ("jump that isn't finite", |_, jumps, _| jumps[1].spin[0] = NAN),
        ("jump that isn't finite", |_, jumps, _| jumps[1].spin_weight[4] = INFINITE),
        ("start that isn't finite", |_, _, start| start.impulse[0] = NAN),
        ("start that isn't finite", |_, _, start| start.log_mass_ratio = -1e3),
    ];
    let case = Case::new(&[BOX, BRICK], false);
    let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let jump = Jump {
        position: [0.1, 1.0, -0.2],
        velocity: [0.4, -1.1, 0.3],
        velocity_weight: identity,
        spin: [0.0, 0.1, 0.0],
        spin_weight: identity,
    };
    let jumps = vec![jump.clone(), jump];
    assert!(fit_jump(&case.scene, &jumps, &case.problem.start).is_ok());
    for (words, edit) in edits {
        let (mut scene, mut jumps) = (case.scene.clone(), jumps.clone());
        let mut start = case.problem.start.clone();
        edit(&mut scene, &mut jumps, &mut start);
        let message = fit_jump(&scene, &jumps, &start).expect_err(words).to_string();
        assert!(message.contains(words), "{words}: {message}");
    }
}
