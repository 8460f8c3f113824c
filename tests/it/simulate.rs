//! The dynamics run forwards: what must hold in every simulated scene.

use nalgebra::{UnitQuaternion, Vector3};
use smash::ErrorKind;
use smash::rigid_body::RigidBody;
use smash::scene::Noise;
use smash::simulate::{
    Motion, NoiseSpec, RegularSampling, Sampling, Simulation, SimulationSpec, simulate,
};

/// Relative; the bar that simulations are held to. Rounding reaches some 1e-14.
const EXACT: f64 = 1e-10;

/// Every kind of collision, ten of each.
fn simulations() -> Vec<(SimulationSpec, Simulation)> {
    let kinds = [
        SimulationSpec::random_cuboids,
        SimulationSpec::random_balls,
        SimulationSpec::random_box_drop,
        SimulationSpec::random_ball_drop,
    ];
    let mut specs: Vec<_> = (0..10).flat_map(|seed| kinds.map(|random| random(seed))).collect();
    for spec in &mut specs {
        // A few poses do here: the laws are tested on the motion itself.
        spec.observations = every(9, 80);
    }
    specs.into_iter().map(|spec| (spec.clone(), simulate(&spec).unwrap())).collect()
}

fn every(interval: u32, frame_count: u32) -> Sampling {
    Sampling::Regular(RegularSampling { interval, frame_count, gap: Some(interval) })
}

/// Times on both sides of a collision, in s from it.
const MOMENTS_S: [f64; 6] = [-0.7, -0.31, -1e-9, 1e-9, 0.05, 0.66];

fn at_collision(motion: &Motion) -> (RigidBody, RigidBody) {
    (motion.before, motion.after)
}

/// Both bodies together keep momentum, and angular momentum about any point, near or far.
#[test]
fn a_collision_in_mid_air_conserves_momentum_and_angular_momentum() {
    let mut pairs = 0;
    for (_, simulation) in simulations() {
        let [a, b] = simulation.motions.as_slice() else {
            continue;
        };
        pairs += 1;
        let ((a_before, a_after), (b_before, b_after)) = (at_collision(a), at_collision(b));
        let momentum = |body: &RigidBody| body.mass * body.velocity_in_world;
        let before = momentum(&a_before) + momentum(&b_before);
        let scale = momentum(&a_before).norm() + momentum(&b_before).norm();
        let gained = momentum(&a_after) + momentum(&b_after) - before;
        assert!(gained.norm() < EXACT * scale);

        let contact = Vector3::from(simulation.truth.contact_point);
        for about in [Vector3::zeros(), contact, Vector3::new(100.0, -50.0, 7.0)] {
            let of = |body: &RigidBody| body.angular_momentum_about(&about);
            let scale = of(&a_before).norm() + of(&b_before).norm();
            let gained = of(&a_after) + of(&b_after) - of(&a_before) - of(&b_before);
            assert!(gained.norm() < EXACT * scale, "about {about}");
        }
    }
    assert_eq!(pairs, 20);
}

/// A smooth floor pushes along its normal only: what moves along it, and what turns about it,
/// stays.
#[test]
fn a_smooth_floor_neither_drags_nor_twists() {
    let mut drops = 0;
    for (_, simulation) in simulations() {
        let [body] = simulation.motions.as_slice() else {
            continue;
        };
        drops += 1;
        let (before, after) = at_collision(body);
        let push = after.velocity_in_world - before.velocity_in_world;
        assert!(push.y > 0.0);
        assert!(push.xz().norm() < EXACT * push.y);
        let twist = after.angular_momentum_in_world - before.angular_momentum_in_world;
        assert!(twist.y.abs() < EXACT * before.angular_momentum_in_world.norm());
    }
    assert_eq!(drops, 20);
}

