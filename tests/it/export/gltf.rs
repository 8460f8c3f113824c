//! The film in 3D, read back by another program's reader.

use gltf::animation::util::ReadOutputs;
use gltf::{Gltf, Node};
use smash::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use smash::scene::Shape;
use smash::{Reconstruction, export};

use super::{Row, SCENES, result, rows, scene};

/// Single precision of coordinates of some metres.
const ROUNDING_M: f64 = 1e-6;

fn read(result: &Reconstruction, fps: Option<f64>) -> Gltf {
    Gltf::from_slice(&export::gltf(result, fps).unwrap()).unwrap()
}

fn vector(v: [f32; 3]) -> Vector3<f64> {
    Vector3::from(v).cast()
}

fn quaternion([x, y, z, w]: [f32; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z).cast())
}

fn node<'a>(film: &'a Gltf, name: &str) -> Node<'a> {
    film.nodes().find(|node| node.name() == Some(name)).unwrap()
}

/// A body's keys: times, positions; times, turns.
struct Keys {
    moves: Vec<(f64, Vector3<f64>)>,
    turns: Vec<(f64, UnitQuaternion<f64>)>,
}

fn keys(film: &Gltf, body: &str) -> Keys {
    let mut keys = Keys { moves: vec![], turns: vec![] };
    let animation = film.animations().next().unwrap();
    for channel in animation.channels() {
        if channel.target().node().name() != Some(body) {
            continue;
        }
        assert_eq!(channel.sampler().interpolation(), gltf::animation::Interpolation::Linear);
        let reader = channel.reader(|_| film.blob.as_deref());
        let times = reader.read_inputs().unwrap().map(f64::from);
        match reader.read_outputs().unwrap() {
            ReadOutputs::Translations(all) => keys.moves = times.zip(all.map(vector)).collect(),
            ReadOutputs::Rotations(all) => {
                keys.turns = times.zip(all.into_f32().map(quaternion)).collect();
            }
            _ => panic!("only translations and rotations"),
        }
    }
    keys
}

/// The pose at a time, as viewers interpolate.
fn at<T: Copy>(keys: &[(f64, T)], time: f64, mix: impl Fn(T, T, f64) -> T) -> T {
    let next = keys.partition_point(|key| key.0 <= time).clamp(1, keys.len() - 1);
    let ((from, a), (to, b)) = (keys[next - 1], keys[next]);
    mix(a, b, ((time - from) / (to - from)).clamp(0.0, 1.0))
}

/// The table is another way from the same motion. Between keys at 60 a second gravity bends a way by
/// g/8/60² = 0.34 mm, and turning is off by a thousandth of a radian.
#[test]
fn the_film_moves_as_the_table_says() {
    for name in SCENES {
        let result = result(name);
        let film = read(&result, Some(60.0));
        let table = rows(&export::csv(&result, Some(1000.0)).unwrap());
        let first_s = table.iter().map(|row| row.time_s).fold(f64::INFINITY, f64::min);
        for body in &result.bodies {
            let keys = keys(&film, &body.name);
            let of_body = || table.iter().filter(|row| row.body == body.name);
            for row in of_body() {
                let time = row.time_s - first_s;
                let position = at(&keys.moves, time, |a, b, part| a.lerp(&b, part));
                assert!((position - Vector3::from(row.position)).norm() < 3.5e-4, "{name}");
                let Some([w, x, y, z]) = row.orientation else { continue };
                let expected = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
                let turned = at(&keys.turns, time, |a, b, part| a.slerp(&b, part));
                assert!(turned.angle_to(&expected) < 2e-3, "{name}");
            }
            assert_eq!(keys.turns.is_empty(), of_body().all(|row| row.orientation.is_none()));
        }
    }
}

/// One key at the collision, exact but for single precision, on which both sides agree.
#[test]
fn the_collision_is_a_key() {
    for name in SCENES {
        let result = result(name);
        let film = read(&result, None);
        let extras = film.default_scene().unwrap().extras().as_ref().unwrap().to_string();
        let extras: serde_json::Value = serde_json::from_str(&extras).unwrap();
        let collision_s = extras["collision_s"].as_f64().unwrap();
        let first_s = extras["first_pose_s"].as_f64().unwrap();
        assert!((first_s + collision_s - result.collision_time.value.unwrap()).abs() < 1e-12);
        assert_eq!(extras["scene"], result.scene);
        assert_eq!(extras["restitution"].as_f64(), result.restitution.value);
        assert_eq!(
            extras["mass_ratio"].as_f64(),
            result.mass_ratio.as_ref().and_then(|ratio| ratio.value)
        );
        for body in &result.bodies {
            let keys = keys(&film, &body.name);
            let moves = keys.moves.iter().filter(|key| (key.0 - collision_s).abs() < 1e-6);
            let [(_, position)] = moves.collect::<Vec<_>>()[..] else { panic!("one key") };
            assert!((position - Vector3::from(body.position)).norm() < ROUNDING_M);
            assert!(keys.moves.windows(2).all(|pair| pair[0].0 < pair[1].0));
        }
    }
}

