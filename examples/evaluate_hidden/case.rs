//! A scene with what is true of it.

use std::path::Path;

use smash::effect::EffectRequest;
use smash::files::Output;
use smash::scene::Noise;
use smash::{Result, Scene};

/// A scene, and what it was made with.
#[derive(Clone)]
pub struct Case {
    /// The seed or file that it is from.
    pub name: String,
    pub scene: Scene,
    /// What is hidden; of a user's law with the parameters that a ruler tells.
    pub effects: Vec<EffectRequest>,
    /// The same with all parameters as they are in truth; `None` where that isn't known.
    pub true_effects: Option<Vec<EffectRequest>>,
    /// `None` against a static body.
    pub mass_ratio: Option<f64>,
    pub restitution: f64,
    /// Mass ratio and restitution that another solver finds with the right effects, as far as known.
    pub found_elsewhere: [Option<f64>; 2],
    /// Of the annotations, whether the scene states it or not.
    pub noise: Noise,
}

impl Case {
    /// Writes the scene into `folder`, named by what is hidden and the seed.
    ///
    /// # Errors
    /// It can't be written.
    pub fn keep(&self, folder: &Path) -> Result<()> {
        let name = format!("{} {}.json", self.kind(), self.name).replace(' ', "_");
        Output::check(&folder.join(name), &[])?.write(self.scene.to_file().to_json().as_bytes())
    }

    /// What became of it; an error names it.
    ///
    /// # Errors
    /// Those of `tried`.
    pub fn told<T>(&self, tried: impl FnOnce(&Case) -> Result<T>) -> Result<T> {
        tried(self).map_err(|error| error.in_file(format!("{} {}", self.kind(), self.name)))
    }

    /// The effects' names, joined by `+`, in the order of the alphabet.
    pub fn kind(&self) -> String {
        let mut names: Vec<&str> =
            self.effects.iter().map(|request| request.effect.name.as_str()).collect();
        names.sort();
        // Two wrong poses are one kind of mistake.
        names.dedup();
        if names.is_empty() { "none".into() } else { names.join("+") }
    }

    /// `NAME@BODY` of each effect, or `NAME` of one that acts on all.
    pub fn labels(&self) -> Vec<String> {
        self.effects.iter().map(label).collect()
    }

    /// The same, but the scene doesn't tell its noise.
    ///
    /// # Errors
    /// None is known.
    pub fn unstated(mut self) -> Result<Case> {
        let mut file = self.scene.to_file();
        file.noise = None;
        self.scene = Scene::from_file(file)?;
        Ok(self)
    }
}

/// `NAME@BODY`, or `NAME`.
pub fn label(request: &EffectRequest) -> String {
    match &request.body {
        Some(body) => format!("{}@{body}", request.effect.name),
        None => request.effect.name.clone(),
    }
}