/// In flight kinetic and potential energy add up to the same at any time, and the angular
/// momentum is the same vector. Were the spin constant instead, the energy of a box would be off
/// by more than 1 %: 1e8 times this tolerance.
#[test]
fn energy_and_angular_momentum_stay_in_flight() {
    let mut worst_wrong = 0.0_f64;
    for (spec, simulation) in simulations() {
        for motion in &simulation.motions {
            let energy = |body: &RigidBody| {
                body.kinetic_energy() + body.mass * spec.gravity * body.position_in_world.y
            };
            for moment_s in MOMENTS_S {
                let start = if moment_s < 0.0 { &motion.before } else { &motion.after };
                let body = motion.at(motion.collision_time_s + moment_s);
                let scale = start.kinetic_energy() + body.kinetic_energy();
                assert!((energy(&body) - energy(start)).abs() < EXACT * scale);
                assert_eq!(body.angular_momentum_in_world, start.angular_momentum_in_world);

                let spin = start.omega_in_world();
                let wrong = RigidBody {
                    world_from_body: UnitQuaternion::new(spin * moment_s) * start.world_from_body,
                    ..body
                };
                worst_wrong = worst_wrong.max((energy(&wrong) - energy(start)).abs() / scale);
            }
        }
    }
    assert!(worst_wrong > 0.01, "a constant spin is off by {worst_wrong}");
}

/// Centres fall on a parabola: seen from the collision, p = p_c + v t − ½ g t² up.
#[test]
fn bodies_fall_as_galileo_says() {
    for (_, simulation) in simulations() {
        for motion in &simulation.motions {
            let body = motion.at(motion.collision_time_s + 0.5);
            let start = &motion.after;
            let straight = start.position_in_world + 0.5 * start.velocity_in_world;
            let fallen = straight - body.position_in_world;
            let expected = Vector3::new(0.0, 9.81 * 0.125, 0.0);
            assert!((fallen - expected).norm() < 1e-12);
        }
    }
}

/// The restitution is what was asked for, measured on the velocities of the touching points; the
/// energy never rises, and stays when nothing is lost.
#[test]
fn the_bodies_part_as_asked_and_gain_no_energy() {
    for (mut spec, _) in simulations() {
        for restitution in [0.0, 0.37, 1.0] {
            spec.collision.restitution = Some(restitution);
            let simulation = simulate(&spec).unwrap();
            let point = Vector3::from(simulation.truth.contact_point);
            let normal = Vector3::from(simulation.truth.normal);
            let gap_speed = |pick: fn(&Motion) -> &RigidBody| {
                let speed =
                    |motion: &Motion| pick(motion).point_velocity_in_world(&point).dot(&normal);
                let speeds: Vec<f64> = simulation.motions.iter().map(speed).collect();
                speeds[0] - speeds.get(1).unwrap_or(&0.0)
            };
            let (before, after) = (gap_speed(|m| &m.before), gap_speed(|m| &m.after));
            assert!(before < 0.0, "they approach");
            assert!((after + restitution * before).abs() < EXACT * before.abs());

            let energy = |pick: fn(&Motion) -> &RigidBody| -> f64 {
                simulation.motions.iter().map(|motion| pick(motion).kinetic_energy()).sum()
            };
            let (before, after) = (energy(|m| &m.before), energy(|m| &m.after));
            assert!(after <= before * (1.0 + EXACT));
            assert_eq!((after / before - 1.0).abs() < EXACT, restitution == 1.0);
        }
    }
}

/// The impulse of one simulation, put into another in place of its restitution, gives the same.
#[test]
fn restitution_and_impulse_say_the_same() {
    for (mut spec, by_restitution) in simulations() {
        spec.collision.restitution = None;
        spec.collision.normal = None;
        spec.collision.impulse = Some(by_restitution.truth.impulse);
        let by_impulse = simulate(&spec).unwrap();
        let difference = by_impulse.truth.restitution - by_restitution.truth.restitution;
        assert!(difference.abs() < EXACT);
        assert_eq!(by_impulse.scene_file, by_restitution.scene_file);
    }
}

/// No direction is special: the world turned, the scene turns with it. A leftover `y` or a spin
/// taken in the body's frame would show as decimetres or whole radians.
#[test]
fn a_turned_specification_gives_the_turned_scene() {
    let turn = UnitQuaternion::new(Vector3::new(0.7, -1.9, 0.4));
    for (spec, simulation) in simulations() {
        let turned = simulate(&turned_spec(&spec, &turn)).unwrap();
        let pairs = simulation.scene.bodies().iter().zip(turned.scene.bodies());
        for (body, turned_body) in pairs {
            for (seen, turned_seen) in body.observations.iter().zip(&turned_body.observations) {
                let expected = turn * seen.position_in_world;
                assert!((expected - turned_seen.position_in_world).norm() < 1e-9);
                if let Some(q) = seen.world_from_body {
                    assert!((turn * q).angle_to(&turned_seen.world_from_body.unwrap()) < 1e-9);
                }
            }
        }
    }
}