/// A fast spin divides the frames: viewers take the shorter way from key to key, and must not go astray.
#[test]
fn turns_between_keys_stay_small() {
    let mut fast = result("boxes");
    fast.bodies[0].angular_velocity_after = Some([40.0, 10.0, -25.0]);
    for (result, fps) in [(result("boxes"), 60.0), (fast.clone(), 60.0), (fast, 10.0)] {
        let film = read(&result, Some(fps));
        for body in ["a", "b"] {
            let turns = keys(&film, body).turns;
            for pair in turns.windows(2) {
                assert!(pair[0].1.angle_to(&pair[1].1) < 0.1 + 1e-3);
                assert!(pair[0].1.coords.dot(&pair[1].1.coords) > 0.0, "no jump of sign");
            }
        }
    }
}

/// The scene's way up becomes +y, all else turned with it; a plane lies below the bodies.
#[test]
fn up_is_y() {
    for name in SCENES {
        let (result, scene) = (result(name), scene(name));
        let film = read(&result, None);
        let roots: Vec<Node> = film.default_scene().unwrap().nodes().collect();
        let [root] = roots.as_slice() else { panic!("one root") };
        assert_eq!(root.name(), Some(scene.name()));
        let (_, turn, _) = root.transform().decomposed();
        let up = quaternion(turn) * scene.up_in_world().into_inner();
        assert!((up - Vector3::y()).norm() < 1e-6, "{name}");
        let children = root.children().count();
        assert_eq!(children, scene.bodies().len() + usize::from(scene.plane().is_some()));
        let Some(plane) = scene.plane() else { continue };
        let (at, turn, _) = node(&film, &plane.name).transform().decomposed();
        let normal = plane.normal_in_world.into_inner();
        assert!((normal.dot(&vector(at)) - plane.height_m).abs() < ROUNDING_M);
        assert!((quaternion(turn) * Vector3::y() - normal).norm() < 1e-6);
    }
}

/// Each triangle's corners go round its normal, outwards; and the surface is the shape's.
#[test]
fn meshes_are_the_shapes() {
    for name in SCENES {
        let (result, scene) = (result(name), scene(name));
        let film = read(&result, None);
        for body in scene.bodies() {
            let mesh = node(&film, &body.name).mesh().unwrap();
            assert_eq!(mesh.primitives().count(), 2, "two tones show a spin");
            let mut corners: Vec<Vector3<f64>> = Vec::new();
            for primitive in mesh.primitives() {
                let reader = primitive.reader(|_| film.blob.as_deref());
                let points: Vec<_> = reader.read_positions().unwrap().map(vector).collect();
                let normals: Vec<_> = reader.read_normals().unwrap().map(vector).collect();
                let indices: Vec<_> = reader.read_indices().unwrap().into_u32().collect();
                for triangle in indices.chunks(3) {
                    let [a, b, c] = [0, 1, 2].map(|corner| points[triangle[corner] as usize]);
                    let across = (b - a).cross(&(c - a));
                    assert!(across.norm() > 1e-7, "no triangle is a line");
                    assert!(across.dot(&normals[triangle[0] as usize]) > 0.0);
                    assert!(across.dot(&a) > 0.0, "seen from outside");
                }
                corners.extend(indices.iter().map(|&index| points[index as usize]));
            }
            for corner in corners {
                match body.shape {
                    Shape::Box { size } => {
                        assert!((corner.abs() - Vector3::from(size) / 2.0).norm() < 1e-7);
                    }
                    Shape::Sphere { radius } => assert!((corner.norm() - radius).abs() < 1e-7),
                }
            }
        }
    }
}

/// Twice the same bytes; and small: an e-mail takes it.
#[test]
fn files_are_small_and_repeatable() {
    let result = result("boxes");
    let bytes = export::gltf(&result, None).unwrap();
    assert_eq!(bytes, export::gltf(&result, None).unwrap());
    assert!(bytes.len() < 100_000, "{} bytes", bytes.len());
    let row: Vec<Row> = rows(&export::csv(&result, None).unwrap());
    assert_eq!(row.len(), 2 * (88 + 3));
}
