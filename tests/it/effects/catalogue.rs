//! The sixteen effects, and what is said of each.

use std::fs;
use std::path::Path;

use smash::effect::{Effect, Need, Scope, catalogue, find};

const NAMES: [&str; 16] = [
    "linear_drag",
    "quadratic_drag",
    "magnus",
    "constant_force",
    "gravity_scale",
    "gravity_tilt",
    "spin_drag",
    "inertia",
    "com_offset",
    "friction",
    "external_impulse",
    "torsional_impulse",
    "second_impact",
    "outlier",
    "time_offset",
    "depth_scale",
];

#[test]
fn the_catalogue_holds_the_sixteen() {
    let names: Vec<&str> = catalogue().iter().map(|effect| effect.name.as_str()).collect();
    assert_eq!(names, NAMES);
}

/// The built-in effects are files of the same language, and no file is forgotten.
#[test]
fn each_is_the_file_of_its_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("effects");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), NAMES.len());
    for effect in catalogue() {
        let path = folder.join(format!("{}.toml", effect.name));
        assert_eq!(&Effect::read(&path).unwrap(), effect);
        assert_eq!(find(path.to_str().unwrap()).unwrap().as_ref(), effect);
        assert_eq!(find(&effect.name).unwrap().as_ref(), effect);
    }
}

#[test]
fn each_says_all_that_people_need() {
    for effect in catalogue() {
        let help = &effect.help;
        for text in [&effect.title, &help.looks_like, &help.tell_apart, &help.source] {
            assert!(text.len() > 10, "{}: {text:?}", effect.name);
        }
        assert!(!help.confused_with.is_empty(), "{}", effect.name);
        for name in &help.confused_with {
            assert!(
                NAMES.contains(&name.as_str()) && *name != effect.name,
                "{}: {name}",
                effect.name
            );
        }
        for parameter in &effect.parameters {
            assert!(!parameter.typical.is_empty(), "{} {}", effect.name, parameter.name);
            let [low, high] = parameter.bounds;
            assert!(parameter.scale < high - low, "{} {}", effect.name, parameter.name);
        }
    }
}

#[test]
fn scopes_and_needs_are_those_of_the_physics() {
    let scope = |name: &str| find(name).unwrap().scope;
    assert_eq!(scope("quadratic_drag"), Scope::Body);
    assert_eq!(scope("gravity_scale"), Scope::Scene);
    assert_eq!(scope("gravity_tilt"), Scope::Scene);
    assert_eq!(scope("friction"), Scope::Contact);
    assert_eq!(scope("torsional_impulse"), Scope::Contact);
    assert_eq!(find("friction").unwrap().needs, [Need::Plane]);
    assert_eq!(find("depth_scale").unwrap().needs, [Need::Camera]);
    assert_eq!(find("linear_drag").unwrap().needs, []);
}

#[test]
fn a_misspelt_name_is_guessed() {
    let message = |name: &str| find(name).unwrap_err().to_string();
    assert_eq!(
        message("quadratic_darg"),
        "there is no effect `quadratic_darg`\n  hint: did you mean `quadratic_drag`?"
    );
    assert!(message("wind").contains("known here: `linear_drag`, "));
    assert!(message("./nowhere.toml").starts_with("./nowhere.toml: can't be read"));
}
