//! Standard deviations and intervals against the scatter that they speak of.

use std::sync::OnceLock;

use nalgebra::DMatrix;
use smash::reconstruct::{Estimate, NoiseReport, RefinedOptions};
use smash::scene::{Noise, SceneFile};
use smash::simulate::{NoiseSpec, SimulationSpec, Truth, add_noise};
use smash::{Options, Reconstruction, Scene, reconstruct};

use super::{NOISE, every, solve};

/// One scene of two cuboids, every ninth frame.
fn scene() -> &'static (SceneFile, Truth) {
    static SCENE: OnceLock<(SceneFile, Truth)> = OnceLock::new();
    SCENE.get_or_init(|| every(9, SimulationSpec::random_cuboids(2)))
}

const COPIES: u64 = 100;

/// As many annotators' view of that scene; `stated`: whether they tell their noise.
fn annotated(stated: bool) -> Vec<Reconstruction> {
    (0..COPIES)
        .map(|seed| {
            let mut file = add_noise(scene().0.clone(), &NoiseSpec::Gaussian(NOISE), seed);
            file.noise = file.noise.filter(|_| stated);
            solve(&file)
        })
        .collect()
}

/// Name, true value, and estimate.
fn estimates(result: &Reconstruction) -> [(&'static str, f64, &Estimate); 3] {
    let truth = &scene().1;
    [
        ("mass ratio", truth.mass_ratio.unwrap(), result.mass_ratio.as_ref().unwrap()),
        ("restitution", truth.restitution, &result.restitution),
        ("collision time", truth.collision_time, &result.collision_time),
    ]
}

/// Of 100 intervals of 95 %, 86 or more hold the truth: fewer would come about with a probability
/// of 1e-4 (binomial). That all do has one of 0.6 %, too much to be excluded; intervals far too
/// wide are found by the scatter instead.
const LEAST_HITS: usize = 86;

fn assert_intervals_hold(results: &[Reconstruction]) {
    for index in 0..3 {
        let name = estimates(&results[0])[index].0;
        let hits = results.iter().filter(|result| {
            let (_, truth, estimate) = estimates(result)[index];
            let [low, high] = estimate.interval_95.unwrap();
            low <= truth && truth <= high
        });
        let hits = hits.count();
        assert!(hits >= LEAST_HITS, "{name}: {hits} of {COPIES}");
    }
}

/// The deviation said is the deviation seen, about the truth. The square of the scatter of 100
/// copies has χ² with 100 degrees of freedom: four of its own deviations are 1 ± 0.57, so of the
/// ratio 0.65 to 1.25.
#[test]
fn deviations_are_those_of_repeated_annotation() {
    let results = annotated(true);
    for index in 0..3 {
        let name = estimates(&results[0])[index].0;
        let mean_square = |value: &dyn Fn(f64, &Estimate) -> f64| {
            let squares = results.iter().map(|result| {
                let (_, truth, estimate) = estimates(result)[index];
                value(truth, estimate).powi(2)
            });
            squares.sum::<f64>() / COPIES as f64
        };
        let scatter = mean_square(&|truth, estimate| estimate.value.unwrap() - truth);
        let said = mean_square(&|_, estimate| estimate.std.unwrap());
        let ratio = (scatter / said).sqrt();
        assert!((0.65..1.25).contains(&ratio), "{name}: {ratio}");
    }
    assert_intervals_hold(&results);
}

/// Where the scene doesn't tell the noise it is estimated: its square is right on average, and
/// Student's longer intervals hold the truth as often.
#[test]
fn noise_that_is_not_stated_is_estimated() {
    let results = annotated(false);
    assert_intervals_hold(&results);
    // The mean of 100 squares, of some 30 spare numbers each or more, scatters by sqrt(2 / 3000)
    // at most: four of that.
    let mean_square = |of: fn(&NoiseReport) -> f64| {
        let squares = results.iter().map(|result| of(result.noise.as_ref().unwrap()).powi(2));
        squares.sum::<f64>() / COPIES as f64
    };
    let position = mean_square(|noise| noise.position) / NOISE.position.powi(2);
    let orientation = mean_square(|noise| noise.orientation.unwrap()) / NOISE.orientation.powi(2);
    assert!((position - 1.0).abs() < 0.1, "{position}");
    assert!((orientation - 1.0).abs() < 0.1, "{orientation}");
    for result in &results {
        assert!(result.noise.as_ref().unwrap().estimated);
        assert_eq!(result.fit.chi2, None, "estimated noise makes χ² a matter of course");
    }
}

/// Half the uncertainty of all that is given, half the deviation of all that follows: to the accuracy
/// of derivatives by differences.
#[test]
fn deviations_go_with_the_noise() {
    let said = |share: f64| {
        let noise =
            Noise { position: share * NOISE.position, orientation: share * NOISE.orientation };
        let tilt_std_rad = share * RefinedOptions::default().tilt_std_rad;
        let file = SceneFile { noise: Some(noise), ..scene().0.clone() };
        let options =
            Options::Refined(RefinedOptions { tilt_std_rad, ..RefinedOptions::default() });
        reconstruct(&Scene::from_file(file).unwrap(), &options).unwrap()
    };
    let (whole, half) = (said(1.0).uncertainty.unwrap(), said(0.5).uncertainty.unwrap());
    for ((name, whole), half) in whole.quantities.iter().zip(&whole.std).zip(&half.std) {
        // Along itself gravity can't vary: a tilt turns it.
        if name != "gravity.y" {
            let ratio = half.unwrap() / whole.unwrap();
            assert!((ratio - 0.5).abs() < 1e-4, "{name}: {ratio}");
        }
    }
}

/// The table is one of deviations and correlations: those of the estimates, 1 with itself, and no
/// combination of quantities has a negative variance.
#[test]
fn the_table_of_uncertainties_is_a_covariance() {
    let drop = every(9, SimulationSpec::random_box_drop(1)).0;
    for file in [scene().0.clone(), drop] {
        let result = solve(&add_noise(file, &NoiseSpec::Gaussian(NOISE), 1));
        let table = result.uncertainty.as_ref().unwrap();
        assert_eq!(table.quantities.len(), table.std.len());
        assert_eq!(table.quantities.len(), table.correlation.len());
        let known: Vec<usize> = (0..table.std.len()).filter(|&i| table.std[i].is_some()).collect();
        for (row, correlations) in table.correlation.iter().enumerate() {
            assert_eq!(correlations.len(), row + 1);
            assert_eq!(correlations[row].is_some(), table.std[row].is_some());
            // Rounding of a badly determined quantity's variance.
            assert!(correlations[row].is_none_or(|itself| (itself - 1.0).abs() < 1e-9));
            assert!(correlations.iter().flatten().all(|r| r.abs() <= 1.0));
        }
        let matrix = DMatrix::from_fn(known.len(), known.len(), |i, j| {
            let (i, j) = (known[i.max(j)], known[i.min(j)]);
            table.correlation[i][j].unwrap()
        });
        // Rounding of a matrix whose largest eigenvalue is at most its size.
        let least = matrix.symmetric_eigenvalues().min();
        assert!(least > -1e-6, "{least}");
        let named = |name: &str| {
            table.std[table.quantities.iter().position(|quantity| quantity == name).unwrap()]
        };
        assert_eq!(named("restitution"), result.restitution.std);
        assert_eq!(named("collision_time"), result.collision_time.std);
        if let Some(mass_ratio) = &result.mass_ratio {
            assert_eq!(named("mass_ratio"), mass_ratio.std);
        }
    }
}