fn turned_spec(spec: &SimulationSpec, turn: &UnitQuaternion<f64>) -> SimulationSpec {
    let vector = |v: [f64; 3]| <[f64; 3]>::from(turn * Vector3::from(v));
    let mut turned = spec.clone();
    turned.up = vector(spec.up);
    turned.collision.contact_point = vector(spec.collision.contact_point);
    turned.collision.normal = spec.collision.normal.map(vector);
    for body in &mut turned.bodies {
        body.position = body.position.map(vector);
        body.velocity = body.velocity.map(vector);
        body.angular_velocity = body.angular_velocity.map(vector);
        body.normal = body.normal.map(vector);
        body.orientation = body.orientation.map(|[w, x, y, z]| {
            let q = turn * UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
            [q.w, q.i, q.j, q.k]
        });
    }
    turned
}

/// What is seen is the motion, at the frames asked for: left and right of a gap of twice the
/// interval, as in the paper.
#[test]
fn the_paper_s_sampling_leaves_a_gap_around_the_collision() {
    // "An interval of 19 frames means only four annotated poses": 45 − 2·19, 45 − 19, …
    let sampling = |interval| RegularSampling { interval, frame_count: 90, gap: None };
    assert_eq!(sampling(19).frame_numbers(45.2), [7, 26, 64, 83]);
    assert_eq!(sampling(14).frame_numbers(44.6), [3, 17, 31, 59, 73, 87]);
    for interval in [1, 4, 9, 14, 19] {
        for collision_frame in [40.0, 42.5, 44.01, 47.99] {
            let frames = sampling(interval).frame_numbers(collision_frame);
            let before = frames.iter().filter(|&&f| f64::from(f) < collision_frame).count();
            let gap = frames[before] - frames[before - 1];
            assert_eq!(gap, 2 * interval);
            let steps = frames.windows(2).map(|pair| pair[1] - pair[0]);
            assert_eq!(
                steps.filter(|&step| step != interval).count(),
                usize::from(gap != interval)
            );
        }
    }
    let all = RegularSampling::every_frame(90).frame_numbers(44.2);
    assert_eq!(all, (0..90).collect::<Vec<u32>>());
}

#[test]
fn a_scene_shows_the_motion_at_the_times_asked_for() {
    let mut spec = SimulationSpec::random_cuboids(3);
    let collision_s = spec.collision.time;
    let times = [-0.5, -0.41, -0.1, 0.13, 0.2, 0.61].map(|since| collision_s + since);
    spec.observations = Sampling::Times(times.into());
    spec.bodies[1].observations = Some(Sampling::Frames(vec![1.0, 7.5, 20.0, 60.0, 88.0]));
    let simulation = simulate(&spec).unwrap();
    let observations =
        |index: usize| simulation.scene_file.bodies[index].observations.as_ref().unwrap();
    let seen_times: Vec<f64> = observations(0).iter().filter_map(|seen| seen.time).collect();
    assert_eq!(seen_times, times);
    for seen in observations(1) {
        let body = simulation.motions[1].at(seen.frame.unwrap() / 60.0);
        assert_eq!(Vector3::from(seen.position), body.position_in_world);
    }
    assert_eq!(observations(1).len(), 5);
}

#[test]
fn the_seed_decides_the_noise() {
    for noise in [gaussian(), NoiseSpec::Uniform(0.05)] {
        let with_seed = |seed| {
            let spec = SimulationSpec { noise, seed, ..SimulationSpec::random_cuboids(5) };
            simulate(&spec).unwrap().scene_file.to_json()
        };
        assert_eq!(with_seed(1), with_seed(1));
        assert_ne!(with_seed(1), with_seed(2));
    }
}

fn gaussian() -> NoiseSpec {
    NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 })
}

