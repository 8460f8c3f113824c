//! What holds by construction, however noisy the poses.

use nalgebra::Vector3;
use smash::Reconstruction;
use smash::reconstruct::BodyResult;
use smash::simulate::{NoiseSpec, SimulationSpec, add_noise};

use super::{NOISE, every, mass_ratio, solve};

/// Rounding of metres, metres a second and their products: 1e-16 of a few tens.
const ROUNDING: f64 = 1e-13;

fn noisy_cuboids(seed: u64) -> Reconstruction {
    let (file, _) = every(9, SimulationSpec::random_cuboids(seed));
    solve(&add_noise(file, &NoiseSpec::Gaussian(NOISE), seed))
}

/// (p − point) × m v + k, before and after.
fn angular_momenta(body: &BodyResult, mass: f64, point: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let lever = Vector3::from(body.position) - point;
    [
        (body.velocity_before, body.angular_momentum_before),
        (body.velocity_after, body.angular_momentum_after),
    ]
    .map(|(v, k)| lever.cross(&(mass * Vector3::from(v))) + Vector3::from(k.unwrap()))
}

/// Newton's third law and its lever: nothing is gained or lost between two bodies.
#[test]
fn momentum_is_conserved_about_any_point() {
    for seed in [0, 2, 5] {
        let result = noisy_cuboids(seed);
        let masses = [1.0, mass_ratio(&result)];
        let [before, after]: [Vector3<f64>; 2] = [0, 1].map(|side| {
            let momentum = |(body, mass): (&BodyResult, f64)| {
                mass * Vector3::from([body.velocity_before, body.velocity_after][side])
            };
            result.bodies.iter().zip(masses).map(momentum).sum()
        });
        assert!((before - after).norm() < ROUNDING, "seed {seed}: {before} {after}");
        for point in [[0.0; 3], [3.0, -7.0, 2.0], result.contact_point.unwrap()] {
            let point = Vector3::from(point);
            let all = result.bodies.iter().zip(masses);
            let gain: Vector3<f64> = all
                .map(|(body, mass)| angular_momenta(body, mass, &point))
                .map(|[before, after]| after - before)
                .sum();
            assert!(gain.norm() < 10.0 * ROUNDING, "seed {seed}: {gain} about {point}");
        }
    }
}

/// Each body's own jumps are those of the impulse at the contact point: J, and (x_c − p) × J.
#[test]
fn each_body_is_pushed_by_the_impulse_at_the_contact_point() {
    let (drop, _) = every(9, SimulationSpec::random_box_drop(1));
    let drop = solve(&add_noise(drop, &NoiseSpec::Gaussian(NOISE), 1));
    for result in [noisy_cuboids(1), drop] {
        let impulse = Vector3::from(result.impulse);
        let second = result.mass_ratio.as_ref().map(|m| (m.value.unwrap(), -impulse));
        let pushes = [Some((1.0, impulse)), second].into_iter().flatten();
        for (body, (mass, push)) in result.bodies.iter().zip(pushes) {
            let jump = Vector3::from(body.velocity_after) - Vector3::from(body.velocity_before);
            assert!((mass * jump - push).norm() < ROUNDING, "{}", result.scene);
            let gain = Vector3::from(body.angular_momentum_after.unwrap())
                - Vector3::from(body.angular_momentum_before.unwrap());
            let lever = Vector3::from(result.contact_point.unwrap()) - Vector3::from(body.position);
            assert!((gain - lever.cross(&push)).norm() < ROUNDING, "{}", result.scene);
        }
    }
}
