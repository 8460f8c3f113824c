//! A session: what was tried, and what is being typed.

use super::action::{Action, Change};
use super::tree::{Tree, Variant};
use crate::effect::{Effect, EffectRequest, catalogue, name_of};
use crate::words::counted;
use crate::{Error, ErrorKind, Result, Scene};

/// Laws of a user's own.
const MOST_LAWS: usize = 50;

/// All that a user made.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Session {
    pub(super) tree: Tree,
    pub(super) draft: String,
}

/// A law of the user's own.
#[derive(Debug, Clone)]
pub(super) struct OwnLaw {
    pub(super) text: String,
    pub(super) effect: Effect,
}

impl Session {
    /// A new one: the base model.
    pub(super) fn new() -> Session {
        Session { tree: Tree::new(), draft: String::new() }
    }

    /// The same after `action`; whether that made a variant.
    ///
    /// # Errors
    /// It can't be done.
    pub(super) fn after(&self, scene: &Scene, action: Action) -> Result<(Session, bool)> {
        let mut next = self.clone();
        let change = match action {
            Action::Step(step) => {
                next.tree.step(step)?;
                return Ok((next, false));
            }
            Action::Change(change) => self.with_law(change),
        };
        let grown = next.tree.grow(scene, self.tree.current, change)?;
        if let Some(grown) = grown {
            if next.laws().len() > self.laws().len() {
                next.check_laws().map_err(|error| error.at("text"))?;
            }
            next.tree.go(grown);
        }
        Ok((next, grown.is_some()))
    }

    /// Refuses too many laws.
    pub(super) fn check_laws(&self) -> Result<()> {
        let laws = self.laws().len();
        if laws <= MOST_LAWS {
            return Ok(());
        }
        let problem = format!("the session would hold {}", counted(laws, "law"));
        Err(Error::new(ErrorKind::Invalid, problem)
            .mend(format!("keep {MOST_LAWS}: give a law the name of one that it replaces")))
    }

    /// The change, with the text of the law that it names: a variant depends on nothing but the one that
    /// it was made from.
    fn with_law(&self, change: Change) -> Change {
        let Change::Add { effect } = change else { return change };
        let name = name_of(&effect);
        let is_catalogued = || catalogue().iter().any(|known| known.name == name);
        let is_at_hand = self.tree.current().model.own(name).is_some() || is_catalogued();
        let law = self.laws().into_iter().find(|law| law.effect.name == name);
        match law.filter(|_| !is_at_hand) {
            Some(law) => Change::Law { text: law.text, effect },
            None => Change::Add { effect },
        }
    }

    /// The user's laws, each name once, in the order in which they came: as the current variant has
    /// it, else as it was written last.
    pub(super) fn laws(&self) -> Vec<OwnLaw> {
        let current = &self.tree.current().model;
        let mut laws: Vec<OwnLaw> = Vec::new();
        for variant in &self.tree.variants {
            let Variant { change: Some(Change::Law { text, effect }), model, .. } = variant else {
                continue;
            };
            let Some(own) = model.own(name_of(effect)) else { continue };
            let law = OwnLaw { text: text.clone(), effect: own.clone() };
            match laws.iter_mut().find(|known| known.effect.name == own.name) {
                Some(known) if current.own(&own.name) == Some(&known.effect) => {}
                Some(known) => *known = law,
                None => laws.push(law),
            }
        }
        laws
    }

    /// The model of the current variant, as requests for a fit.
    pub(super) fn requests(&self, scene: &Scene) -> Vec<EffectRequest> {
        self.tree.current().model.requests(scene)
    }
}
