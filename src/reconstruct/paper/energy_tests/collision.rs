//! What the collision costs (SMASH eq. 11 to 14 and 17), by hand.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{Case, HALF_SOFT, PHASES, ROUNDING};
use crate::bridge::paper::ffi::{
    PaperBody, PaperBodyUnknowns, PaperFlight, PaperObservation, PaperPhase, PaperScene,
    PaperUnknowns,
};
use crate::rigid_body::quaternion::to_wxyz;

/// A collision seen only at its own instant, where it is: no flight matters, and what is left are
/// eq. 11 to 14 and 17, written here a second time.
#[test]
fn the_collision_costs_its_breach_of_the_laws() {
    for seed in 0..10 {
        for spins in [vec![true, true], vec![true, false], vec![false, false], vec![true]] {
            let case = instant(seed, &spins);
            for phase in PHASES {
                let (cost, expected) = (case.cost(phase), breach_of_laws(&case, phase));
                let error = (cost / expected - 1.0).abs();
                assert!(error < ROUNDING, "{spins:?}, {phase:?}: {cost} for {expected}");
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
        let mut flight = || PaperFlight { parabola: numbers(), angular_momentum: numbers() };
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
