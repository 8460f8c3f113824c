//! The noise is as large as it says.

use smash::scene::Noise;
use smash::simulate::{NoiseSpec, SimulationSpec, simulate};

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
