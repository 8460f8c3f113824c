//! The same collision told in other words has the same answer.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use smash::reconstruct::BodyResult;
use smash::scene::{SceneFile, Shape};
use smash::simulate::{NoiseSpec, SimulationSpec, add_noise};
use smash::{Options, Reconstruction, Scene, reconstruct};

use super::{NOISE, every, mass_ratio, poses, solve};

/// In standard deviations. The optimiser stops when χ² falls by less than 1e-8 of itself: with some
/// hundred numbers that is 1e-3 of a deviation at the worst.
const TOLERANCE: f64 = 1e-3;

/// Numbers that every result has, in the order of the uncertainty's quantities, without
/// orientations.
fn numbers(result: &Reconstruction) -> Vec<(String, f64)> {
    let mut numbers = vec![
        ("restitution".to_string(), result.restitution.value.unwrap()),
        ("collision_time".to_string(), result.collision_time.value.unwrap()),
    ];
    numbers.extend(result.mass_ratio.iter().map(|m| ("mass_ratio".to_string(), m.value.unwrap())));
    let mut push = |name: String, v: Option<[f64; 3]>| {
        let Some(v) = v else { return };
        numbers
            .extend(["x", "y", "z"].iter().zip(v).map(|(axis, x)| (format!("{name}.{axis}"), x)));
    };
    push("contact_point".into(), result.contact_point);
    push("impulse".into(), Some(result.impulse));
    push("normal".into(), result.normal);
    for body in &result.bodies {
        push(format!("{}.position", body.name), Some(body.position));
        push(format!("{}.velocity_before", body.name), Some(body.velocity_before));
        push(format!("{}.velocity_after", body.name), Some(body.velocity_after));
        push(format!("{}.angular_velocity_before", body.name), body.angular_velocity_before);
        push(format!("{}.angular_velocity_after", body.name), body.angular_velocity_after);
        push(format!("{}.angular_momentum_before", body.name), body.angular_momentum_before);
        push(format!("{}.angular_momentum_after", body.name), body.angular_momentum_after);
    }
    numbers
}

fn std(result: &Reconstruction, name: &str) -> Option<f64> {
    let table = result.uncertainty.as_ref().unwrap();
    table.std[table.quantities.iter().position(|quantity| quantity == name).unwrap()]
}

/// The same numbers within a thousandth of their deviation, and the same deviations of what has
/// no direction.
fn assert_same(what: &str, found: &Reconstruction, expected: &Reconstruction) {
    let scene = &expected.scene;
    assert_eq!(found.flags, expected.flags, "{scene}, {what}");
    let (found_numbers, expected_numbers) = (numbers(found), numbers(expected));
    assert_eq!(found_numbers.len(), expected_numbers.len(), "{scene}, {what}");
    for (name, value) in expected_numbers {
        let other = found_numbers.iter().find(|(other, _)| *other == name).unwrap().1;
        // What can't vary, as a plane's normal, is the same to rounding.
        let deviation = std(expected, &name).unwrap_or(1e-9).max(1e-9);
        let error = (value - other).abs() / deviation;
        assert!(error < TOLERANCE, "{scene}, {what}: {name} differs by {error:e} deviations");
    }
    for name in ["restitution", "collision_time"] {
        let [a, b] = [found, expected].map(|result| std(result, name).unwrap());
        assert!((a / b - 1.0).abs() < TOLERANCE, "{scene}, {what}: std of {name} {a} {b}");
    }
}

/// Exact and noisy scenes, of each kind.
fn scenes() -> Vec<SceneFile> {
    let noise = NoiseSpec::Gaussian(NOISE);
    let exact = [
        every(9, SimulationSpec::random_cuboids(2)).0,
        every(9, SimulationSpec::random_balls(1)).0,
        every(9, SimulationSpec::random_box_drop(1)).0,
    ];
    let noisy = exact.clone().map(|file| add_noise(file, &noise, 5));
    let exact = exact.map(super::with_noise_stated);
    exact.into_iter().chain(noisy).collect()
}

fn assert_invariant(
    what: &str,
    told: impl Fn(&mut SceneFile),
    untold: impl Fn(&mut Reconstruction),
) {
    for file in scenes() {
        let mut other = file.clone();
        told(&mut other);
        let mut result = solve(&other);
        untold(&mut result);
        assert_same(what, &result, &solve(&file));
    }
}

fn vectors(result: &mut Reconstruction) -> impl Iterator<Item = &mut [f64; 3]> {
    let bodies = result.bodies.iter_mut().flat_map(|body| {
        let BodyResult {
            velocity_before,
            velocity_after,
            angular_velocity_before,
            angular_velocity_after,
            angular_momentum_before,
            angular_momentum_after,
            ..
        } = body;
        [
            Some(velocity_before),
            Some(velocity_after),
            angular_velocity_before.as_mut(),
            angular_velocity_after.as_mut(),
            angular_momentum_before.as_mut(),
            angular_momentum_after.as_mut(),
        ]
    });
    [Some(&mut result.impulse), result.normal.as_mut()].into_iter().chain(bodies).flatten()
}

fn points(result: &mut Reconstruction) -> impl Iterator<Item = &mut [f64; 3]> {
    result.contact_point.iter_mut().chain(result.bodies.iter_mut().map(|body| &mut body.position))
}

fn turn(by: &UnitQuaternion<f64>, v: &mut [f64; 3]) {
    *v = (by * Vector3::from(*v)).into();
}

