//! `smash compare` and its library: residuals from the numbers in a result, and results side by
//! side.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::{Value, json};
use smash::compare::{Channel, Quantity, Segment};
use smash::{Comparison, Options, Reconstruction, Scene, SchemaKind, compare, reconstruct, schema};
use tempfile::TempDir;

use crate::scenes::edited;

const SCENES: [&str; 4] = ["boxes", "uneven_times", "ball_on_floor", "box_on_floor"];

fn scene_path(name: &str) -> String {
    format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

fn scene(name: &str) -> Scene {
    Scene::read(scene_path(name)).unwrap()
}

fn paper(scene: &Scene) -> Reconstruction {
    reconstruct(scene, &Options::paper()).unwrap()
}

fn refined(scene: &Scene) -> Reconstruction {
    reconstruct(scene, &Options::default()).unwrap()
}

/// The comparison of these results, named by their order.
fn compared(scene: &Scene, results: &[&Reconstruction]) -> Comparison {
    let names = ["first", "second", "third"];
    let named: Vec<_> =
        names.iter().zip(results).map(|(name, &one)| (name.to_string(), one.clone())).collect();
    compare(scene, &named).unwrap()
}

fn quantity<'a>(comparison: &'a Comparison, name: &str) -> &'a Quantity {
    comparison.quantities.iter().find(|one| one.quantity == name).unwrap()
}

fn assert_near(found: f64, expected: f64, share: f64, what: &str) {
    assert!((found - expected).abs() <= share * expected, "{what}: {found}, not {expected}");
}

/// A result's numbers are enough to fly its bodies again. The refined solver's integrator is good to
/// far below the noise, so a thousandth of it is room enough; the paper's parabolas are the same
/// closed form, once gravity is tilted as the fit found it.
#[test]
fn the_motion_in_a_result_leaves_the_error_that_it_reports() {
    for name in SCENES {
        let scene = scene(name);
        let (paper, refined) = (paper(&scene), refined(&scene));
        let comparison = compared(&scene, &[&paper, &refined]);
        let [of_paper, of_refined] = comparison.results.as_slice() else { panic!("two results") };
        let position = |one: &Reconstruction| one.fit.position_rmse;
        assert_near(of_paper.position_rmse.unwrap(), position(&paper), 1e-9, name);
        assert_near(of_refined.position_rmse.unwrap(), position(&refined), 1e-9, name);
        match refined.fit.orientation_rmse {
            Some(angle) => assert_near(of_refined.orientation_rmse.unwrap(), angle, 1e-3, name),
            None => assert_eq!(of_refined.orientation_rmse, None, "{name}"),
        }
    }
}

/// Without the fitted tilt the same numbers miss the poses by more: the field is what tells.
#[test]
fn without_gravity_in_the_file_the_scenes_is_taken() {
    let scene = scene("boxes");
    let paper = paper(&scene);
    let mut older = paper.clone();
    older.gravity = None;
    let mut upright = paper.clone();
    upright.gravity = Some([0.0, -9.81, 0.0]);
    let comparison = compared(&scene, &[&paper, &older, &upright]);
    let rmse = |index: usize| comparison.results[index].position_rmse.unwrap();
    assert!((rmse(1) - rmse(0)).abs() > 1e-6);
    assert_eq!(rmse(1), rmse(2));
}

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

