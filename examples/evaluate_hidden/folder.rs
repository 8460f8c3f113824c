//! Cases from a folder: `case_*.json`, each with its `truth/case_*.json`, and if there is one,
//! `oracle/case_*.json`, what another solver finds.

use std::path::Path;

use serde_json::Value;
use smash::effect::{EffectRequest, catalogue};
use smash::files::read_text;
use smash::{Error, ErrorKind, Result, Scene};

use crate::case::Case;

/// All cases in `folder` whose effects are in the catalogue, by name.
pub fn cases(folder: &Path) -> Result<Vec<Case>> {
    let unreadable = |error: std::io::Error| {
        Error::new(ErrorKind::Read, error.to_string()).in_file(folder.display().to_string())
    };
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut names: Vec<String> =
        names.filter(|name| name.starts_with("case_") && name.ends_with(".json")).collect();
    names.sort();
    let mut cases = Vec::new();
    for name in names {
        let truth = folder.join("truth").join(&name);
        let Some(mut case) = case(&folder.join(&name), &truth)? else { continue };
        let oracle = folder.join("oracle").join(&name);
        if oracle.exists() {
            case.found_elsewhere = found(&oracle)?;
        }
        cases.push(case);
    }
    Ok(cases)
}

/// What an oracle's file says of the mass ratio and the restitution with the right effects.
fn found(path: &Path) -> Result<[Option<f64>; 2]> {
    let oracle = value(path)?;
    let estimates = &oracle["estimates"]["truth_model"];
    Ok(["mass_ratio", "restitution"].map(|name| estimates[name].as_f64()))
}

fn value(path: &Path) -> Result<Value> {
    serde_json::from_str(&read_text(path)?).map_err(|error| {
        Error::new(ErrorKind::Parse, error.to_string()).in_file(path.display().to_string())
    })
}

fn case(scene_path: &Path, truth_path: &Path) -> Result<Option<Case>> {
    let wrong = |problem: &str| {
        Error::new(ErrorKind::Parse, problem).in_file(truth_path.display().to_string())
    };
    let truth = value(truth_path)?;
    let acting = truth["effects"].as_array().ok_or_else(|| wrong("`effects` isn't a list"))?;
    let labels: Vec<String> = acting.iter().flat_map(labels).collect();
    let is_known = |label: &String| {
        let name = label.split('@').next().unwrap_or(label);
        catalogue().iter().any(|effect| effect.name == name)
    };
    if !labels.iter().all(is_known) {
        eprintln!("{}: {} isn't in the catalogue", scene_path.display(), labels.join(", "));
        return Ok(None);
    }
    let scene = Scene::read(scene_path)?;
    let noise = scene.noise().ok_or_else(|| wrong("the scene states no noise"))?;
    let restitution = truth["restitution"].as_f64();
    let requests: Result<Vec<_>> = labels.iter().map(|label| EffectRequest::parse(label)).collect();
    Ok(Some(Case {
        name: scene_path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        scene,
        effects: requests?,
        true_effects: None,
        found_elsewhere: [None; 2],
        mass_ratio: truth["mass_ratio"].as_f64(),
        restitution: restitution.ok_or_else(|| wrong("`restitution` isn't a number"))?,
        noise,
    }))
}

/// What one entry of the truth asks for: each wrong pose is an outlier of its own.
fn labels(effect: &Value) -> Vec<String> {
    let name = effect["name"].as_str().unwrap_or_default();
    let label = |body: &Value| match body.as_str() {
        Some(body) => format!("{name}@{body}"),
        None => name.to_owned(),
    };
    match effect["params"]["poses"].as_array() {
        Some(poses) => poses.iter().map(|pose| label(&pose["body"])).collect(),
        None if name == "none" => Vec::new(),
        None => vec![label(&effect["body"])],
    }
}
