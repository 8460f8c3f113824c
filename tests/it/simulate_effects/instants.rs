//! What happens at a moment: friction, impulses from elsewhere, a second impact.

use super::*;

/// J = j (n − μ × sliding direction) at the contact point; the restitution is as asked for with the
/// friction, on any shape.
#[test]
fn friction_brakes_the_sliding_by_its_share_of_the_normal_impulse() {
    let mu = 0.07;
    for seed in 0..4 {
        let mut spec = SimulationSpec::random_box_drop(seed);
        spec.collision.restitution = Some(0.6);
        let smooth = with(spec.clone(), &[]);
        let simulation = with(spec, &[effect("friction", None, &[("mu", &[mu])])]);
        let Motion { before, after, .. } = &simulation.motions[0];
        let point = Vector3::from(simulation.truth.contact_point);
        let change = after.velocity_in_world - before.velocity_in_world;
        let mut sliding = before.point_velocity_in_world(&point);
        let approach = sliding.y;
        sliding.y = 0.0;
        let tangential = Vector3::new(change.x, 0.0, change.z);
        assert_near(tangential, -mu * change.y * sliding.normalize(), EXACT);
        let lever = point - before.position_in_world;
        let gained = after.angular_momentum_in_world - before.angular_momentum_in_world;
        assert_near(gained, lever.cross(&change), EXACT);
        let parting = after.point_velocity_in_world(&point).y;
        assert!((parting + 0.6 * approach).abs() < EXACT, "restitution {}", -parting / approach);
        assert_near(Vector3::from(simulation.truth.impulse), change.y * Vector3::y(), EXACT);
        assert_ne!(simulation.truth.impulse, smooth.truth.impulse);
    }
}

/// A third party's impulses come on top: restitution and contact impulse stay what they are.
#[test]
fn impulses_from_elsewhere_are_not_the_contact_s() {
    let spec = SimulationSpec::random_cuboids(4);
    let push = Vector3::new(0.1, -0.05, 0.2);
    let twist = 0.003;
    let base = with(spec.clone(), &[]);
    let simulation = with(
        spec,
        &[
            effect("external_impulse", Some("b"), &[("P", push.as_slice())]),
            effect("torsional_impulse", None, &[("M", &[twist])]),
        ],
    );
    let (truth, plain) = (&simulation.truth, &base.truth);
    assert_eq!(truth.restitution, plain.restitution);
    assert_near(truth.impulse.into(), plain.impulse.into(), EXACT);
    let after = |simulation: &Simulation, body: usize| simulation.motions[body].after;
    let normal = Vector3::from(truth.normal);
    for (body, sign) in [(0, 1.0), (1, -1.0)] {
        let (found, base) = (after(&simulation, body), after(&base, body));
        let pushed = if body == 1 { push / found.mass } else { Vector3::zeros() };
        assert_near(found.velocity_in_world - base.velocity_in_world, pushed, EXACT);
        let turned = found.angular_momentum_in_world - base.angular_momentum_in_world;
        assert_near(turned, sign * twist * normal, EXACT);
    }
}

/// Nothing changes up to the event; there velocity and angular momentum jump, and the place doesn't.
#[test]
fn a_second_impact_is_a_kink() {
    let spec = SimulationSpec::random_cuboids(6);
    let at_s = spec.collision.time + 0.3;
    let (impulse, spin) = (Vector3::new(0.3, 0.2, -0.1), Vector3::new(0.002, -0.004, 0.001));
    let kick = effect(
        "second_impact",
        Some("a"),
        &[("time", &[at_s]), ("impulse", impulse.as_slice()), ("spin", spin.as_slice())],
    );
    let base = with(spec.clone(), &[]);
    let simulation = with(spec, &[kick]);
    let [motion, plain] = [&simulation, &base].map(|simulation| &simulation.motions[0]);
    for early_s in [-0.7, -0.1, 0.1, 0.29] {
        let time_s = motion.collision_time_s + early_s;
        let (found, expected) = (motion.at(time_s), plain.at(time_s));
        assert_near(found.position_in_world, expected.position_in_world, INTEGRATED);
    }
    let (early, late) = (motion.at(at_s - 1e-9), motion.at(at_s + 1e-9));
    assert_near(late.velocity_in_world - early.velocity_in_world, impulse, 1e-7);
    assert_near(late.position_in_world, early.position_in_world, 1e-7);
    assert_near(late.angular_momentum_in_world - early.angular_momentum_in_world, spin, EXACT);
}
