//! A pose with a noise of its own counts by it, in the fit and in what the fit is judged by.

use smash::compare::compare;
use smash::reconstruct::{Flag, Loss, RefinedOptions};
use smash::scene::SceneFile;
use smash::simulate::{NoiseSpec, SimulationSpec, add_noise};
use smash::{Options, Reconstruction, Scene, reconstruct};

use super::{NOISE, every, mass_ratio, poses, solve, with_noise_stated};

/// Two searches end as near each other, in deviations: they stop where steps are this small.
const SAME: f64 = 1e-2;

fn deviation(result: &Reconstruction) -> f64 {
    result.mass_ratio.as_ref().unwrap().std.unwrap()
}

/// With the annotator's noise, unstated.
fn noisy() -> SceneFile {
    let (exact, _) = every(5, SimulationSpec::random_cuboids(3));
    let mut file = add_noise(exact, &NoiseSpec::Gaussian(NOISE), 3);
    file.noise = None;
    file
}

/// A pose that is as good as not there weighs nothing: the fit is that without it.
#[test]
fn a_pose_of_much_noise_counts_for_nothing() {
    let mut wrong = with_noise_stated(noisy());
    let pose = poses(&mut wrong).nth(2).unwrap();
    pose.position[0] += 0.05;
    let with_it = solve(&wrong);
    let mut without = wrong.clone();
    without.bodies[0].observations.as_mut().unwrap().remove(2);
    let without = solve(&without);
    poses(&mut wrong).nth(2).unwrap().noise_scale = Some(1000.0);
    let scaled = solve(&wrong);
    let off = |result: &Reconstruction| {
        (mass_ratio(result) - mass_ratio(&without)).abs() / deviation(&without)
    };
    assert!(off(&with_it) > 0.5 && off(&scaled) < SAME, "{} {}", off(&with_it), off(&scaled));
    // All of its residual is in the errors, and nothing of it in χ².
    assert!(scaled.fit.position_rmse > 2.0 * without.fit.position_rmse);
    let chi2 = [&scaled, &without].map(|result| result.fit.chi2.unwrap());
    assert!((chi2[0] - chi2[1]).abs() < 0.01, "{chi2:?}");
    // Nor is it called wrong.
    assert!(!with_it.outliers.is_empty());
    let times = |result: &Reconstruction| -> Vec<f64> {
        result.outliers.iter().map(|outlier| outlier.time).collect()
    };
    assert_eq!(times(&scaled), times(&without));
}

/// Nor does it lead the search astray, however far off it is.
#[test]
fn a_pose_of_much_noise_far_away_counts_for_nothing() {
    let mut wrong = with_noise_stated(noisy());
    let pose = poses(&mut wrong).nth(2).unwrap();
    pose.position[0] += 5.0;
    pose.noise_scale = Some(1000.0);
    let scaled = solve(&wrong);
    wrong.bodies[0].observations.as_mut().unwrap().remove(2);
    let without = solve(&wrong);
    let off = (mass_ratio(&scaled) - mass_ratio(&without)).abs() / deviation(&without);
    // 2.5 of its own deviations: what it still pulls is far less than one of the fit's.
    assert!(off < 0.1, "{off}");
}

/// Whether the noise is called 2 mm, or 1 mm of poses that are all twice as noisy, is a word.
#[test]
fn all_poses_twice_as_noisy_is_twice_the_noise() {
    let plain = with_noise_stated(noisy());
    let mut scaled = plain.clone();
    scaled.noise = scaled.noise.map(|mut noise| {
        noise.position /= 2.0;
        noise.orientation /= 2.0;
        noise
    });
    poses(&mut scaled).for_each(|pose| pose.noise_scale = Some(2.0));
    for loss in [Loss::Squares, Loss::Robust] {
        let fitted = |file: &SceneFile| {
            let options = Options::Refined(RefinedOptions { loss, ..RefinedOptions::default() });
            let scene = Scene::from_file(file.clone()).unwrap();
            let result = reconstruct(&scene, &options).unwrap();
            let compared = compare(&scene, &[("it".to_string(), result.clone())]).unwrap();
            (result, compared.results[0].clone())
        };
        let ((one, seen), (other, seen_scaled)) = (fitted(&plain), fitted(&scaled));
        let off = (mass_ratio(&one) - mass_ratio(&other)) / deviation(&one);
        assert!(off.abs() < SAME, "{off}");
        assert!((deviation(&one) / deviation(&other) - 1.0).abs() < SAME);
        assert!((one.fit.chi2.unwrap() / other.fit.chi2.unwrap() - 1.0).abs() < SAME);
        for (test, scaled) in seen.structure.iter().zip(&seen_scaled.structure) {
            assert!((test.rmse_in_sigma / scaled.rmse_in_sigma - 1.0).abs() < SAME);
            assert!((test.p_value - scaled.p_value).abs() < 0.02);
        }
        for (channel, scaled) in seen.channels.iter().zip(&seen_scaled.channels) {
            let [one, other] = [channel, scaled].map(|one| one.rmse_in_sigma.unwrap());
            assert!((one / other - 1.0).abs() < SAME);
        }
    }
    // The paper's χ², too: its energy has no noise.
    let [one, other] = [&plain, &scaled].map(|file| {
        reconstruct(&Scene::from_file(file.clone()).unwrap(), &Options::paper()).unwrap()
    });
    assert!((one.fit.chi2.unwrap() / other.fit.chi2.unwrap() - 1.0).abs() < 1e-9);
}

/// Where no noise is stated it is that of a pose of scale 1.
#[test]
fn noise_is_estimated_by_the_scales() {
    let plain = noisy();
    let mut scaled = plain.clone();
    poses(&mut scaled).for_each(|pose| pose.noise_scale = Some(4.0));
    let noise = |file: &SceneFile| solve(file).noise.unwrap();
    let (one, other) = (noise(&plain), noise(&scaled));
    assert!((one.position / other.position / 4.0 - 1.0).abs() < 1e-2);
    let turns = [one.orientation, other.orientation].map(Option::unwrap);
    assert!((turns[0] / turns[1] / 4.0 - 1.0).abs() < 1e-2);
}

/// Where no noise is stated, a fit is judged in metres and radians: that all poses are called twenty times
/// as noisy changes nothing of that. The drag that this model lacks bends the flight by 7 mm.
#[test]
fn a_poor_fit_is_poor_by_whatever_scale() {
    let text = include_str!("../../../scenes/thrown_ball_drag.json");
    let mut file: SceneFile = serde_json::from_str(text).unwrap();
    file.noise = None;
    for scale in [1.0, 20.0] {
        poses(&mut file).for_each(|pose| pose.noise_scale = Some(scale));
        for loss in [Loss::Squares, Loss::Robust] {
            let options = Options::Refined(RefinedOptions { loss, ..RefinedOptions::default() });
            let scene = Scene::from_file(file.clone()).unwrap();
            let result = reconstruct(&scene, &options).unwrap();
            assert!(result.flags.contains(&Flag::PoorFit), "{loss:?}, {scale}: {:?}", result.flags);
        }
    }
}
