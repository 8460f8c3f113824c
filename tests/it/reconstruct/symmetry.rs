//! No direction, place or order of the bodies is special.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use smash::Reconstruction;
use smash::scene::SceneFile;

use super::{
    EULER, EXACT, distance, mass_ratio, observations, restitution, six_of_a_drop, six_of_balls,
    six_of_cuboids, solved,
};

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
