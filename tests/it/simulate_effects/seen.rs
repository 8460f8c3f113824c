//! What is seen of a body: when, where, and of which shape.

use super::*;

/// A delayed stamp shows where the body was before; the other body's stamps are right.
#[test]
fn a_time_offset_moves_the_stamps() {
    let delay = 0.021;
    let simulation = with(
        SimulationSpec::random_cuboids(7),
        &[effect("time_offset", Some("b"), &[("delay", &[delay])])],
    );
    for (body, offset) in [(0, 0.0), (1, delay)] {
        for pose in seen(&simulation, body) {
            let truly = simulation.motions[body].at(pose.frame.unwrap() / 60.0 - offset);
            assert_near(pose.position.into(), truly.position_in_world, INTEGRATED);
        }
    }
}

/// Depth stretches what is seen from the camera; an offset centre of mass swings the annotated one
/// about it. Both leave the motion alone.
#[test]
fn what_is_seen_may_be_elsewhere() {
    let camera = Vector3::new(0.3, 1.2, 4.0);
    let mut spec = SimulationSpec::random_cuboids(8);
    spec.camera = Some(Camera { position: camera.into(), more: serde_json::Map::new() });
    let simulation = with(spec, &[effect("depth_scale", Some("b"), &[("s", &[1.03])])]);
    assert_eq!(simulation.scene.camera().unwrap().position, <[f64; 3]>::from(camera));
    for pose in seen(&simulation, 1) {
        let truly = simulation.motions[1].at(pose.frame.unwrap() / 60.0).position_in_world;
        assert_near(pose.position.into(), camera + 1.03 * (truly - camera), INTEGRATED);
    }

    let offset = Vector3::new(0.01, -0.015, 0.02);
    let simulation = with(loaded(SimulationSpec::random_cuboids(8), offset), &[loading(offset)]);
    for pose in seen(&simulation, 0) {
        let truly = simulation.motions[0].at(pose.frame.unwrap() / 60.0);
        let swung = truly.world_from_body.transform_vector(&offset);
        assert_near(pose.position.into(), truly.position_in_world - swung, INTEGRATED);
    }
}

/// The contact is on the surface of the shape, wherever the centre of mass is.
#[test]
fn the_contact_lies_on_the_shape_around_its_annotated_centre() {
    let offset = Vector3::new(0.01, -0.015, 0.02);
    let mut unmoved = SimulationSpec::random_cuboids(8);
    unmoved.effects = vec![loading(offset)];
    let error = simulate(&unmoved).unwrap_err();
    assert!(error.problem().contains("off the surface of `a`"), "{error}");
    with(loaded(SimulationSpec::random_cuboids(8), offset), &[loading(offset)]);
}

/// One pose is displaced and turned, by exactly so much; all others stay.
#[test]
fn an_outlier_is_one_pose() {
    let spec = SimulationSpec::random_cuboids(9);
    let (shift, turn) = (Vector3::new(0.04, 0.0, -0.02), Vector3::new(0.3, -0.1, 0.2));
    let outlier = |time_s: f64, size: f64| {
        let [shift, turn] = [size * shift, size * turn];
        effect(
            "outlier",
            Some("b"),
            &[("time", &[time_s]), ("shift", shift.as_slice()), ("turn", turn.as_slice())],
        )
    };
    let base = with(spec.clone(), &[outlier(20.0 / 60.0, 0.0)]);
    let simulation = with(spec.clone(), &[outlier(20.0 / 60.0, 1.0)]);
    for (body, (found, plain)) in
        simulation.scene.bodies().iter().zip(base.scene.bodies()).enumerate()
    {
        for (index, (found, plain)) in
            found.observations.iter().zip(&plain.observations).enumerate()
        {
            let hit = f64::from(u8::from((body, index) == (1, 20)));
            assert_near(found.position_in_world - plain.position_in_world, hit * shift, EXACT);
            let [q, plain] = [found, plain].map(|pose| pose.world_from_body.unwrap());
            assert_near((plain.inverse() * q).scaled_axis(), hit * turn, EXACT);
        }
    }
    let missed = SimulationSpec { effects: vec![outlier(0.34, 1.0)], ..spec };
    let error = simulate(&missed).unwrap_err();
    assert_eq!(error.place(), Some("effects[0].parameters.time"));
    assert!(error.hint().unwrap().contains("0.333333"), "{error}");
}

/// Other moments of inertia: the same spin is another angular momentum, the contact answers to the
/// impulse by them, and the flight keeps momentum and energy with them.
#[test]
fn inertia_is_the_body_s_everywhere() {
    let factor = Vector3::new(1.4, 0.8, 1.1);
    let spec = SimulationSpec::random_cuboids(10);
    let base = with(spec.clone(), &[]);
    let simulation =
        with(spec.clone(), &[effect("inertia", Some("a"), &[("factor", factor.as_slice())])]);
    let [motion, plain] = [&simulation, &base].map(|simulation| &simulation.motions[0]);
    let expected = plain.before.principal_inertia.component_mul(&factor);
    assert_near(motion.before.principal_inertia, expected, EXACT);
    assert_near(motion.before.omega_in_world(), plain.before.omega_in_world(), EXACT);

    let point = Vector3::from(simulation.truth.contact_point);
    let normal = Vector3::from(simulation.truth.normal);
    let parting = |pick: fn(&Motion) -> &RigidBody| {
        let speed = |motion: &Motion| pick(motion).point_velocity_in_world(&point).dot(&normal);
        speed(&simulation.motions[0]) - speed(&simulation.motions[1])
    };
    let restitution = -parting(|m| &m.after) / parting(|m| &m.before);
    assert!((restitution - spec.collision.restitution.unwrap()).abs() < EXACT);

    let (body, start) = flown(motion, 0.6);
    let turning = |body: &RigidBody| body.angular_momentum_in_world.dot(&body.omega_in_world());
    assert!((turning(&body) / turning(start) - 1.0).abs() < INTEGRATED);
    assert_near(body.angular_momentum_in_world, start.angular_momentum_in_world, EXACT);
}