/// One annotation that is off shows in its channel, at its time, and nowhere else.
#[test]
fn a_wrong_pose_is_found() {
    let text = fs::read_to_string(scene_path("boxes")).unwrap();
    let original: Value = serde_json::from_str(&text).unwrap();
    let refined = refined(&scene("boxes"));
    let poses = |side: std::cmp::Ordering| {
        let time = refined.collision_time.value.unwrap();
        let seen = original["bodies"][1]["observations"].as_array().unwrap();
        let fps = original["fps"].as_f64().unwrap();
        seen.iter()
            .map(|one| one["frame"].as_f64().unwrap() / fps)
            .position(|t| t.total_cmp(&time) == side)
            .unwrap()
    };
    let index = poses(std::cmp::Ordering::Greater) + 1;
    let wrong = edited(original.clone(), |scene| {
        let x = &mut scene["bodies"][1]["observations"][index]["position"][0];
        *x = json!(x.as_f64().unwrap() + 0.05);
    });
    let wrong = Scene::parse(&wrong.to_string(), "scene.json").unwrap();
    let comparison = compared(&wrong, &[&refined]);
    let failing: Vec<_> = comparison.results[0]
        .channels
        .iter()
        .filter(|one| one.stands_out == Some(true))
        .map(|one| (one.body.as_str(), one.segment, one.channel))
        .collect();
    assert_eq!(failing, [("b", Segment::After, Channel::Position)]);
    let one = comparison.results[0].channels.iter().find(|one| one.stands_out == Some(true));
    let largest = &one.unwrap().largest;
    assert_eq!(largest.time, wrong.bodies()[1].observations[index].time_s);
    // 50 mm, but for the noise of that pose.
    assert!((largest.size - 0.05).abs() < 0.01, "{} m", largest.size);
    assert_eq!(largest.in_sigma, Some(largest.size / 0.002));
    let [outlier] = comparison.results[0].outliers.as_slice() else { panic!("one wrong pose") };
    assert_eq!((outlier.body.as_str(), outlier.time), ("b", largest.time));
    assert_eq!(
        (outlier.channel.as_str(), Some(outlier.deviations)),
        ("position", largest.in_sigma)
    );
    let right = compared(&scene("boxes"), &[&refined]);
    assert_eq!((&right.results[0].outliers, &right.results[0].findings), (&vec![], &vec![]));
    assert!(
        compared(&scene("boxes"), &[&refined]).results[0]
            .channels
            .iter()
            .all(|one| one.stands_out == Some(false))
    );
}

/// The scene's noise if it states one, else that of the first result that has one, else none.
#[test]
fn residuals_are_told_in_the_noise_that_is_known() {
    let scene = scene("uneven_times");
    assert_eq!(scene.noise(), None);
    let (paper, refined) = (paper(&scene), refined(&scene));
    let both = compared(&scene, &[&paper, &refined]);
    let noise = both.noise.unwrap();
    assert_eq!(noise.from_result.as_deref(), Some("second"));
    assert_eq!(noise.position, refined.noise.as_ref().unwrap().position);
    let alone = compared(&scene, &[&paper]);
    assert_eq!(alone.noise, None);
    for one in &alone.results[0].channels {
        assert_eq!((one.rmse_in_sigma, one.stands_out, one.largest.in_sigma), (None, None, None));
    }
}

#[test]
fn a_comparison_fits_its_schema() {
    let schema: Value = serde_json::from_str(&schema(SchemaKind::Comparison)).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    for name in SCENES {
        let scene = scene(name);
        let comparison = compared(&scene, &[&paper(&scene), &refined(&scene)]);
        let written: Value = serde_json::from_str(&comparison.to_json()).unwrap();
        assert_eq!(validator.validate(&written).map_err(|e| e.to_string()), Ok(()));
        let read: Comparison = serde_json::from_value(written).unwrap();
        assert_eq!(read, comparison);
    }
}

/// What a result says is what is read, in every digit; unknown fields, as a batch adds, are passed
/// over.
#[test]
fn a_result_is_read_as_it_was_written() {
    for name in SCENES {
        let scene = scene(name);
        for result in [paper(&scene), refined(&scene)] {
            let read = Reconstruction::parse(&result.to_json(), "result.json").unwrap();
            assert_eq!(read, result);
            let later = edited(serde_json::to_value(&result).unwrap(), |value| {
                value["provenance"] = json!({"by": "a batch"});
                value["bodies"][0]["colour"] = json!("red");
            });
            assert_eq!(Reconstruction::parse(&later.to_string(), "result.json").unwrap(), result);
        }
    }
}

