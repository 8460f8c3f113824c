//! Closed forms of flights under one effect.

use super::*;

/// An effect at its null changes the way of computing, but no pose: 1.5 s and up to 20 rad agree
/// with the exact flight.
#[test]
fn integrated_flights_are_as_exact_as_they_say() {
    for seed in 0..4 {
        let exact = with(SimulationSpec::random_cuboids(seed), &[]);
        let null = effect("linear_drag", None, &[("k", &[0.0])]);
        let integrated = with(SimulationSpec::random_cuboids(seed), &[null]);
        for (exact, integrated) in exact.scene.bodies().iter().zip(integrated.scene.bodies()) {
            for (exact, integrated) in exact.observations.iter().zip(&integrated.observations) {
                assert_near(integrated.position_in_world, exact.position_in_world, INTEGRATED);
                let [q, expected] = [integrated, exact].map(|pose| pose.world_from_body.unwrap());
                let off = q.angle_to(&expected);
                // Each way is off by that much.
                assert!(off < 2.0 * INTEGRATED, "{off:e} rad");
            }
        }
    }
}

/// v = v0 exp(−k t).
#[test]
fn linear_drag_slows_exponentially() {
    let k = 0.8;
    let drag = effect("linear_drag", Some("a"), &[("k", &[k])]);
    let simulation = with(weightless(SimulationSpec::random_cuboids(2)), &[drag]);
    for since_s in MOMENTS_S {
        let (body, start) = flown(&simulation.motions[0], since_s);
        let left = (-k * since_s).exp();
        assert_near(body.velocity_in_world, left * start.velocity_in_world, INTEGRATED);
        let gone = (1.0 - left) / k * start.velocity_in_world;
        assert_near(body.position_in_world, start.position_in_world + gone, INTEGRATED);
        let (other, start) = flown(&simulation.motions[1], since_s);
        assert_near(other.velocity_in_world, start.velocity_in_world, EXACT);
    }
}

/// v = v0 / (1 + k v0 t) along a straight path.
#[test]
fn quadratic_drag_slows_by_the_way_flown() {
    let k = 0.2;
    let drag = effect("quadratic_drag", None, &[("k", &[k])]);
    let simulation = with(weightless(SimulationSpec::random_cuboids(2)), &[drag]);
    assert_eq!(simulation.truth.effects.len(), 2, "one of each body");
    for motion in &simulation.motions {
        for since_s in MOMENTS_S {
            let (body, start) = flown(motion, since_s);
            let v0 = start.velocity_in_world;
            let expected = v0 / (1.0 + k * v0.norm() * since_s);
            assert_near(body.velocity_in_world, expected, INTEGRATED);
        }
    }
}

/// A ball's spin is constant, so v turns about it at the rate k ω: a circle.
#[test]
fn the_magnus_force_leads_a_ball_in_a_circle() {
    let k = 0.05;
    let simulation = with(weightless(balls(3)), &[effect("magnus", Some("b"), &[("k", &[k])])]);
    for since_s in MOMENTS_S {
        let (body, start) = flown(&simulation.motions[1], since_s);
        let turn = UnitQuaternion::new(k * since_s * start.omega_in_world());
        assert_near(body.velocity_in_world, turn * start.velocity_in_world, INTEGRATED);
    }
}

/// k = k0 exp(−κ t); a ball has turned by ω0 (1 − exp(−κ t)) / κ.
#[test]
fn spin_drag_slows_a_ball_s_spin_exponentially() {
    let kappa = 0.9;
    let drag = effect("spin_drag", Some("a"), &[("kappa", &[kappa])]);
    let simulation = with(balls(1), &[drag]);
    for since_s in MOMENTS_S {
        let (body, start) = flown(&simulation.motions[0], since_s);
        let left = (-kappa * since_s).exp();
        let k0 = start.angular_momentum_in_world;
        assert_near(body.angular_momentum_in_world, left * k0, INTEGRATED);
        let turn = UnitQuaternion::new((1.0 - left) / kappa * start.omega_in_world());
        assert!(body.world_from_body.angle_to(&(turn * start.world_from_body)) < INTEGRATED);
    }
}

/// A constant force, gravity of another size and gravity tilted: a parabola by another acceleration.
#[test]
fn other_constant_accelerations_give_other_parabolas() {
    let g = Vector3::new(0.0, -9.81, 0.0);
    let wind = Vector3::new(0.4, 0.1, -0.7);
    let (first, second): (f64, f64) = (0.1, -0.06);
    let cases = [
        (effect("constant_force", None, &[("a", wind.as_slice())]), g + wind),
        (effect("gravity_scale", None, &[("s", &[0.93])]), 0.93 * g),
        (
            effect("gravity_tilt", None, &[("tilt1", &[first]), ("tilt2", &[second])]),
            Vector3::zeros(),
        ),
    ];
    for (effect, expected) in cases {
        let simulation = with(SimulationSpec::random_cuboids(5), &[effect]);
        for motion in &simulation.motions {
            let (body, start) = flown(motion, 0.5);
            let found = (body.velocity_in_world - start.velocity_in_world) / 0.5;
            if expected != Vector3::zeros() {
                assert_near(found, expected, 10.0 * INTEGRATED);
            } else {
                // Two right-angled turns after each other: cos of the whole is the cosines' product.
                assert!((found.norm() - 9.81).abs() < 10.0 * INTEGRATED);
                let angle = found.angle(&g);
                assert!((angle.cos() - first.cos() * second.cos()).abs() < INTEGRATED);
            }
            let way = body.position_in_world - start.position_in_world;
            assert_near(way, 0.5 * start.velocity_in_world + 0.125 * found, INTEGRATED);
        }
    }
}