/// The deviations of a turned vector's components aren't those of the vector: its square has none,
/// so each component is compared by its own.
#[test]
fn the_frame_of_the_world_does_not_matter() {
    let by = UnitQuaternion::from_euler_angles(0.7, -0.4, 2.1);
    assert_invariant(
        "turned",
        |file| {
            turn(&by, &mut file.up);
            file.bodies.iter_mut().filter_map(|b| b.normal.as_mut()).for_each(|n| turn(&by, n));
            for pose in poses(file) {
                turn(&by, &mut pose.position);
                if let Some([w, x, y, z]) = pose.orientation {
                    let q = by * UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
                    pose.orientation = Some([q.w, q.i, q.j, q.k]);
                }
            }
        },
        |result| {
            vectors(result).for_each(|v| turn(&by.inverse(), v));
            points(result).for_each(|p| turn(&by.inverse(), p));
        },
    );
}

#[test]
fn the_origin_does_not_matter() {
    let by = Vector3::new(12.0, -7.0, 30.0);
    assert_invariant(
        "moved",
        |file| {
            for pose in poses(file) {
                pose.position = (Vector3::from(pose.position) + by).into();
            }
            for body in &mut file.bodies {
                let Some(normal) = body.normal else { continue };
                body.height = body.height.map(|height| height + Vector3::from(normal).dot(&by));
            }
        },
        |result| points(result).for_each(|p| *p = (Vector3::from(*p) - by).into()),
    );
}

#[test]
fn the_zero_of_time_does_not_matter() {
    const LATER_S: f64 = 100.0;
    assert_invariant(
        "later",
        |file| {
            let frames = LATER_S * file.fps.unwrap();
            poses(file).for_each(|pose| pose.frame = pose.frame.map(|frame| frame + frames));
        },
        |result| result.collision_time.value = result.collision_time.value.map(|t| t - LATER_S),
    );
}

/// Everything ten times as long and gravity ten times as strong, as in decimetres: velocities are
/// ten times as large, ratios the same.
#[test]
fn the_unit_of_length_does_not_matter() {
    const FACTOR: f64 = 10.0;
    assert_invariant(
        "larger",
        |file| {
            file.gravity *= FACTOR;
            file.noise.as_mut().unwrap().position *= FACTOR;
            poses(file).flat_map(|pose| &mut pose.position).for_each(|x| *x *= FACTOR);
            for body in &mut file.bodies {
                body.height = body.height.map(|height| height * FACTOR);
                match &mut body.shape {
                    Some(Shape::Box { size }) => size.iter_mut().for_each(|x| *x *= FACTOR),
                    Some(Shape::Sphere { radius }) => *radius *= FACTOR,
                    None => {}
                }
            }
        },
        |result| {
            let lengths = |v: &mut [f64; 3]| v.iter_mut().for_each(|x| *x /= FACTOR);
            points(result).for_each(lengths);
            lengths(&mut result.impulse);
            for body in &mut result.bodies {
                lengths(&mut body.velocity_before);
                lengths(&mut body.velocity_after);
                for k in [&mut body.angular_momentum_before, &mut body.angular_momentum_after] {
                    // kg·m²/s.
                    k.iter_mut().flatten().for_each(|x| *x /= FACTOR * FACTOR);
                }
            }
        },
    );
}

/// With the bodies named in the other order the other one has mass 1.
#[test]
fn the_order_of_bodies_does_not_matter() {
    let two_bodies = |file: &SceneFile| file.bodies.iter().all(|body| body.shape.is_some());
    for file in scenes().iter().filter(|file| two_bodies(file)) {
        let mut swapped = file.clone();
        swapped.bodies.swap(0, 1);
        let mut result = solve(&swapped);
        let of_a = mass_ratio(&result);
        result.bodies.swap(0, 1);
        result.impulse = (-Vector3::from(result.impulse) / of_a).into();
        result.normal = result.normal.map(|normal| (-Vector3::from(normal)).into());
        for body in &mut result.bodies {
            for k in [&mut body.angular_momentum_before, &mut body.angular_momentum_after] {
                k.iter_mut().flatten().for_each(|x| *x /= of_a);
            }
        }
        let mass = result.mass_ratio.as_mut().unwrap();
        mass.value = Some(1.0 / of_a);
        let expected = solve(file);
        assert_same("swapped", &result, &expected);
        // A ratio's interval is symmetric about its logarithm, so it turns over too.
        let [low, high] = result.mass_ratio.unwrap().interval_95.unwrap();
        let [a, b] = expected.mass_ratio.unwrap().interval_95.unwrap();
        assert!((low * b - 1.0).abs() < TOLERANCE && (high * a - 1.0).abs() < TOLERANCE);
    }
}

/// The same bits on any number of threads, from any thread, and again.
#[test]
fn threads_and_repetition_do_not_matter() {
    let told = |scene: &Scene| {
        let mut result = reconstruct(scene, &Options::default()).unwrap();
        result.phases.iter_mut().for_each(|phase| phase.seconds = None);
        result.to_json()
    };
    for file in scenes() {
        let scene = Scene::from_file(file).unwrap();
        let expected = told(&scene);
        for threads in [1, 2, 4] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            assert_eq!(pool.install(|| told(&scene)), expected, "{threads} threads");
        }
        std::thread::scope(|scope| {
            let all = [(); 4].map(|()| scope.spawn(|| told(&scene)));
            for one in all {
                assert_eq!(one.join().unwrap(), expected, "beside others");
            }
        });
    }
}