/// Each rule broken once: the place and a word of the problem or the mend.
#[test]
fn broken_results_are_refused_by_name() {
    type Case = (fn(&mut Value), &'static str, &'static str);
    let cases: [Case; 12] = [
        (|r| r["schema"] = json!("smash.scene/1"), "schema", "smash.result/1"),
        (|r| r["schema"] = json!(null), "schema", "text"),
        (|r| r["impulse"] = json!([0, 1]), "impulse", "list of 3"),
        (|r| r["impulse"][1] = json!("much"), "impulse[1]", "number"),
        (|r| r["impulse"][1] = json!(1e101), "impulse[1]", "not within"),
        (|r| r["collision_time"] = json!(0.5), "collision_time", "object"),
        (|r| r["restitution"]["std"] = json!(-0.1), "restitution.std", "σ"),
        (|r| r["uncertainty"]["std"][0] = json!(0), "uncertainty.std[0]", "σ"),
        (|r| r["uncertainty"]["std"] = json!([]), "uncertainty.std", "each quantity"),
        (|r| r["noise"]["position"] = json!(0), "noise.position", "σ"),
        (
            |r| r["bodies"][1]["orientation"] = json!([2, 0, 0, 0]),
            "bodies[1].orientation",
            "length",
        ),
        (|r| r["preset"] = json!("papr"), "preset", "did you mean `paper`?"),
    ];
    let good = serde_json::to_value(refined(&scene("boxes"))).unwrap();
    for (edit, place, word) in cases {
        let text = edited(good.clone(), edit).to_string();
        let error = Reconstruction::parse(&text, "result.json").unwrap_err();
        assert_eq!(error.place(), Some(place));
        let message = error.to_string();
        assert!(message.starts_with("result.json: "), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}

/// Results that are in order, but can't be of this scene.
#[test]
fn results_of_another_scene_are_refused() {
    let scene = scene("boxes");
    let good = refined(&scene);
    type Case = (fn(&mut Reconstruction), &'static str);
    let cases: [Case; 5] = [
        (|r| r.bodies.swap(0, 1), "`b`, `a`"),
        (|r| r.bodies.truncate(1), "`a`, but"),
        (|r| r.bodies.clear(), "empty"),
        (|r| r.collision_time.value = Some(7.0), "7 s"),
        (|r| r.bodies[0].angular_velocity_after = Some([1e6, 0.0, 0.0]), "turns"),
    ];
    for (edit, word) in cases {
        let mut wrong = good.clone();
        edit(&mut wrong);
        let named = [("good.json".to_string(), good.clone()), ("wrong.json".to_string(), wrong)];
        let error = compare(&scene, &named).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("wrong.json: "), "{message}");
        assert!(message.contains(word) && error.hint().is_some(), "{message}");
    }
}

/// Without what a motion needs there are no residuals of it, and a reason.
#[test]
fn what_a_result_does_not_tell_is_not_compared() {
    let scene = scene("boxes");
    let good = refined(&scene);
    let mut spinless = good.clone();
    spinless.bodies[1].angular_velocity_after = None;
    let mut timeless = good.clone();
    timeless.collision_time.value = None;
    let comparison = compared(&scene, &[&good, &spinless, &timeless]);
    let [of_good, of_spinless, of_timeless] = comparison.results.as_slice() else {
        panic!("three results")
    };
    assert_eq!((of_good.channels.len(), &of_good.reason), (8, &None));
    assert_eq!(of_spinless.channels.len(), 7);
    assert!(of_spinless.reason.as_ref().unwrap().contains("spins"));
    assert_eq!((of_timeless.channels.len(), of_timeless.position_rmse), (0, None));
    assert!(of_timeless.reason.as_ref().unwrap().contains("collision time"));
    let spin = &quantity(&comparison, "b.angular_velocity_after");
    assert_eq!((spin.entries[1].value.as_ref(), spin.differences[0].size), (None, None));
    assert!(spin.entries[1].reason.is_some());
}

/// A folder with the scene and the results of both presets.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scene = scene("boxes");
    fs::copy(scene_path("boxes"), folder.path().join("scene.json")).unwrap();
    fs::write(folder.path().join("paper.json"), paper(&scene).to_json()).unwrap();
    fs::write(folder.path().join("refined.json"), refined(&scene).to_json()).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_smash"))
        .arg("compare")
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn success(output: Output) -> String {
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
    assert_eq!(output.status.code(), Some(0));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_command_tells_in_words_and_in_json() {
    let folder = folder();
    let words =
        success(run(folder.path(), &["scene.json", "paper.json", "refined.json", "-o", "c.json"]));
    for expected in [
        "mass ratio",
        "collision time (s)",
        "difference",
        " σ",
        "yardstick",
        "position",
        "orientation",
        " mm",
        "°",
        "stated in the scene",
        "Where it fails",
    ] {
        assert!(words.contains(expected), "no {expected:?} in\n{words}");
    }
    let written = fs::read_to_string(folder.path().join("c.json")).unwrap();
    let comparison: Comparison = serde_json::from_str(&written).unwrap();
    assert_eq!(comparison.schema, "smash.comparison/1");
    assert_eq!(comparison.results[1].name, "refined.json");
    let arguments = ["scene.json", "paper.json", "refined.json", "--json"];
    assert_eq!(success(run(folder.path(), &arguments)), written);

    let alone = success(run(folder.path(), &["scene.json", "refined.json"]));
    assert!(!alone.contains("difference") && alone.contains("Nothing looks structured"), "{alone}");
    assert!(alone.contains("angular momentum") && alone.contains("energy of spin"), "{alone}");
    // A screen.
    assert!(alone.lines().count() < 50, "{alone}");
}

/// A picture for each result and body, in a folder that is made; results of one name are told apart.
#[test]
fn the_command_draws() {
    let folder = folder();
    fs::create_dir(folder.path().join("other")).unwrap();
    fs::copy(folder.path().join("paper.json"), folder.path().join("other/refined.json")).unwrap();
    let arguments = ["scene.json", "refined.json", "other/refined.json", "--svg", "plots"];
    success(run(folder.path(), &arguments));
    let mut files: Vec<String> = fs::read_dir(folder.path().join("plots"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    let expected = ["refined-a-2.svg", "refined-a.svg", "refined-b-2.svg", "refined-b.svg"];
    assert_eq!(files, expected);
    let svg = |name| fs::read_to_string(folder.path().join("plots").join(name)).unwrap();
    assert!(svg("refined-a.svg").contains("refined.json: a, poses minus model"));
    assert_ne!(svg("refined-a.svg"), svg("refined-a-2.svg"));
    let output = run(folder.path(), &["scene.json", "refined.json", "--svg", "scene.json"]);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(message.contains("scene.json") && message.contains("folder"), "{message}");
}

#[test]
fn the_command_names_the_file_at_fault() {
    let folder = folder();
    fs::write(folder.path().join("cut.json"), "{\"schema\": \"smash.result/1\", ").unwrap();
    fs::write(folder.path().join("twice.json"), "{\"impulse\": 1, \"impulse\": 2}").unwrap();
    for file in ["cut.json", "twice.json", "missing.json", "scene.json"] {
        let output =
            run(folder.path(), &["scene.json", "refined.json", file, "-o", "comparison.json"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.starts_with(&format!("error: {file}: ")), "{message}");
        assert!(message.contains("\n  hint: "), "{message}");
        assert!(!folder.path().join("comparison.json").exists());
    }
    // A result is an input: it isn't written over.
    let output = run(folder.path(), &["scene.json", "refined.json", "-o", "refined.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(run(folder.path(), &["scene.json"]).status.code(), Some(2));
}

/// Names are free text: another one alone is no matter; beside other poses it says which scene's they
/// are.
#[test]
fn another_scene_is_a_warning() {
    let folder = folder();
    let text = fs::read_to_string(folder.path().join("scene.json")).unwrap();
    let renamed =
        edited(serde_json::from_str(&text).unwrap(), |scene| scene["name"] = json!("new"));
    let other = edited(renamed.clone(), |scene| scene["gravity"] = json!(9.8));
    for (scene, told) in
        [(renamed, ""), (other, "warning: refined.json was made from another scene")]
    {
        fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
        let output = run(folder.path(), &["scene.json", "refined.json"]);
        assert_eq!(output.status.code(), Some(0));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.starts_with(told) && message.is_empty() == told.is_empty(), "{message}");
    }
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

/// Gravity along the floor is no gravity upwards.
#[test]
fn where_gravity_cannot_be_the_scenes_it_says_how() {
    let scene = scene("boxes");
    for (gravity, told) in [([9.81, 0.0, 0.0], "sideways"), ([0.0, 9.81, 0.0], "upwards")] {
        let mut result = refined(&scene);
        result.gravity = Some(gravity);
        let error = compare(&scene, &[("result".to_string(), result)]).unwrap_err();
        assert!(error.to_string().contains(told), "{error}");
    }
}
