//! Reconstructions of collisions whose truth is known: simulated, seen exactly, the collision in
//! the middle of its segment, where the paper puts it.

use std::sync::Mutex;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;
use smash::reconstruct::{Flag, Progress, Stage, reconstruct_with_progress};
use smash::scene::{Noise, ObservationFile, SceneFile};
use smash::simulate::{NoiseSpec, RegularSampling, Sampling, SimulationSpec, Truth, simulate};
use smash::{Options, Reconstruction, Scene, SchemaKind, reconstruct, schema};

/// How far a result may be from the truth.
struct Tolerance {
    /// Of the mass ratio, relative, and of the restitution.
    ratio: f64,
    /// Of velocities, in m/s.
    velocity: f64,
    /// Of angular velocities, in rad/s.
    spin: f64,
    /// Of the true contact point from the impulse's line, in m.
    line: f64,
}

/// Without spins nothing is approximated: what is left is where the optimiser stops.
const EXACT: Tolerance = Tolerance { ratio: 1e-8, velocity: 1e-8, spin: 0.0, line: 1e-9 };

/// Euler's steps of a quarter frame turn by 0.03 rad at most for the spins here (8 rad/s at 60
/// frames per second), and the spin found for them is off by about that share of itself squared:
/// 1 %. Little of it reaches the rest.
const EULER: Tolerance = Tolerance { ratio: 5e-3, velocity: 1e-3, spin: 0.08, line: 3e-3 };

fn solved(file: &SceneFile) -> Reconstruction {
    reconstruct(&scene(file), &Options::paper_by_cost()).unwrap()
}

fn scene(file: &SceneFile) -> Scene {
    Scene::from_file(file.clone()).unwrap()
}

fn simulated(spec: &SimulationSpec) -> (SceneFile, Truth) {
    let simulation = simulate(spec).unwrap();
    (simulation.scene_file, simulation.truth)
}

/// Seen as in the paper's section 5.1: every ninth of 90 frames, with a gap of 18.
fn every_ninth_frame(mut spec: SimulationSpec) -> SimulationSpec {
    spec.collision.time = 0.75;
    spec.observations =
        Sampling::Regular(RegularSampling { interval: 9, frame_count: 90, gap: None });
    spec
}

/// Three poses on each side: five segments, which is fast.
fn six_poses(mut spec: SimulationSpec) -> SimulationSpec {
    spec.collision.time = 40.0 / spec.fps.unwrap();
    spec.observations = Sampling::Frames(vec![26.0, 31.0, 36.0, 44.0, 49.0, 54.0]);
    spec
}

fn six_of_cuboids(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_cuboids(seed)))
}

fn six_of_balls(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_balls(seed)))
}

fn six_of_a_drop(seed: u64) -> (SceneFile, Truth) {
    simulated(&six_poses(SimulationSpec::random_box_drop(seed)))
}

fn mass_ratio(result: &Reconstruction) -> f64 {
    result.mass_ratio.as_ref().unwrap().value.unwrap()
}

fn restitution(result: &Reconstruction) -> f64 {
    result.restitution.value.unwrap()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (Vector3::from(a) - Vector3::from(b)).norm()
}

/// The result is the truth, in every number that the poses determine.
fn assert_recovers(result: &Reconstruction, truth: &Truth, tolerance: &Tolerance) {
    let name = &truth.scene;
    assert_eq!(result.flags, [], "{name}");
    let time = result.collision_time.value.unwrap();
    assert!((time - truth.collision_time).abs() < 1e-12, "{name}: {time}");
    let found = result.mass_ratio.as_ref().map(|m| m.value.unwrap());
    assert_eq!(found.is_some(), truth.mass_ratio.is_some(), "{name}");
    if let (Some(found), Some(mass_ratio)) = (found, truth.mass_ratio) {
        let error = (found / mass_ratio - 1.0).abs();
        assert!(error < tolerance.ratio, "{name}: mass ratio off by {error:e}");
    }
    let error = (restitution(result) - truth.restitution).abs();
    assert!(error < tolerance.ratio, "{name}: restitution off by {error:e}");
    let error = distance(result.impulse, truth.impulse);
    assert!(error < 4.0 * tolerance.velocity, "{name}: impulse off by {error:e}");
    let lever = Vector3::from(result.contact_point.unwrap()) - Vector3::from(truth.contact_point);
    let error = lever.cross(&Vector3::from(truth.normal)).norm();
    assert!(error < tolerance.line, "{name}: contact off its line by {error:e} m");
    for (found, truth) in result.bodies.iter().zip(&truth.bodies) {
        assert_eq!(found.name, truth.name);
        for (found, truth) in [
            (found.velocity_before, truth.velocity_before),
            (found.velocity_after, truth.velocity_after),
        ] {
            let error = distance(found, truth);
            assert!(error < tolerance.velocity, "{name}: velocity off by {error:e} m/s");
        }
        for (found, truth) in [
            (found.angular_velocity_before, truth.angular_velocity_before),
            (found.angular_velocity_after, truth.angular_velocity_after),
        ] {
            let error = found.map_or(0.0, |found| distance(found, truth));
            assert!(error <= tolerance.spin, "{name}: spin off by {error:e} rad/s");
        }
    }
}