/// The errors of many poses: (positions in m, rotation vectors in rad), coordinate by coordinate.
fn errors(noise: NoiseSpec) -> (Vec<f64>, Vec<f64>) {
    let (mut positions, mut rotations) = (Vec::new(), Vec::new());
    for seed in 0..6 {
        let exact = simulate(&SimulationSpec::random_cuboids(seed)).unwrap();
        let noisy = smash::simulate::add_noise(exact.scene_file.clone(), &noise, seed);
        let noisy = smash::Scene::from_file(noisy).unwrap();
        for (true_body, body) in exact.scene.bodies().iter().zip(noisy.bodies()) {
            for (truth, seen) in true_body.observations.iter().zip(&body.observations) {
                positions.extend((seen.position_in_world - truth.position_in_world).iter());
                let turn = truth.world_from_body.unwrap().inverse() * seen.world_from_body.unwrap();
                rotations.extend(turn.scaled_axis().iter());
            }
        }
    }
    (positions, rotations)
}

/// 3240 deviates: their σ is known to 1.2 %, their mean to 1.8 % of σ. Four times that passes.
#[test]
fn gaussian_noise_is_as_large_as_it_says() {
    let (positions, rotations) = errors(gaussian());
    for (deviates, sigma) in [(positions, 0.002), (rotations, 0.01)] {
        let count = deviates.len() as f64;
        assert_eq!(count, 3240.0);
        let mean = deviates.iter().sum::<f64>() / count;
        let spread = (deviates.iter().map(|x| x * x).sum::<f64>() / count).sqrt();
        assert!(mean.abs() < 0.07 * sigma, "mean {mean}");
        assert!((spread / sigma - 1.0).abs() < 0.05, "σ {spread}");
        // A normal deviate is beyond 3 σ once in 370: not never, as a uniform one.
        let far = deviates.iter().filter(|x| x.abs() > 3.0 * sigma).count();
        assert!((1..=25).contains(&far), "{far} beyond 3 σ");
    }
}

