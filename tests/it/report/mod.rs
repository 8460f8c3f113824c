//! `smash report`: one page with its data in it, whole or not at all.

mod again;
mod other_content;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use smash::report::Report;
use smash::{Options, Scene};

const SMASH: &str = env!("CARGO_BIN_EXE_smash");
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

fn smash(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(SMASH).args(arguments).current_dir(folder).output().unwrap()
}

fn assert_done(output: &Output) {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// What the page carries.
fn data(page: &str) -> Value {
    let start = page.find("id=\"smash-data\"").unwrap();
    let start = start + page[start..].find('>').unwrap() + 1;
    let end = start + page[start..].find("</script>").unwrap();
    serde_json::from_str(&page[start..end]).unwrap()
}

#[test]
fn a_page_carries_the_scene_the_results_and_what_they_lack() {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    for with in [&[][..], &["--with", "quadratic_drag@ball"]] {
        let name = if with.is_empty() { "base.json" } else { "drag.json" };
        let arguments = [&["reconstruct", &scene, "-o", name], with].concat();
        assert_done(&smash(folder.path(), &arguments));
    }
    let arguments = ["report", &scene, "drag.json", "base.json", "-o", "report.html", "--json"];
    let output = smash(folder.path(), &arguments);
    assert_done(&output);
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
    let data = data(&page);
    // Whole numbers are written with and without `.0`: as reports they are the same.
    let printed: Report = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(serde_json::from_value::<Report>(data.clone()).unwrap(), printed);
    let names: Vec<&str> =
        data["models"].as_array().unwrap().iter().map(|m| m["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["drag.json", "base.json"]);
    assert_eq!(data["diagnosis"]["candidates"][0]["effect"], "quadratic_drag");
    assert_eq!(data["improvement"]["ladder"][1]["added"], "quadratic_drag@ball");
    let commands: Vec<&str> =
        data["commands"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect();
    assert!(commands[0].ends_with("--with quadratic_drag@ball -o drag.json"), "{commands:?}");
    // The residuals over time are those of the summary.
    for model in data["models"].as_array().unwrap() {
        let squares: Vec<f64> = model["series"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|series| {
                ["along_velocity", "across_velocity_level", "across_velocity_upward"]
                    .contains(&series["axis"].as_str().unwrap())
            })
            .flat_map(|series| series["points"].as_array().unwrap())
            .map(|point| point["value"].as_f64().unwrap().powi(2))
            .collect();
        let rms = (squares.iter().sum::<f64>() / squares.len() as f64).sqrt();
        let told = model["residuals"]["position_rmse"].as_f64().unwrap();
        assert!((rms / told - 1.0).abs() < 1e-9, "{rms} {told}");
    }
}

/// What the page has no other way to know.
#[test]
fn it_says_whether_residuals_are_beyond_chance() {
    let scene = Scene::read(format!("{ROOT}/scenes/boxes.json")).unwrap();
    for (options, is_beyond) in [(Options::default(), false), (Options::paper(), true)] {
        let results = [("it".to_string(), smash::reconstruct(&scene, &options).unwrap())];
        let report = smash::report::report(&scene, &results, None, None).unwrap();
        assert_eq!(report.models[0].is_beyond_chance, is_beyond);
    }
}

/// Without results the base model and the best one are shown.
#[test]
fn without_results_the_ladder_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!("{ROOT}/scenes/thrown_ball_drag.json");
    assert_done(&smash(folder.path(), &["report", &scene, "-o", "report.html"]));
    let data = data(&fs::read_to_string(folder.path().join("report.html")).unwrap());
    assert_eq!(data["models"][0]["name"], "with quadratic_drag@ball");
    assert_eq!(data["models"][1]["name"], "base model");
}

/// Names are free text, and may hold what would end a script element.
#[test]
fn a_hostile_name_stays_text() {
    let folder = tempfile::tempdir().unwrap();
    let scene = fs::read_to_string(format!("{ROOT}/scenes/ball_on_floor.json")).unwrap();
    let mut scene: Value = serde_json::from_str(&scene).unwrap();
    let name = "</script><script>alert(1)</script><!--";
    scene["name"] = name.into();
    fs::write(folder.path().join("scene.json"), scene.to_string()).unwrap();
    assert_done(&smash(folder.path(), &["report", "scene.json", "-o", "report.html"]));
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    assert!(!page.contains("alert(1)</script>"));
    assert_eq!(data(&page)["scene"]["name"], name);
}

#[test]
fn what_is_not_of_the_scene_is_refused_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let [boxes, ball] = ["boxes", "ball_on_floor"].map(|name| format!("{ROOT}/scenes/{name}.json"));
    assert_done(&smash(folder.path(), &["reconstruct", &boxes, "-o", "boxes.json"]));
    for arguments in [
        ["report", &ball, "boxes.json", "-o", "report.html"],
        ["report", &boxes, "missing.json", "-o", "report.html"],
        ["report", "boxes.json", "boxes.json", "-o", "boxes.json"],
        ["report", &boxes, "boxes.json", "-o", "no/such/folder/report.html"],
    ] {
        let output = smash(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(said.matches("error: ").count(), 1, "{said}");
        assert!(!folder.path().join("report.html").exists(), "{arguments:?}");
    }
}

/// Standard output carries the page.
#[test]
fn json_has_no_place_beside_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!("{ROOT}/scenes/boxes.json");
    let output = smash(folder.path(), &["report", &scene, "-o", "-", "--json"]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0));
    assert!(String::from_utf8_lossy(&output.stderr).contains("leave `--json` out"));
}

/// The page's types are made from this schema.
#[test]
fn the_page_is_built_for_the_schema_of_today() {
    let schema = smash::schema(smash::SchemaKind::Report);
    let path = Path::new(ROOT).join("web/schemas/report.json");
    let known = fs::read_to_string(&path).unwrap_or_default();
    let mend = "smash schema report > web/schemas/report.json";
    assert!(known == schema, "{} is of another version: {mend}", path.display());
}