/// Seeds whose bodies turn at less than 8 rad/s: faster ones turn by more than half a turn within
/// the gap, and the paper's start takes them the short way round.
#[test]
fn two_cuboids_are_recovered() {
    for seed in [0, 2, 5, 6, 8] {
        let spec = every_ninth_frame(SimulationSpec::random_cuboids(seed));
        let (file, truth) = simulated(&spec);
        assert_recovers(&solved(&file), &truth, &EULER);
    }
}

#[test]
fn a_box_that_falls_on_a_floor_is_recovered() {
    for seed in [0, 1, 3] {
        let (file, truth) = six_of_a_drop(seed);
        assert_recovers(&solved(&file), &truth, &EULER);
    }
}

#[test]
fn balls_without_orientation_are_recovered() {
    for seed in 0..10 {
        let (file, truth) = six_of_balls(seed);
        assert_recovers(&solved(&file), &truth, &EXACT);
        let (file, truth) = simulated(&six_poses(SimulationSpec::random_ball_drop(seed)));
        assert_recovers(&solved(&file), &truth, &EXACT);
    }
}

/// Each body is seen when it is seen: uneven steps, other times, other numbers of poses.
#[test]
fn uneven_times_are_no_obstacle() {
    let a_times = [0.31, 0.42, 0.47, 0.66, 0.84, 0.88, 1.02];
    let b_times = [0.4, 0.59, 0.7, 0.8, 0.97];
    for (make, seed, tolerance) in [
        (SimulationSpec::random_balls as fn(u64) -> SimulationSpec, 3, &EXACT),
        (SimulationSpec::random_cuboids, 2, &EULER),
    ] {
        let mut spec = make(seed);
        spec.fps = None;
        // Between 0.7 and 0.8, the last and the first of all times on their sides.
        spec.collision.time = 0.75;
        spec.observations = Sampling::Times(a_times.into());
        spec.bodies[1].observations = Some(Sampling::Times(b_times.into()));
        let (file, truth) = simulated(&spec);
        assert_recovers(&solved(&file), &truth, tolerance);
    }
}

/// Frame n is at n / fps: to the last bit the same scene.
#[test]
fn frames_and_times_give_the_same_numbers() {
    for (file, _) in [six_of_cuboids(0), six_of_a_drop(0)] {
        let mut in_times = file.clone();
        let fps = file.fps.unwrap();
        for seen in observations(&mut in_times) {
            seen.time = seen.frame.take().map(|frame| frame / fps);
        }
        assert_eq!(text_without_seconds(&solved(&file)), text_without_seconds(&solved(&in_times)));
    }
}

fn observations(file: &mut SceneFile) -> impl Iterator<Item = &mut ObservationFile> {
    file.bodies.iter_mut().flat_map(|body| body.observations.iter_mut().flatten())
}

/// All of a result but the one thing that differs from run to run; numbers with all their digits.
fn text_without_seconds(result: &Reconstruction) -> String {
    let mut result = result.clone();
    for phase in &mut result.phases {
        phase.seconds = None;
    }
    result.to_json()
}

/// The scene seen from elsewhere: turned, then shifted.
fn seen_from_elsewhere(
    file: &SceneFile,
    turn: &UnitQuaternion<f64>,
    shift: &Vector3<f64>,
) -> SceneFile {
    let mut file = file.clone();
    let turned = |v: [f64; 3]| Vector3::from(turned(turn, v)).into();
    file.up = turned(file.up);
    for body in &mut file.bodies {
        if let (Some(normal), Some(height)) = (&mut body.normal, &mut body.height) {
            *normal = turned(*normal);
            *height += Vector3::from(*normal).dot(shift);
        }
    }
    for seen in observations(&mut file) {
        seen.position = (Vector3::from(turned(seen.position)) + shift).into();
        seen.orientation = seen.orientation.map(|[w, x, y, z]| {
            let q = turn * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            [q.w, q.i, q.j, q.k]
        });
    }
    file
}

