//! What is told where a collision is at the edge of the model.

use smash::reconstruct::Flag;
use smash::scene::Noise;
use smash::simulate::{NoiseSpec, SimulationSpec};
use smash::{Options, reconstruct};

use super::{
    EULER, EXACT, distance, every_ninth_frame, mass_ratio, observations, restitution, scene,
    simulated, six_of_balls, six_of_cuboids, six_poses, solved,
};

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
