//! Poses that no camera saw: an answer or an error with words, never an end of the process, never
//! without end, and no number that isn't finite.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use smash::scene::{ObservationFile, SceneFile};
use smash::simulate::{SimulationSpec, Truth};
use smash::{Options, Scene, reconstruct};

use super::{every, poses, with_noise_stated};

/// What a scene that isn't hostile is known to have been made with.
struct Honest {
    file: SceneFile,
    truth: Truth,
}

/// Two cuboids, and a cuboid on a floor.
fn scenes() -> [Honest; 2] {
    [SimulationSpec::random_cuboids(2), SimulationSpec::random_box_drop(1)].map(|spec| {
        let (file, truth) = every(9, spec);
        Honest { file, truth }
    })
}

/// An error in words, a flag, or the truth; never a number that isn't one.
fn assert_honest(what: &str, file: &SceneFile, truth: &Truth) {
    for file in [file.clone(), with_noise_stated(file.clone())] {
        let answer =
            Scene::from_file(file).and_then(|scene| reconstruct(&scene, &Options::default()));
        let result = match answer {
            Ok(result) => result,
            Err(error) => {
                assert!(error.to_string().contains(' '), "{what}: {error}");
                continue;
            }
        };
        let text = format!("{result:?}");
        let mut words = text.split(|letter: char| !letter.is_alphanumeric());
        assert!(!words.any(|word| word == "NaN" || word == "inf"), "{what}: {text}");
        if !result.flags.is_empty() {
            continue;
        }
        // A thousandth: no scene here is told more precisely than that.
        let mass_ratio = result.mass_ratio.as_ref().and_then(|m| m.value);
        for (found, truth) in
            [(mass_ratio, truth.mass_ratio), (result.restitution.value, Some(truth.restitution))]
        {
            let (Some(found), Some(truth)) = (found, truth) else { continue };
            assert!((found - truth).abs() < 1e-3, "{what}: {found}, not {truth}, without a flag");
        }
    }
}

fn assert_honest_when(what: &str, edit: impl Fn(&mut SceneFile)) {
    for Honest { mut file, truth } in scenes() {
        edit(&mut file);
        assert_honest(what, &file, &truth);
    }
}

fn random_orientation(random: &mut ChaCha8Rng) -> [f64; 4] {
    let q =
        Quaternion::from_vector(nalgebra::Vector4::from_fn(|_, _| random.random_range(-1.0..1.0)));
    let q = UnitQuaternion::from_quaternion(q);
    [q.w, q.i, q.j, q.k]
}

#[test]
fn poses_a_thousand_kilometres_away() {
    assert_honest_when("all", |file| poses(file).for_each(|p| p.position[0] += 9e5));
    assert_honest_when("one", |file| poses(file).last().unwrap().position = [1e6, -1e6, 1e6]);
}

#[test]
fn orientations_at_random() {
    for seed in 0..2 {
        assert_honest_when("random orientations", |file| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            poses(file).for_each(|p| p.orientation = Some(random_orientation(&mut random)));
        });
    }
}

#[test]
fn positions_at_random() {
    assert_honest_when("random positions", |file| {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for pose in poses(file) {
            pose.position = std::array::from_fn(|_| random.random_range(-1.0..1.0));
        }
    });
}

#[test]
fn all_poses_equal() {
    assert_honest_when("all equal", |file| {
        for pose in poses(file) {
            pose.position = [0.1, 0.2, 0.3];
            pose.orientation = Some([1.0, 0.0, 0.0, 0.0]);
        }
    });
}

#[test]
fn as_few_poses_as_a_scene_may_have() {
    assert_honest_when("two a side", |file| {
        for body in &mut file.bodies {
            let Some(seen) = &mut body.observations else { continue };
            let middle = seen.len() / 2;
            *seen = seen[middle - 2..middle + 2].to_vec();
        }
    });
}

#[test]
fn one_orientation_only() {
    let keep_first = |seen: &mut Vec<ObservationFile>, count: usize| {
        seen.iter_mut().skip(count).for_each(|pose| pose.orientation = None);
    };
    for count in [1, 2] {
        assert_honest_when("few orientations", |file| {
            file.bodies[0].observations.as_mut().into_iter().for_each(|s| keep_first(s, count));
        });
    }
}

#[test]
fn flights_without_weight() {
    assert_honest_when("no gravity", |file| file.gravity = 0.0);
    assert_honest_when("as on a neutron star", |file| file.gravity = 1e5);
}

/// A day of frames a second, or a microsecond.
#[test]
fn times_very_long_or_short() {
    let last = |file: &mut SceneFile| poses(file).filter_map(|p| p.frame).fold(1.0, f64::max);
    for span_s in [1e-5, 1e2, 8e4] {
        assert_honest_when("another frame rate", |file| file.fps = Some(last(file) / span_s));
    }
    assert_honest_when("a late pose", |file| {
        let fps = file.fps.unwrap();
        poses(file).last().unwrap().frame = Some(8e4 * fps);
    });
}

#[test]
fn bodies_very_thin_or_large() {
    use smash::scene::Shape;
    for size in [[1e-6, 1e-6, 1e4], [1e-6; 3], [1e4; 3]] {
        assert_honest_when("another size", |file| {
            file.bodies[0].shape = Some(Shape::Box { size });
        });
    }
}

/// `steps` poses from each to the next, as a flight goes in position, and evenly in orientation;
/// none across the collision at `collision_s`.
fn filled(mut file: SceneFile, steps: u32, collision_s: f64) -> SceneFile {
    let (fps, gravity) = (file.fps.unwrap(), file.gravity);
    for body in &mut file.bodies {
        let seen = body.observations.take().unwrap();
        let flights = seen.windows(2).filter(|pair| {
            let [t, u] = [pair[0], pair[1]].map(|pose| pose.frame.unwrap() / fps - collision_s);
            t * u > 0.0
        });
        let between = flights.flat_map(|pair| (0..steps).map(move |step| (pair, step)));
        let filled = between.map(|(pair, step)| {
            let share = f64::from(step) / f64::from(steps);
            let [from, to] = [pair[0].frame.unwrap(), pair[1].frame.unwrap()];
            let [p, q] = [pair[0], pair[1]].map(|pose| Vector3::from(pose.position));
            let duration_s = (to - from) / fps;
            let sag = 0.5 * gravity * share * (1.0 - share) * duration_s.powi(2);
            let [r, s] = [pair[0], pair[1]].map(|pose| {
                let [w, x, y, z] = pose.orientation.unwrap();
                UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z))
            });
            let turned = r.slerp(&s, share);
            ObservationFile {
                frame: Some(from + share * (to - from)),
                time: None,
                position: (p.lerp(&q, share) + Vector3::y() * sag).into(),
                orientation: Some([turned.w, turned.i, turned.j, turned.k]),
                noise_scale: None,
            }
        });
        body.observations = Some(filled.collect());
    }
    file
}

#[test]
fn two_thousand_poses() {
    let (file, truth) = every(3, SimulationSpec::random_cuboids(2));
    let dense = filled(file, 77, truth.collision_time);
    assert!(dense.bodies[0].observations.as_ref().unwrap().len() > 1900);
    assert_honest("two thousand poses", &dense, &truth);
}

#[test]
fn many_orientations_at_random() {
    let (file, truth) = every(3, SimulationSpec::random_cuboids(2));
    let mut dense = filled(file, 3, truth.collision_time);
    let mut random = ChaCha8Rng::seed_from_u64(1);
    poses(&mut dense).for_each(|p| p.orientation = Some(random_orientation(&mut random)));
    assert_honest("many at random", &dense, &truth);
}