fn turned(turn: &UnitQuaternion<f64>, v: [f64; 3]) -> [f64; 3] {
    (turn * Vector3::from(v)).into()
}

/// `elsewhere` says of the turned scene what `here` says of the scene.
fn assert_turned(
    here: &Reconstruction,
    elsewhere: &Reconstruction,
    turn: &UnitQuaternion<f64>,
    tolerance: f64,
) {
    let name = &here.scene;
    if here.mass_ratio.is_some() {
        let change = mass_ratio(elsewhere) / mass_ratio(here) - 1.0;
        assert!(change.abs() < tolerance, "{name}: mass ratio by {change:e}");
    }
    let change = restitution(elsewhere) - restitution(here);
    assert!(change.abs() < tolerance, "{name}: restitution by {change:e}");
    let mut pairs = vec![(here.impulse, elsewhere.impulse)];
    for (here, elsewhere) in here.bodies.iter().zip(&elsewhere.bodies) {
        pairs.push((here.velocity_before, elsewhere.velocity_before));
        pairs.push((here.velocity_after, elsewhere.velocity_after));
        let spins = |body: &smash::reconstruct::BodyResult| {
            [body.angular_velocity_before, body.angular_velocity_after]
        };
        let spin_pairs = spins(here).into_iter().zip(spins(elsewhere));
        pairs.extend(spin_pairs.filter_map(|(here, elsewhere)| Some((here?, elsewhere?))));
    }
    for (here, elsewhere) in pairs {
        let change = distance(turned(turn, here), elsewhere);
        let allowed = tolerance * (1.0 + Vector3::from(here).norm());
        assert!(change < allowed, "{name}: {here:?} became {elsewhere:?}, off by {change:e}");
    }
}

/// No direction is special, not even up: y, z, −y, or oblique. The optimiser ends at a relative
/// change of the cost of 1e-9: 3e-5 of the unknowns, by its square root.
#[test]
fn a_turned_scene_has_the_turned_result() {
    use std::f64::consts::{FRAC_PI_2, PI};
    let y_to_z = Vector3::x() * FRAC_PI_2;
    let upside_down = Vector3::z() * PI;
    let turns = [y_to_z, upside_down, Vector3::new(1.3, -0.4, 0.7)];
    for (file, _) in [six_of_cuboids(0), six_of_a_drop(0), six_of_balls(0)] {
        let here = solved(&file);
        for turn in turns.map(UnitQuaternion::from_scaled_axis) {
            let elsewhere = solved(&seen_from_elsewhere(&file, &turn, &Vector3::zeros()));
            assert_turned(&here, &elsewhere, &turn, 1e-4);
        }
    }
}

/// No place is special. Only eq. 12 counts from the origin: with spins it shares out the error of
/// Euler's steps in another way, so that two cuboids may change by as much as that error.
#[test]
fn a_shifted_scene_has_the_shifted_result() {
    let shift = Vector3::new(5.0, -3.0, 2.0);
    for ((file, _), tolerance) in
        [(six_of_cuboids(0), EULER.ratio), (six_of_a_drop(0), 1e-4), (six_of_balls(0), 1e-7)]
    {
        let here = solved(&file);
        let no_turn = UnitQuaternion::identity();
        let elsewhere = solved(&seen_from_elsewhere(&file, &no_turn, &shift));
        assert_turned(&here, &elsewhere, &no_turn, tolerance);
        for (here, elsewhere) in here.bodies.iter().zip(&elsewhere.bodies) {
            let moved = Vector3::from(here.position) + shift;
            assert!(distance(elsewhere.position, moved.into()) < 1e-4, "{}", here.name);
        }
    }
}

