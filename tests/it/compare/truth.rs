//! Results of a simulated scene beside what it was made with.

use std::fs;
use std::process::Command;

use serde_json::Value;
use smash::compare::{NOT_IN_THE_MODEL, Quantity, against_truth};
use smash::simulate::{SimulationSpec, simulate};
use smash::{Comparison, Options, Reconstruction, Scene, reconstruct};
use tempfile::TempDir;

use super::{paper, quantity, run, success};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn found<'a>(quantities: &'a [Quantity], name: &str) -> &'a Quantity {
    quantities.iter().find(|one| one.quantity == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Errors are the result minus the truth, in the result's own deviations: the numbers by hand.
#[test]
fn errors_are_the_results_less_the_truth() {
    let spec = SimulationSpec::read(format!("{ROOT}/scenes/boxes.spec.json").as_ref()).unwrap();
    let simulation = simulate(&spec).unwrap();
    let (scene, truth) = (&simulation.scene, &simulation.truth);
    let result = reconstruct(scene, &Options::default()).unwrap();
    let named = [("it".to_string(), result.clone()), ("paper".to_string(), paper(scene))];
    let errors = against_truth(scene, truth, &named).unwrap();
    for (name, known, estimate) in [
        ("mass_ratio", truth.mass_ratio.unwrap(), result.mass_ratio.as_ref().unwrap()),
        ("restitution", truth.restitution, &result.restitution),
        ("collision_time", truth.collision_time, &result.collision_time),
    ] {
        let told = found(&errors, name);
        assert_eq!(told.entries[0].value, Some(vec![known]), "{name}");
        let off = estimate.value.unwrap() - known;
        assert_eq!(told.differences[0].difference, Some(vec![off]), "{name}");
        assert_eq!(told.differences[0].in_sigma, Some(off.abs() / estimate.std.unwrap()), "{name}");
        // The paper has no deviations, and errors all the same.
        assert_eq!(told.differences[1].in_sigma, None);
        assert!(told.differences[1].size.unwrap() > 0.0);
    }
    let off = result.impulse.iter().zip(&truth.impulse).map(|(one, known)| one - known);
    let size = off.map(|one| one * one).sum::<f64>().sqrt();
    let told = found(&errors, "impulse").differences[0].size.unwrap();
    assert!((told - size).abs() < 1e-12 * size, "{told}, not {size}");
}

/// A ball with a hidden drag, its truth, and the results without and with it.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let spec = format!("{ROOT}/scenes/thrown_ball_drag.spec.json");
    for arguments in [
        &["simulate", &spec, "-o", "scene.json", "--truth", "truth.json"][..],
        &["reconstruct", "scene.json", "-o", "base.json"],
        &["reconstruct", "scene.json", "--with", "quadratic_drag", "-o", "drag.json"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
        let output = command.args(arguments).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    folder
}

/// The drag's coefficient is found where the model has it, and the restitution only there.
#[test]
fn the_effects_that_acted_are_told_too() {
    let folder = folder();
    let arguments = ["scene.json", "base.json", "drag.json", "--truth", "truth.json"];
    let words = success(run(folder.path(), &arguments));
    for line in ["the truth", "quadratic_drag@ball  k (1/m)", NOT_IN_THE_MODEL] {
        assert!(words.contains(line), "no {line} in\n{words}");
    }
    let json = success(run(folder.path(), &[&arguments[..], &["--json"]].concat()));
    let comparison: Comparison = serde_json::from_str(&json).unwrap();
    let [base, drag] = &found(&comparison.against_truth, "quadratic_drag@ball.k").differences[..]
    else {
        panic!("{json}")
    };
    assert_eq!(base.size, None);
    assert!(drag.in_sigma.unwrap() < 4.0, "{drag:?}");
    let restitution = &found(&comparison.against_truth, "restitution").differences;
    assert!(restitution[0].in_sigma.unwrap() > 50.0 && restitution[1].in_sigma.unwrap() < 4.0);
    // Without the option all is as it was.
    let plain = success(run(folder.path(), &["scene.json", "base.json", "drag.json", "--json"]));
    let plain: Comparison = serde_json::from_str(&plain).unwrap();
    assert!(plain.against_truth.is_empty());
    assert_eq!(quantity(&plain, "restitution"), quantity(&comparison, "restitution"));
}

#[test]
fn another_truth_is_refused_by_name() {
    let folder = folder();
    let truth = fs::read_to_string(folder.path().join("truth.json")).unwrap();
    let put = |name: &str, edit: &dyn Fn(&mut Value)| {
        let mut value: Value = serde_json::from_str(&truth).unwrap();
        edit(&mut value);
        fs::write(folder.path().join(name), value.to_string()).unwrap();
    };
    put("other.json", &|truth| truth["bodies"][0]["name"] = "stone".into());
    put("huge.json", &|truth| truth["restitution"] = 1e200.into());
    put("extra.json", &|truth| truth["restituion"] = 1.into());
    for (truth, words) in [
        ("other.json", "other.json: bodies: are `stone`, but the scene's `ball`"),
        ("huge.json", "huge.json: restitution"),
        ("extra.json", "did you mean `restitution`?"),
        ("scene.json", "files whose `schema` is `smash.truth/1`"),
        ("none.json", "none.json: can't be read"),
    ] {
        let output =
            run(folder.path(), &["scene.json", "base.json", "--truth", truth, "-o", "out.json"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{truth}: {message}");
        assert!(message.contains(words), "{truth}: {message}");
        assert!(!folder.path().join("out.json").exists());
    }
    // Nor is it written over.
    let over = ["scene.json", "base.json", "--truth", "truth.json", "-o", "truth.json"];
    assert_eq!(run(folder.path(), &over).status.code(), Some(1));
    assert_eq!(fs::read_to_string(folder.path().join("truth.json")).unwrap(), truth);
}

/// A truth may come from elsewhere: no file that it names is opened.
#[test]
fn no_file_that_a_truth_names_is_read() {
    let spec = format!("{ROOT}/scenes/thrown_ball_drag.spec.json");
    let simulation = simulate(&SimulationSpec::read(spec.as_ref()).unwrap()).unwrap();
    let (scene, mut truth): (Scene, _) = (simulation.scene, simulation.truth);
    let result: Reconstruction = reconstruct(&scene, &Options::default()).unwrap();
    for name in ["-", "/dev/zero", "./wind.toml", ""] {
        truth.effects[0].name = name.to_string();
        let errors = against_truth(&scene, &truth, &[("it".to_string(), result.clone())]).unwrap();
        let last = errors.last().unwrap();
        assert_eq!(last.entries[1].reason.as_deref(), Some(NOT_IN_THE_MODEL), "{name}");
    }
}
