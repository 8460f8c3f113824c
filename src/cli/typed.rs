//! What was typed, for the commands that a person may type next.

use std::path::{Path, PathBuf};

use smash::Result;
use smash::effect::EffectRequest;
use smash::files::shell_word;
use smash::reconstruct::{Options, RefinedOptions};

use super::again;
use super::method::Method;

/// Scenes and options, as they were typed.
pub struct Typed {
    scenes: Vec<String>,
    options: RefinedOptions,
    /// Further candidates.
    further: Vec<EffectRequest>,
}

impl Typed {
    /// Of a command with these arguments.
    ///
    /// # Errors
    /// An effect isn't one, or its file is faulty.
    pub fn new(scenes: &[PathBuf], method: &Method, further: &[String]) -> Result<Typed> {
        let further = further.iter().map(|text| EffectRequest::parse(text));
        Ok(Typed {
            scenes: scenes.iter().map(|path| shell_word(&path.to_string_lossy())).collect(),
            options: method.refined()?,
            further: further.collect::<Result<_>>()?,
        })
    }

    /// Of a command that takes a scene and nothing else.
    pub fn of_scene(scene: &Path) -> Typed {
        let scenes = vec![shell_word(&scene.to_string_lossy())];
        Typed { scenes, options: RefinedOptions::default(), further: Vec::new() }
    }

    /// A line of advice with the scene's own path for SCENE, and effects as they were typed.
    pub fn completed(&self, line: &str) -> String {
        let (one, options) = (self.scene(), self.flags());
        let several = match self.scenes.as_slice() {
            [one] => format!("{one} OTHER_SCENE …"),
            all => all.join(" "),
        };
        let line = line
            .replace("SCENE SCENE …", &format!("{several}{options}"))
            .replace("compare SCENE", &format!("compare {one}"))
            .replace(" SCENE ", &format!(" {one}{options} "));
        let line = line
            .strip_suffix(" SCENE")
            .map_or(line.clone(), |start| format!("{start} {one}{options}"));
        let mut words = line.split(' ');
        let mut completed: Vec<String> = words.next().map(String::from).into_iter().collect();
        for word in words {
            let is_effect = completed.last().is_some_and(|before| before == "--with");
            completed.push(if is_effect { self.effect(word) } else { word.to_string() });
        }
        completed.join(" ")
    }

    /// The command that reconstructs the scene with `labels` beside the effects that were typed.
    pub fn reconstruction(&self, labels: &[String]) -> String {
        let typed = again::reconstruction(self.scene(), &Options::Refined(self.options.clone()));
        let further = labels.iter().map(|label| format!(" --with {}", self.effect(label)));
        format!("{typed}{}", further.collect::<String>())
    }

    fn flags(&self) -> String {
        again::flags(&Options::Refined(self.options.clone()))
    }

    /// The scene; of several any.
    fn scene(&self) -> &str {
        match self.scenes.as_slice() {
            [scene] => scene,
            _ => "SCENE",
        }
    }

    /// What to type for the effect with this label: of a file its path, and values that are given.
    fn effect(&self, label: &str) -> String {
        let (name, body) = match label.split_once('@') {
            Some((name, body)) => (name, Some(body)),
            None => (label, None),
        };
        let is_it = |request: &EffectRequest| {
            request.effect.name == name
                && (request.body.is_none() || request.body.as_deref() == body)
        };
        let mut known = self.options.effects.iter().chain(&self.further);
        let Some(request) = known.find(|request| is_it(request)) else {
            return shell_word(label);
        };
        let body = body.map(String::from);
        shell_word(&EffectRequest { body, ..request.clone() }.to_string())
    }
}