/// Which body is called a is a matter of taste: m becomes 1/m, and J is −J per mass of the other.
#[test]
fn swapped_bodies_have_the_inverse_mass_ratio() {
    for ((file, truth), tolerance) in
        [(six_of_cuboids(0), EULER.ratio), (six_of_balls(4), EXACT.ratio)]
    {
        let mut swapped = file.clone();
        swapped.bodies.swap(0, 1);
        let (result, mass) = (solved(&swapped), truth.mass_ratio.unwrap());
        assert_eq!(result.bodies[0].name, "b");
        let error = mass_ratio(&result) * mass - 1.0;
        assert!(error.abs() < tolerance, "{error:e}");
        let error = restitution(&result) - truth.restitution;
        assert!(error.abs() < tolerance, "{error:e}");
        let impulse = -Vector3::from(truth.impulse) / mass;
        assert!(distance(result.impulse, impulse.into()) < tolerance);
    }
}

/// Run backwards, a bounce gains what it lost: the restitution is 1/c, and that is flagged.
#[test]
fn a_film_run_backwards_gains_energy() {
    let (mut file, truth) = six_of_balls(5);
    for seen in observations(&mut file) {
        seen.frame = seen.frame.map(|frame| -frame);
    }
    let result = solved(&file);
    assert!((restitution(&result) * truth.restitution - 1.0).abs() < 1e-6);
    assert_eq!(result.flags, [Flag::RestitutionOutOfRange]);
}

/// The paper allows up to 10.
#[test]
fn a_mass_ratio_of_thirty_ends_at_the_bound() {
    let mut spec = six_poses(SimulationSpec::random_balls(6));
    spec.mass_ratio = Some(30.0);
    let (mut file, _) = simulated(&spec);
    let result = solved(&file);
    assert!(mass_ratio(&result) > 9.999 && mass_ratio(&result) <= 10.0);
    assert!(result.flags.contains(&Flag::MassRatioAtBound));
    // The other way round it is 1/30, which is allowed.
    file.bodies.swap(0, 1);
    let result = solved(&file);
    assert!((30.0 * mass_ratio(&result) - 1.0).abs() < EXACT.ratio);
    assert_eq!(result.flags, []);
}

/// Of balls, whose flight the model holds exactly, noise alone is left over: χ² is as large as its
/// degrees of freedom, ± √(2 dof). A hundred scenes leave ± 1 % of it, and four of those are allowed.
#[test]
fn what_is_left_over_is_the_noise() {
    let sigma = Noise { position: 0.002, orientation: 0.01 };
    let (mut chi2, mut dof) = (0.0, 0);
    for seed in 0..100 {
        let mut spec = every_ninth_frame(SimulationSpec::random_balls(seed));
        spec.noise = NoiseSpec::Gaussian(sigma);
        spec.seed = seed;
        let mut file = simulated(&spec).0;
        let fit = solved(&file).fit;
        let count = 3.0 * observations(&mut file).count() as f64;
        let residual = fit.chi2.unwrap() * sigma.position.powi(2);
        let rmse = (residual / count).sqrt();
        assert!((fit.position_rmse - rmse).abs() < 1e-12);
        assert_eq!(fit.orientation_rmse, None);
        chi2 += fit.chi2.unwrap();
        dof += fit.dof;
    }
    let reduced = chi2 / dof as f64;
    let sigma = (2.0 / dof as f64).sqrt();
    assert!((reduced - 1.0).abs() < 4.0 * sigma, "{reduced} ± {sigma}");
}

/// One body in the air, pushed by something unseen: its velocities stand, the rest says why not.
#[test]
fn a_lone_body_tells_its_own_motion() {
    let (mut file, truth) = six_of_cuboids(2);
    file.bodies.truncate(1);
    let result = solved(&file);
    let found = result.bodies[0].velocity_after;
    assert!(distance(found, truth.bodies[0].velocity_after) < EULER.velocity);
    assert_eq!(result.mass_ratio, None);
    assert_eq!(result.restitution.value, None);
    assert!(result.restitution.reason.unwrap().contains("not known"));
    let by_distance = Options::paper();
    let message = reconstruct(&scene(&file), &by_distance).unwrap_err().to_string();
    assert!(message.contains("--segment-by cost"), "{message}");
}

