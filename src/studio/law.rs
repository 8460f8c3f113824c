//! A law while it is typed: whether it is one, and where it isn't.

use schemars::JsonSchema;
use serde::Serialize;

use super::place::Place;
use crate::effect::EffectRequest;
use crate::effect::{Effect, catalogue};
use crate::reconstruct::refined::instances;
use crate::words::quoted;
use crate::{Error, Result, Scene};

/// What is to be said of a law that is being typed.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LawCheck {
    /// The effect, if the law is good and the scene can show it.
    pub effect: Option<LawEffect>,
    /// What is wrong; empty where nothing is.
    pub mistakes: Vec<LawMistake>,
    /// The state's number, now that it holds the draft.
    pub revision: u64,
}

/// A good law.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LawEffect {
    /// Its name.
    pub name: String,
    /// What it is, in a few words.
    pub title: String,
    /// What can be added to the model, such as `tether@a`.
    pub labels: Vec<String>,
}

/// What is wrong with a law, and where.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LawMistake {
    /// Of the text, from 1.
    pub line: usize,
    /// Where it starts in the line, from 1, in UTF-16 units, as a browser counts.
    pub column: usize,
    /// How long it is, in UTF-16 units; it ends in the same line.
    pub length: usize,
    /// What is wrong.
    pub problem: String,
    /// How to mend it.
    pub mend: Option<String>,
}

/// A user's own effect, by the checks that all effects must pass, and with a name of its own.
///
/// # Errors
/// As [`Effect::parse`], or the name is one of the catalogue's.
pub(super) fn own_effect(text: &str) -> Result<Effect> {
    let effect = Effect::parse(text, "your law")?;
    if catalogue().iter().any(|known| known.name == effect.name) {
        let problem = format!("{} is an effect of the catalogue", quoted(&effect.name));
        return Err(Error::invalid("name", problem)
            .mend(format!("give yours another name, such as `my_{}`", effect.name)));
    }
    Ok(effect)
}

/// What of `effect` a scene can show.
///
/// # Errors
/// The scene lacks what the effect needs.
pub(super) fn labels(scene: &Scene, effect: &Effect) -> Result<Vec<String>> {
    let request = EffectRequest { effect: effect.clone(), body: None, fixed: Default::default() };
    Ok(instances(scene, &request)?.iter().map(|instance| instance.label(scene)).collect())
}

/// Checks a draft.
pub(super) fn check(scene: &Scene, draft: &str, revision: u64) -> LawCheck {
    let found = own_effect(draft).and_then(|effect| {
        let labels = labels(scene, &effect).map_err(|error| error.at("needs"))?;
        Ok(LawEffect { name: effect.name, title: effect.title, labels })
    });
    match found {
        Ok(effect) => LawCheck { effect: Some(effect), mistakes: Vec::new(), revision },
        // Nobody need be told that nothing isn't a law.
        Err(_) if draft.trim().is_empty() => {
            LawCheck { effect: None, mistakes: Vec::new(), revision }
        }
        Err(error) => {
            LawCheck { effect: None, mistakes: vec![LawMistake::new(draft, &error)], revision }
        }
    }
}

impl LawMistake {
    fn new(text: &str, error: &Error) -> LawMistake {
        let Place { line, column, length } = Place::of(text, error);
        // The further lines show what the reader has before them.
        let problem = error.problem().lines().next().unwrap_or_default();
        let problem = match error.place().filter(|_| error.span().is_none()) {
            Some(field) if !field.starts_with("line ") => format!("{field}: {problem}"),
            _ => problem.to_string(),
        };
        LawMistake { line, column, length, problem, mend: error.hint().map(String::from) }
    }
}
