//! The robust loss: a few wrong annotations hardly count, and are named.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use smash::reconstruct::{Flag, Intervals, Loss, RefinedOptions};
use smash::scene::{Noise, ObservationFile, SceneFile};
use smash::simulate::{NoiseSpec, SimulationSpec, add_noise};
use smash::{Options, Reconstruction, Result, Scene, reconstruct};

use super::{NOISE, every, mass_ratio, poses, solve};

fn solve_robustly(file: &SceneFile) -> Result<Reconstruction> {
    let options = RefinedOptions { loss: Loss::Robust, ..RefinedOptions::default() };
    reconstruct(&Scene::from_file(file.clone())?, &Options::Refined(options))
}

fn boxes() -> SceneFile {
    let text = include_str!("../../../scenes/boxes.json");
    serde_json::from_str(text).unwrap()
}

/// `pose` turned by half a turn about the body's x axis: what a mistaken face looks like.
fn turn_over(pose: &mut ObservationFile) {
    let [w, x, y, z] = pose.orientation.unwrap();
    let seen = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let half = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    let over = seen * half;
    pose.orientation = Some([over.w, over.i, over.j, over.k]);
}

/// One position 0.15 m off, 75 σ, and one box annotated upside down: both are named, nothing else
/// is, and the mass ratio stays within four of its deviations of the truth, 1.8 by the scene's
/// specification.
#[test]
fn wrong_annotations_are_named_and_hardly_count() {
    let mut file = boxes();
    let moved = &mut file.bodies[0].observations.as_mut().unwrap()[5];
    moved.position[0] += 0.15;
    let moved_s = moved.frame.unwrap() / 60.0;
    let turned = &mut file.bodies[1].observations.as_mut().unwrap()[16];
    turn_over(turned);
    let turned_s = turned.frame.unwrap() / 60.0;
    let stated = solve_robustly(&file).unwrap();
    let estimated = solve_robustly(&SceneFile { noise: None, ..file.clone() }).unwrap();
    for result in [&stated, &estimated] {
        let mut named: Vec<_> = result
            .outliers
            .iter()
            .map(|one| (one.body.as_str(), one.time, one.channel.as_str()))
            .collect();
        named.sort_by(|a, b| a.0.cmp(b.0));
        assert_eq!(named, [("a", moved_s, "position"), ("b", turned_s, "orientation")]);
        assert_eq!(result.flags, []);
        let std = result.mass_ratio.as_ref().unwrap().std.unwrap();
        let off = (mass_ratio(result) - 1.8).abs() / std;
        assert!(off < 4.0, "{off} deviations");
    }
    // Squares heed the two, and the fit is known to be poor.
    let squares = solve(&file);
    assert!(squares.flags.contains(&Flag::PoorFit));
}

/// Where nothing is wrong, the robust mean of twenty-two poses a body is nearly the mean: within one
/// deviation of it.
#[test]
fn right_annotations_count_as_with_squares() {
    let (squares, robust) = (solve(&boxes()), solve_robustly(&boxes()).unwrap());
    let std = squares.mass_ratio.as_ref().unwrap().std.unwrap();
    let apart = (mass_ratio(&robust) - mass_ratio(&squares)).abs() / std;
    assert!(apart < 1.0, "{apart} deviations");
}

/// Two poses on each side leave nothing to tell a wrong one by: refused in words, with the mend.
#[test]
fn too_few_poses_are_refused() {
    let (mut file, _) = every(9, SimulationSpec::random_cuboids(2));
    for body in &mut file.bodies {
        let seen = body.observations.as_mut().unwrap();
        let middle = seen.len() / 2;
        *seen = seen[middle - 2..middle + 2].to_vec();
    }
    let noisy = add_noise(file, &NoiseSpec::Gaussian(NOISE), 1);
    let error = solve_robustly(&noisy).unwrap_err();
    assert!(error.to_string().contains("too few poses for a robust fit"), "{error}");
    assert!(error.hint().unwrap().contains("annotate more poses"));
}

/// The likelihood that a profile follows is that of squares.
#[test]
fn profile_intervals_are_not_of_the_robust_loss() {
    let options = RefinedOptions {
        loss: Loss::Robust,
        intervals: Intervals::Profile,
        ..RefinedOptions::default()
    };
    let scene = Scene::from_file(boxes()).unwrap();
    let error = reconstruct(&scene, &Options::Refined(options)).unwrap_err();
    assert!(error.to_string().contains("least squares"), "{error}");
    assert!(error.hint().unwrap().contains("leave one"));
}

/// Poses said to be as exact as a film's never are, and one a metre off: a thousand million
/// deviations. An answer comes all the same, and says that it is poor.
#[test]
fn a_pose_far_off_an_exact_noise_is_no_error() {
    let (mut file, _) = every(9, SimulationSpec::random_cuboids(2));
    file.noise = Some(Noise { position: 1e-9, orientation: 1e-9 });
    poses(&mut file).next().unwrap().position[0] += 1.0;
    for result in [solve(&file), solve_robustly(&file).unwrap()] {
        assert!(result.flags.contains(&Flag::PoorFit), "{:?}", result.flags);
    }
}