/// Whatever isn't known is null with a reason beside it; only a static partner's mass ratio is null
/// by nature.
#[test]
fn every_result_fits_its_schema_and_explains_its_nulls() {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Result)).unwrap();
    let schema = jsonschema::validator_for(&schema).unwrap();
    let lone = |(mut file, _): (SceneFile, Truth)| {
        file.bodies.truncate(1);
        file
    };
    let mut noisy = six_poses(SimulationSpec::random_balls(2));
    noisy.noise = NoiseSpec::Gaussian(Noise { position: 0.002, orientation: 0.01 });
    for file in [
        six_of_cuboids(2).0,
        six_of_a_drop(0).0,
        six_of_balls(0).0,
        simulated(&noisy).0,
        lone(six_of_cuboids(2)),
        lone(six_of_balls(1)),
    ] {
        let result = solved(&file);
        let written: Value = serde_json::from_str(&result.to_json()).unwrap();
        assert_eq!(schema.validate(&written).map_err(|e| e.to_string()), Ok(()));
        let read: Reconstruction = serde_json::from_value(written.clone()).unwrap();
        assert_eq!(read, result);
        assert_eq!(
            written["mass_ratio"].is_null(),
            file.bodies.len() < 2 || written["bodies"][1].is_null()
        );
        assert_explained(&written, &result.scene);
        for field in FIELDS {
            assert!(written.get(field).is_some(), "no {field}");
        }
    }
}

/// The contract's.
const FIELDS: [&str; 14] = [
    "schema",
    "scene",
    "preset",
    "mass_ratio",
    "restitution",
    "collision_time",
    "contact_point",
    "impulse",
    "normal",
    "bodies",
    "effects",
    "fit",
    "phases",
    "flags",
];

fn assert_explained(value: &Value, place: &str) {
    match value {
        Value::Array(values) => values.iter().for_each(|v| assert_explained(v, place)),
        Value::Object(fields) => {
            for (name, value) in fields {
                let place = format!("{place}.{name}");
                let is_explained = name == "mass_ratio" || fields.contains_key("reason");
                assert!(!value.is_null() || is_explained, "{place} is null");
                assert_explained(value, &place);
            }
        }
        _ => {}
    }
}

/// What isn't measured is named in the reason, whatever else is known.
#[test]
fn unmeasured_orientations_are_the_reason_of_their_nulls() {
    let (mut file, _) = six_of_balls(0);
    file.noise = Some(Noise { position: 0.001, orientation: 0.01 });
    let result = solved(&file);
    assert!(result.fit.reduced_chi2.is_some());
    assert!(result.fit.reason.unwrap().contains("orientation"));
    let body = &result.bodies[0];
    assert_eq!((body.orientation, body.angular_velocity_before), (None, None));
    assert!(body.reason.as_ref().unwrap().contains("orientations"));
}

/// One after another, all at once from many threads, or on a single one: the same to the last bit.
#[test]
fn threads_change_no_bit() {
    let files: Vec<SceneFile> = (0..4)
        .flat_map(|seed| [six_of_cuboids(seed).0, six_of_a_drop(seed).0, six_of_balls(seed).0])
        .collect();
    let texts = || -> Vec<String> {
        files.iter().map(|file| text_without_seconds(&solved(file))).collect()
    };
    let one_after_another = texts();
    std::thread::scope(|threads| {
        let at_once: Vec<_> = (0..6).map(|_| threads.spawn(texts)).collect();
        for thread in at_once {
            assert_eq!(thread.join().unwrap(), one_after_another);
        }
    });
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(single.install(texts), one_after_another);
}

/// Nine times make eight segments, six of them with two poses on each side; each of these is told
/// once, then the two phases in their order.
#[test]
fn progress_tells_each_step_once() {
    let (file, _) = simulated(&every_ninth_frame(SimulationSpec::random_balls(8)));
    let told = Mutex::new(Vec::new());
    let result =
        reconstruct_with_progress(&scene(&file), &Options::paper_by_cost(), &|step: Progress| {
            told.lock().unwrap().push(step);
        })
        .unwrap();
    let mut told = told.into_inner().unwrap();
    let phases = told.split_off(6);
    let mut numbers: Vec<_> = told
        .iter()
        .map(|step| match step.stage {
            Stage::Segment { number, of: 6 } => number,
            other => panic!("{other:?} among the segments"),
        })
        .collect();
    numbers.sort_unstable();
    assert_eq!(numbers, [1, 2, 3, 4, 5, 6]);
    let least = told.iter().map(|step| step.cost).fold(f64::INFINITY, f64::min);
    assert_eq!(least, result.phases[0].cost_final);
    let ends = [(Stage::Impulse, 1), (Stage::ContactPoint, 2)];
    let expected =
        ends.map(|(stage, phase)| Progress { stage, cost: result.phases[phase].cost_final });
    assert_eq!(phases, expected);
}
