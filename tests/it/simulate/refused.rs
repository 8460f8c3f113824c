//! Random collisions keep the rules; broken specifications are refused.

use nalgebra::Vector3;
use smash::ErrorKind;
use smash::simulate::{NoiseSpec, Sampling, SimulationSpec, simulate};

use super::every;

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
