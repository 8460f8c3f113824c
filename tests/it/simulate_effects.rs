//! Simulations with effects: closed forms, what is seen, broken requests, and that the
//! reconstruction finds again what was put in.

use nalgebra::{UnitQuaternion, Vector3};
use smash::effect::EffectRequest;
use smash::reconstruct::{Number, RefinedOptions};
use smash::rigid_body::RigidBody;
use smash::scene::{Camera, Noise, ObservationFile};
use smash::simulate::{
    EffectSpec, Motion, RegularSampling, Sampling, Simulation, SimulationSpec, simulate,
};
use smash::{Options, Scene};

/// Flights with effects are integrated to 1e-9; velocities in m/s and positions in m likewise.
const INTEGRATED: f64 = 1e-9;
/// What happens at an instant is as exact as numbers are.
const EXACT: f64 = 1e-12;
/// Times on both sides of a collision, in s from it.
const MOMENTS_S: [f64; 5] = [-0.6, -0.23, 0.004, 0.31, 0.6];

fn effect(name: &str, body: Option<&str>, parameters: &[(&str, &[f64])]) -> EffectSpec {
    let parameters =
        parameters.iter().map(|(name, value)| (name.to_string(), Number::from(value.to_vec())));
    EffectSpec { name: name.into(), body: body.map(String::from), parameters: parameters.collect() }
}

fn with(mut spec: SimulationSpec, effects: &[EffectSpec]) -> Simulation {
    spec.effects = effects.to_vec();
    simulate(&spec).unwrap()
}

fn weightless(spec: SimulationSpec) -> SimulationSpec {
    SimulationSpec { gravity: 0.0, ..spec }
}

/// Two balls whose turning is seen.
fn balls(seed: u64) -> SimulationSpec {
    let mut spec = SimulationSpec::random_balls(seed);
    spec.bodies.iter_mut().for_each(|body| body.measure_orientation = None);
    spec
}

/// The states at `since_s` from the collision, and where that flight starts.
fn flown(motion: &Motion, since_s: f64) -> (RigidBody, &RigidBody) {
    let start = if since_s < 0.0 { &motion.before } else { &motion.after };
    (motion.at(motion.collision_time_s + since_s), start)
}

fn assert_near(found: Vector3<f64>, expected: Vector3<f64>, tolerance: f64) {
    let off = (found - expected).norm();
    assert!(off < tolerance, "{found} isn't {expected}: {off:e} off");
}

fn seen(simulation: &Simulation, body: usize) -> &[ObservationFile] {
    simulation.scene_file.bodies[body].observations.as_deref().unwrap()
}

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

fn loading(offset: Vector3<f64>) -> EffectSpec {
    effect("com_offset", Some("a"), &[("offset", offset.as_slice())])
}

/// The same place of the shape of a, with its centre of mass moved in it.
fn loaded(mut spec: SimulationSpec, offset: Vector3<f64>) -> SimulationSpec {
    let [w, x, y, z] = spec.bodies[0].orientation.unwrap();
    let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
    let centre = Vector3::from(spec.bodies[0].position.unwrap());
    spec.bodies[0].position = Some((centre + q.transform_vector(&offset)).into());
    spec
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

#[test]
fn the_same_specification_gives_the_same_scene_and_survives_its_file() {
    let mut spec = SimulationSpec::random_cuboids(11);
    spec.effects = vec![
        effect("quadratic_drag", Some("a"), &[("k", &[0.1])]),
        effect("constant_force", None, &[("a", &[0.1, 0.2, 0.3])]),
    ];
    let simulation = simulate(&spec).unwrap();
    assert_eq!(simulation, simulate(&spec).unwrap());
    let again = SimulationSpec::parse(&spec.to_json(), "spec.json").unwrap();
    assert_eq!(again, spec);
    let bodies: Vec<_> = simulation.truth.effects.iter().map(|e| e.body.as_deref()).collect();
    assert_eq!(bodies, [Some("a"), Some("a"), Some("b")]);
}

/// A law of the user's own, by its path: a spring to a point pulls there.
#[test]
fn an_effect_file_works_as_a_name_does() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spring.toml");
    let text = "name = \"spring\"\ntitle = \"A spring to the origin\"\n\
        [parameters.s]\nunit = \"1/s^2\"\nnull = 0.0\nbounds = [0.0, 100.0]\nscale = 1.0\n\
        typical = \"4\"\n[law]\nacceleration = \"-s * p\"\n";
    std::fs::write(&path, text).unwrap();
    let spring = effect(path.to_str().unwrap(), Some("a"), &[("s", &[4.0])]);
    let simulation = with(weightless(SimulationSpec::random_cuboids(12)), &[spring]);
    assert_eq!(simulation.truth.effects[0].name, "spring");
    let (body, start) = flown(&simulation.motions[0], 0.6);
    // Harmonic, at 2 rad/s.
    let angle: f64 = 2.0 * 0.6;
    let expected =
        angle.cos() * start.position_in_world + angle.sin() / 2.0 * start.velocity_in_world;
    assert_near(body.position_in_world, expected, INTEGRATED);
}

