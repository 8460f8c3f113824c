//! Scenes and further candidates, as `smash diagnose` and `smash improve` are asked with them.

use std::path::{Path, PathBuf};

use smash::effect::{EffectRequest, catalogue};
use smash::files::display_name;
use smash::reconstruct::RefinedOptions;
use smash::scene::{DynamicBody, Shape};
use smash::{Error, ErrorKind, Result, Scene};

/// A length that differs by a smaller share may be the same one, measured again.
const SAME_LENGTH: f64 = 0.01;

/// The scenes in these files, with their warnings told, and whether they show the same objects.
pub fn read_all(paths: &[PathBuf]) -> Result<Vec<Scene>> {
    let read = |path: &PathBuf| {
        let scene = Scene::read(path)?;
        super::warn(scene.warnings());
        Ok(scene)
    };
    let scenes: Vec<Scene> = paths.iter().map(read).collect::<Result<_>>()?;
    if let [(first, shown), others @ ..] = paths.iter().zip(&scenes).collect::<Vec<_>>().as_slice()
    {
        let differs = |(path, scene): &(&PathBuf, &Scene)| {
            let what = difference(scene, shown, &display_name(first, "standard input"))?;
            let mend = "several scenes are taken as throws of the same objects: give each object one \
                        name and one size in all of them, or ask about this scene by itself";
            let error = Error::new(ErrorKind::Invalid, what).mend(mend);
            Some(error.in_file(display_name(path, "standard input")))
        };
        super::warn(&others.iter().filter_map(differs).collect::<Vec<_>>());
    }
    Ok(scenes)
}

/// How the objects of `scene` aren't those of the scene `first`, in words.
fn difference(scene: &Scene, shown: &Scene, first: &str) -> Option<String> {
    let names = |scene: &Scene| {
        let names: Vec<String> =
            scene.bodies().iter().map(|body| format!("`{}`", body.name)).collect();
        names.join(" and ")
    };
    for body in scene.bodies() {
        let Some(same) = shown.bodies().iter().find(|known| known.name == body.name) else {
            return Some(format!("moves {}, but {first} {}", names(scene), names(shown)));
        };
        if !is_same_shape(body, same) {
            let [here, there] = [body, same].map(|body| shape_in_words(&body.shape));
            return Some(format!("`{}` is {here}, but in {first} {there}", body.name));
        }
    }
    None
}

fn is_same_shape(one: &DynamicBody, other: &DynamicBody) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= SAME_LENGTH * a.max(b);
    match (one.shape, other.shape) {
        (Shape::Box { size: a }, Shape::Box { size: b }) => {
            a.iter().zip(&b).all(|(a, b)| near(*a, *b))
        }
        (Shape::Sphere { radius: a }, Shape::Sphere { radius: b }) => near(a, b),
        _ => false,
    }
}

fn shape_in_words(shape: &Shape) -> String {
    match shape {
        Shape::Box { size: [x, y, z] } => format!("a box of {x} by {y} by {z} m"),
        Shape::Sphere { radius } => format!("a sphere of radius {radius} m"),
    }
}

/// The candidates that were typed, beside the model of `options`.
///
/// # Errors
/// One isn't an effect, or can't be told from another: answers tell effects by their names and bodies.
pub fn further(texts: &[String], options: &RefinedOptions) -> Result<Vec<EffectRequest>> {
    let mut further: Vec<EffectRequest> = Vec::new();
    for text in texts {
        let request = EffectRequest::parse(text)?;
        let mut known = options.effects.iter().chain(&further);
        if let Some(other) = known.find(|other| is_namesake(other, &request)) {
            let files = [other, &request].map(file);
            let name = &request.effect.name;
            let problem = format!("{} and {} both hold a law `{name}`", files[0], files[1]);
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("give one of them another name: answers tell laws by it"));
        }
        let is_tried_anyway = catalogue().contains(&request.effect);
        if is_tried_anyway || further.iter().any(|other| overlaps(other, &request)) {
            let problem = format!("`--try {text}` is a candidate already");
            return Err(Error::new(ErrorKind::Invalid, problem).mend(
                "leave it out; what you know to be there, with its values, goes with `--with`",
            ));
        }
        if request.effect.parameters.iter().all(|one| request.fixed.contains_key(&one.name)) {
            let problem =
                format!("`--try {text}` leaves nothing to be found: all values are given");
            return Err(Error::new(ErrorKind::Invalid, problem).mend(
                "leave one open, or add it: smash reconstruct SCENE --with tells how well it does",
            ));
        }
        further.push(request);
    }
    Ok(further)
}

/// Whether the two have one name, but say something else.
fn is_namesake(one: &EffectRequest, other: &EffectRequest) -> bool {
    one.effect.name == other.effect.name && one.effect != other.effect
}

/// Whether the two are of the same law on the same body.
fn overlaps(one: &EffectRequest, other: &EffectRequest) -> bool {
    let everywhere = one.body.is_none() || other.body.is_none();
    one.effect == other.effect && (everywhere || one.body == other.body)
}

fn file(request: &EffectRequest) -> String {
    let path = Path::new(request.effect.file.as_deref().unwrap_or("-"));
    display_name(path, "standard input")
}