#[test]
fn uniform_noise_scales_each_coordinate_by_up_to_its_fraction() {
    let spec = SimulationSpec::random_cuboids(1);
    let exact = simulate(&spec).unwrap().scene_file;
    let noisy = smash::simulate::add_noise(exact.clone(), &NoiseSpec::Uniform(0.1), 7);
    let mut factors = Vec::new();
    for (true_body, body) in exact.bodies.iter().zip(&noisy.bodies) {
        let pairs = true_body.observations.iter().flatten().zip(body.observations.iter().flatten());
        for (truth, seen) in pairs {
            factors.extend((0..3).map(|axis| seen.position[axis] / truth.position[axis] - 1.0));
            let length: f64 = seen.orientation.unwrap().iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-14, "normalised");
        }
    }
    let (least, most) = factors.iter().fold((0.0_f64, 0.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
    // 540 factors fill ± 10 % to a few parts in a hundred.
    assert!((-0.1..-0.095).contains(&least) && (0.095..0.1).contains(&most), "{least} {most}");
    let spread = (factors.iter().map(|x| x * x).sum::<f64>() / factors.len() as f64).sqrt();
    // 0.1/√3, known to 2 %.
    assert!((spread / 0.057_735 - 1.0).abs() < 0.08, "{spread}");
    assert_eq!(noisy.noise, None, "no σ describes it");
}

#[test]
fn what_the_noise_is_stands_in_the_scene() {
    let spec = SimulationSpec { noise: gaussian(), ..SimulationSpec::random_balls(2) };
    let scene_file = simulate(&spec).unwrap().scene_file;
    assert_eq!(scene_file.noise, Some(Noise { position: 0.002, orientation: 0.01 }));
    let unmeasured = |seen: &smash::scene::ObservationFile| seen.orientation.is_none();
    assert!(scene_file.bodies.iter().flat_map(|b| b.observations.iter().flatten()).all(unmeasured));
}

/// Random collisions are what their documentation says: touching, approaching, of stated sizes.
#[test]
fn random_collisions_keep_their_promises() {
    for seed in 0..10 {
        let spec = SimulationSpec::random_cuboids(seed);
        assert_eq!(spec, SimulationSpec::random_cuboids(seed));
        assert_ne!(spec, SimulationSpec::random_cuboids(seed + 1));
        assert!((0.3..4.0).contains(&spec.mass_ratio.unwrap()));
        assert!((0.2..0.95).contains(&spec.collision.restitution.unwrap()));
        let scene = simulate(&spec).unwrap().scene;
        assert!(scene.bodies().iter().all(|body| body.observations.len() == 90));
        assert!(scene.warnings().is_empty(), "{:?}", scene.warnings());
    }
}

type Change = fn(&mut SimulationSpec);

/// Each broken rule is named with its place; the mend is never missing.
#[test]
fn a_broken_specification_is_refused_with_its_place_and_a_mend() {
    let broken: [(&str, Change); 24] = [
        ("schema", |s| s.schema = "smash.scene/1".into()),
        ("fps", |s| s.fps = Some(0.0)),
        ("fps", |s| s.fps = None),
        ("up", |s| s.up = [0.0; 3]),
        ("gravity", |s| s.gravity = -9.81),
        ("mass_ratio", |s| s.mass_ratio = None),
        ("mass_ratio", |s| s.mass_ratio = Some(-1.0)),
        ("bodies", |s| s.bodies.truncate(1)),
        ("bodies[1].name", |s| s.bodies[1].name = "a".into()),
        ("bodies[0].normal", |s| s.bodies[0].normal = Some([0.0, 1.0, 0.0])),
        ("bodies[0]", |s| s.bodies[0].velocity = None),
        ("bodies[0].orientation", |s| s.bodies[0].orientation = Some([0.0; 4])),
        ("bodies[0].velocity[1]", |s| s.bodies[0].velocity = Some([0.0, f64::NAN, 0.0])),
        ("collision", let_them_part),
        ("collision.contact_point", |s| s.collision.contact_point[0] += 0.1),
        ("collision.normal", |s| s.collision.normal = Some([0.0; 3])),
        ("collision", |s| s.collision.normal = None),
        ("collision.restitution", |s| s.collision.restitution = Some(1.01)),
        ("collision.restitution", |s| s.collision.restitution = Some(f64::NAN)),
        ("collision", |s| s.collision.restitution = None),
        ("collision", |s| s.collision.impulse = Some([0.0, 1.0, 0.0])),
        ("noise.uniform", |s| s.noise = NoiseSpec::Uniform(1.0)),
        ("observations", |s| s.observations = every(44, 90)),
        ("observations.frames[2]", |s| {
            s.observations = Sampling::Frames(vec![1.0, 9.0, 5.0, 80.0, 81.0]);
        }),
    ];
    for (place, break_it) in broken {
        let mut spec = SimulationSpec::random_cuboids(0);
        break_it(&mut spec);
        let error = simulate(&spec).unwrap_err();
        assert_eq!(error.place(), Some(place), "{error}");
        assert_eq!(error.kind(), ErrorKind::Invalid);
        assert!(error.hint().is_some(), "{error}");
    }
}

fn let_them_part(spec: &mut SimulationSpec) {
    let normal = Vector3::from(spec.collision.normal.unwrap());
    spec.bodies[1].velocity = Some((-10.0 * normal).into());
}

/// A plane has rules of its own.
#[test]
fn a_broken_drop_is_refused() {
    let broken: [(&str, Change); 6] = [
        ("mass_ratio", |s| s.mass_ratio = Some(1.0)),
        ("bodies[1].shape", |s| s.bodies[1].shape = s.bodies[0].shape),
        ("bodies[1].normal", |s| s.bodies[1].normal = Some([0.0, 2.0, 0.0])),
        ("collision.contact_point", |s| s.bodies[1].height = Some(-0.2)),
        ("collision.normal", |s| s.collision.normal = Some([0.0, 1.0, 0.0])),
        ("collision.impulse", |s| {
            s.collision.restitution = None;
            s.collision.impulse = Some([0.1, 5.0, 0.0]);
        }),
    ];
    for (place, break_it) in broken {
        let mut spec = SimulationSpec::random_ball_drop(0);
        break_it(&mut spec);
        let error = simulate(&spec).unwrap_err();
        assert_eq!(error.place(), Some(place), "{error}");
        assert!(error.hint().is_some(), "{error}");
    }
}

/// Thousands of turns, seen often, would take hours: refused at once instead. The spin is about
/// the vertical, so the corner comes down as before.
#[test]
fn an_endless_computation_is_refused() {
    let mut spec = SimulationSpec::random_box_drop(0);
    spec.bodies[0].angular_velocity = Some([0.0, 9e4, 0.0]);
    let error = simulate(&spec).unwrap_err();
    assert!(error.problem().contains("turn too fast for too long"), "{error}");
}

/// The Bullet engine, which steps contacts and rotations its own way 600 000 times a second, moves
/// the same two boxes the same way: centres to its 3e-11 m, orientations to its 0.004°. With the
/// spin constant in flight they would be more than 5° apart.
#[test]
fn an_independent_engine_moves_the_bodies_the_same_way() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");
    let spec = SimulationSpec::read(format!("{data}/bullet_00.spec.json").as_ref()).unwrap();
    let bullet = smash::Scene::read(format!("{data}/bullet_00.json")).unwrap();
    let ours = simulate(&spec).unwrap();
    let mut worst_wrong_degrees = 0.0_f64;
    for (index, expected) in bullet.bodies().iter().enumerate() {
        let body = &ours.scene.bodies()[index];
        let after = &ours.motions[index].after;
        assert_eq!(body.observations.len(), expected.observations.len());
        for (seen, expected) in body.observations.iter().zip(&expected.observations) {
            assert_eq!(seen.time_s, expected.time_s);
            assert!((seen.position_in_world - expected.position_in_world).norm() < 1e-10);
            let [q, expected] = [seen, expected].map(|pose| pose.world_from_body.unwrap());
            assert!(q.angle_to(&expected).to_degrees() < 0.005);
            if seen.time_s > spec.collision.time {
                let turn = after.omega_in_world() * (seen.time_s - spec.collision.time);
                let wrong = UnitQuaternion::new(turn) * after.world_from_body;
                worst_wrong_degrees =
                    worst_wrong_degrees.max(wrong.angle_to(&expected).to_degrees());
            }
        }
    }
    assert!(worst_wrong_degrees > 5.0, "{worst_wrong_degrees}°");
}