#[test]
fn a_broken_effect_is_named_with_its_place_and_mend() {
    let drag = |parameters: &[(&str, &[f64])]| effect("linear_drag", Some("a"), parameters);
    let broken = [
        (effect("linear_darg", None, &[]), "effects[0].name", "linear_drag"),
        (effect("-", None, &[]), "effects[0].name", "catalogue"),
        (drag(&[]), "effects[0].parameters", "`k`: a number from 0 to 1000 1/s"),
        (drag(&[("k", &[0.1]), ("K", &[1.0])]), "effects[0].parameters", "did you mean `k`?"),
        (drag(&[("k", &[-0.1])]), "effects[0].parameters.k", "0 to 1000"),
        (drag(&[("k", &[f64::NAN])]), "effects[0].parameters.k", "0 to 1000"),
        (drag(&[("k", &[0.1, 0.2, 0.3])]), "effects[0].parameters.k", "a number"),
        (effect("linear_drag", Some("c"), &[("k", &[0.1])]), "effects[0]", "`a`"),
        (effect("gravity_scale", Some("a"), &[("s", &[1.1])]), "effects[0]", "leave `@a` out"),
        (effect("depth_scale", None, &[("s", &[1.1])]), "effects[0]", "complete the scene"),
        (effect("friction", None, &[("mu", &[0.1])]), "effects[0]", "complete the scene"),
        (effect("magnus", None, &[("k", &[0.1]), ("kk", &[0.1])]), "effects[0].parameters", "`k`"),
    ];
    for (effect, place, hint) in broken {
        let mut spec = SimulationSpec::random_cuboids(0);
        spec.effects = vec![effect];
        let error = simulate(&spec).unwrap_err();
        assert_eq!(error.place(), Some(place), "{error}");
        assert!(error.hint().is_some_and(|text| text.contains(hint)), "{error}");
    }
}

/// A law that explodes, a contact that jams, a flight of hours: refused, not computed.
#[test]
fn endless_and_infinite_motions_are_refused() {
    let mut explosive = SimulationSpec::random_cuboids(0);
    explosive.effects = vec![effect("quadratic_drag", None, &[("k", &[10.0])])];
    assert!(simulate(&explosive).is_err(), "backwards it is infinitely fast within a second");

    let mut jammed = SimulationSpec::random_box_drop(0);
    let mut hint = None;
    for mu in [1.0, 2.0, 5.0] {
        jammed.effects = vec![effect("friction", None, &[("mu", &[mu])])];
        hint = hint.or(simulate(&jammed).err());
    }
    if let Some(error) = hint {
        assert_eq!(error.place(), Some("effects"), "{error}");
    }

    let mut endless = SimulationSpec::random_cuboids(0);
    endless.effects = vec![effect("linear_drag", None, &[("k", &[0.1])])];
    endless.observations = Sampling::Times(vec![-5e4, 0.1, 0.2, 1.0, 1.1]);
    let error = simulate(&endless).unwrap_err();
    assert_eq!(error.place(), Some("observations"), "{error}");
}

