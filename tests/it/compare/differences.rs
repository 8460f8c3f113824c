//! Results side by side.

use std::fs;

use smash::{Options, reconstruct};

use super::{
    SCENES, assert_near, compared, folder, paper, quantity, refined, run, scene, scene_path,
};

#[test]
fn a_result_does_not_differ_from_itself() {
    for name in SCENES {
        let scene = scene(name);
        let refined = refined(&scene);
        let comparison = compared(&scene, &[&refined, &refined]);
        assert_eq!(comparison.results[0].channels, comparison.results[1].channels);
        for one in &comparison.quantities {
            assert_eq!(one.entries[0], one.entries[1]);
            let Some(size) = one.differences[0].size else { continue };
            // Rounding of a quaternion's product with its inverse.
            assert!(size < 1e-15, "{name}: {}", one.quantity);
            assert!(one.differences[0].in_sigma.is_none_or(|sigma| sigma < 1e-10));
        }
        let of_time = &quantity(&comparison, "collision_time").differences[0];
        assert_eq!((of_time.size, of_time.in_sigma), (Some(0.0), Some(0.0)));
    }
}

/// The paper has no standard deviations: the difference is told in the refined ones, and where both
/// have one, in the root of the sum of squares.
#[test]
fn differences_are_told_in_the_deviations_that_there_are() {
    let scene = scene("boxes");
    let (paper, refined) = (paper(&scene), refined(&scene));
    let mut shifted = refined.clone();
    let std = refined.collision_time.std.unwrap();
    *shifted.collision_time.value.as_mut().unwrap() += std;
    shifted.impulse[1] += 0.1;
    let comparison = compared(&scene, &[&refined, &paper, &shifted]);
    let [to_paper, to_shifted] = quantity(&comparison, "collision_time").differences.as_slice()
    else {
        panic!("two differences")
    };
    let apart = paper.collision_time.value.unwrap() - refined.collision_time.value.unwrap();
    assert_eq!(to_paper.difference, Some(vec![apart]));
    assert_eq!(to_paper.in_sigma, Some(apart.abs() / std));
    // One std of a time near 1 s is rounded at 1e-16 / 1e-3.
    assert!((to_shifted.in_sigma.unwrap() - 0.5_f64.sqrt()).abs() < 1e-9);

    let table = refined.uncertainty.as_ref().unwrap();
    let place = table.quantities.iter().position(|name| name == "impulse.y").unwrap();
    let expected = 0.1 / (table.std[place].unwrap() * 2.0_f64.sqrt());
    let of_impulse = &quantity(&comparison, "impulse").differences[1];
    assert_near(of_impulse.in_sigma.unwrap(), expected, 1e-9, "impulse");
    assert_near(of_impulse.size.unwrap(), 0.1, 1e-9, "impulse");

    let papers = compared(&scene, &[&paper, &paper]);
    assert!(papers.quantities.iter().all(|one| one.differences[0].in_sigma.is_none()));
    assert!(papers.quantities.iter().all(|one| one.differences[0].size.is_some()));
}

/// A quaternion and its negative are one pose; a turn about x differs about x alone.
#[test]
fn orientations_differ_by_the_angle_between_them() {
    let scene = scene("boxes");
    let refined = refined(&scene);
    let mut negative = refined.clone();
    negative.bodies[0].orientation = refined.bodies[0].orientation.map(|q| q.map(|x| -x));
    let mut turned = refined.clone();
    let [w, x, y, z] = refined.bodies[0].orientation.unwrap();
    let (s, c) = 0.1_f64.sin_cos();
    // (c, s, 0, 0) (w, x, y, z): 0.2 rad about the world's x.
    turned.bodies[0].orientation =
        Some([c * w - s * x, c * x + s * w, c * y - s * z, c * z + s * y]);
    let comparison = compared(&scene, &[&refined, &negative, &turned]);
    let [to_negative, to_turned] = quantity(&comparison, "a.orientation").differences.as_slice()
    else {
        panic!("two differences")
    };
    assert!(to_negative.size.unwrap() < 1e-15);
    assert!((to_turned.size.unwrap() - 0.2).abs() < 1e-14);
    assert!((to_turned.difference.as_ref().unwrap()[0] - 0.2).abs() < 1e-14);
}

/// Two digits of the least deviation on both sides, no powers of ten, and numbers' differences with
/// their sign; orientations differ by an angle.
#[test]
fn side_by_side_shows_as_many_digits_as_matter() {
    let folder = folder();
    fs::write(folder.path().join("scene.json"), fs::read(scene_path("boxes")).unwrap()).unwrap();
    for (name, options) in [("refined.json", Options::default()), ("paper.json", Options::paper())]
    {
        let result = reconstruct(&scene("boxes"), &options).unwrap();
        fs::write(folder.path().join(name), result.to_json()).unwrap();
    }
    let output = run(folder.path(), &["scene.json", "refined.json", "paper.json"]);
    let text = String::from_utf8(output.stdout).unwrap();
    let row = |start: &str| -> Vec<&str> {
        let line = text.lines().find(|line| line.trim_start().starts_with(start)).unwrap();
        line.split_whitespace().collect()
    };
    assert_eq!(row("restitution")[1..6], ["0.5909", "±", "0.0050", "0.6743", "+0.0834"]);
    assert_eq!(row("mass ratio")[2..7], ["1.809", "±", "0.016", "1.799", "-0.010"]);
    assert!(row("a  orientation")[10].ends_with('°'), "{text}");
    let comparison =
        compared(&scene("boxes"), &[&refined(&scene("boxes")), &paper(&scene("boxes"))]);
    let of = |name: &str| {
        let one = quantity(&comparison, name);
        (one.unit.as_str(), one.difference_unit.as_str())
    };
    assert_eq!(of("a.orientation"), ("", "rad"));
    assert_eq!(of("a.position"), ("m", "m"));
}

/// Where rounding is all, numbers are the same; the refined method conserves momentum exactly.
#[test]
fn rounding_is_no_difference() {
    let scene = scene("boxes");
    let result = refined(&scene);
    let mut rounded = result.clone();
    rounded.impulse[0] = rounded.impulse[0].next_up();
    let comparison = compared(&scene, &[&result, &rounded]);
    assert_eq!(quantity(&comparison, "impulse").differences[0].size, Some(0.0));
    let change = quantity(&comparison, "momentum_change").entries[0].value.clone();
    assert_eq!(change, Some(vec![0.0; 3]));
}