/// Neither a film of years nor a collision aeons off it costs time or memory.
#[test]
fn frames_of_endless_films_are_bounded() {
    let endless = RegularSampling::every_frame(u32::MAX);
    let frames = endless.frame_numbers(1e9);
    assert_eq!(frames.len(), 200_000);
    assert!(frames.contains(&999_999_999) && frames.contains(&1_000_000_001), "nearest first");
    for off_film in [1e300, f64::INFINITY] {
        let frames = endless.frame_numbers(off_film);
        assert_eq!((frames.len(), frames.last()), (100_000, Some(&(u32::MAX - 1))));
    }
    let sparse = RegularSampling { interval: 7, frame_count: 49, gap: None };
    assert_eq!(sparse.frame_numbers(f64::INFINITY).len(), 7, "one every 7 frames of 49");
    for off_film in [-1e300, f64::NEG_INFINITY] {
        assert_eq!(endless.frame_numbers(off_film).first(), Some(&0));
    }
}

/// By stepping, the same frames as by trying each of the film.
#[test]
fn frames_are_those_at_whole_intervals_from_the_gap() {
    for interval in 1..6 {
        for gap in 0..8 {
            for collision in -20..60 {
                let collision_frame = f64::from(collision) / 2.0 + 0.1;
                let sampling = RegularSampling { interval, frame_count: 20, gap: Some(gap) };
                let (interval, gap) = (i64::from(interval), i64::from(gap));
                let last = (collision_frame - gap as f64 / 2.0).round() as i64;
                let is_seen = |&frame: &u32| {
                    let (before, after) = (last - i64::from(frame), i64::from(frame) - last - gap);
                    [before, after].iter().any(|off| *off >= 0 && off % interval == 0)
                };
                let expected: Vec<u32> = (0..20).filter(is_seen).collect();
                assert_eq!(sampling.frame_numbers(collision_frame), expected, "{sampling:?}");
            }
        }
    }
}