/// What one is told with noise-free poses: the effect's parameters come back, and with them the
/// collision, for each effect of the catalogue.
#[test]
fn each_effect_is_found_again() {
    let mut pair = SimulationSpec::random_cuboids(1);
    pair.observations = every_third();
    pair.camera = Some(Camera { position: [0.5, 1.0, 5.0], more: serde_json::Map::new() });
    let mut drop = SimulationSpec::random_box_drop(2);
    drop.observations = every_third();
    let frame = |spec: &SimulationSpec, body: usize, index: usize| {
        let simulation = simulate(spec).unwrap();
        simulation.scene.bodies()[body].observations[index].time_s
    };
    let (early, gap) = (frame(&pair, 1, 4), frame(&pair, 0, 20) + 0.02);
    let offset = Vector3::new(0.012, -0.02, 0.015);
    let cases = [
        (&pair, effect("linear_drag", Some("b"), &[("k", &[0.3])])),
        (&pair, effect("quadratic_drag", Some("a"), &[("k", &[0.15])])),
        (&pair, effect("magnus", Some("a"), &[("k", &[0.02])])),
        (&pair, effect("constant_force", Some("b"), &[("a", &[0.4, 0.0, -0.3])])),
        (&pair, effect("gravity_scale", None, &[("s", &[0.96])])),
        (&pair, effect("gravity_tilt", None, &[("tilt1", &[0.08]), ("tilt2", &[-0.05])])),
        (&pair, effect("spin_drag", Some("a"), &[("kappa", &[0.3])])),
        (&pair, effect("inertia", Some("a"), &[("factor", &[1.2, 0.9, 1.1])])),
        (&pair, loading(offset)),
        (&drop, effect("friction", None, &[("mu", &[0.06])])),
        (&pair, effect("external_impulse", Some("b"), &[("P", &[0.1, 0.15, -0.1])])),
        (&pair, effect("torsional_impulse", None, &[("M", &[0.004])])),
        (
            &pair,
            effect(
                "second_impact",
                Some("a"),
                &[("time", &[gap]), ("impulse", &[0.3, 0.2, 0.1]), ("spin", &[0.004, 0.0, 0.002])],
            ),
        ),
        (
            &pair,
            effect(
                "outlier",
                Some("b"),
                &[("time", &[early]), ("shift", &[0.05, -0.03, 0.0]), ("turn", &[0.2, 0.0, 0.1])],
            ),
        ),
        (&pair, effect("time_offset", Some("b"), &[("delay", &[0.02])])),
        (&pair, effect("depth_scale", Some("b"), &[("s", &[1.03])])),
    ];
    for (spec, effect) in cases {
        let is_loaded = effect.name == "com_offset";
        let spec = if is_loaded { loaded(spec.clone(), offset) } else { spec.clone() };
        let simulation = with(spec, std::slice::from_ref(&effect));
        let mut scene_file = simulation.scene_file.clone();
        scene_file.noise = Some(Noise { position: 1e-3, orientation: 5e-3 });
        let scene = Scene::from_file(scene_file).unwrap();
        let body = effect.body.as_ref().map_or(String::new(), |body| format!("@{body}"));
        let request = EffectRequest::parse(&format!("{}{body}", effect.name)).unwrap();
        let options = RefinedOptions { effects: vec![request], ..RefinedOptions::default() };
        let result = smash::reconstruct(&scene, &Options::Refined(options)).unwrap();
        let name = &effect.name;
        // Poses are exact: what is left of χ² is rounding and the prior on gravity's direction.
        let chi2 = result.fit.chi2.unwrap();
        assert!(chi2 < 1e-2, "{name}: χ² {chi2:e}");
        let truth = &simulation.truth;
        let restitution = result.restitution.value.unwrap();
        assert!((restitution - truth.restitution).abs() < 1e-3, "{name}: {restitution}");
        if let Some(mass_ratio) = truth.mass_ratio {
            let found = result.mass_ratio.unwrap().value.unwrap();
            assert!((found / mass_ratio - 1.0).abs() < 1e-3, "{name}: {found}");
        }
        for (parameter, expected) in &effect.parameters {
            let found = result.effects[0].parameters[parameter].value.unwrap();
            let [found, expected] = [&found, expected].map(|number| {
                Vector3::from_iterator(
                    number.components().iter().copied().chain([0.0, 0.0]).take(3),
                )
            });
            let off = (found - expected).norm() / expected.norm();
            assert!(off < 1e-2, "{name}.{parameter}: {found} isn't {expected}");
        }
    }
}

fn every_third() -> Sampling {
    Sampling::Regular(RegularSampling { interval: 3, frame_count: 90, gap: Some(3) })
}
