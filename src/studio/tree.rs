//! The tree of variants: each change makes one, none is ever deleted.

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::action::{Change, Step};
use super::model::Model;
use crate::reconstruct::Reconstruction;
use crate::words::counted;
use crate::{Error, ErrorKind, Result, Scene};

/// Variants of a session.
pub(super) const MOST_VARIANTS: usize = 1_000;
/// Variants that are shown beside the current one.
pub(super) const MOST_COMPARED: usize = 4;

/// A model that was tried.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Variant {
    /// What it was made from; only the first has none.
    pub(super) parent: Option<usize>,
    /// What was changed.
    pub(super) change: Option<Change>,
    /// The child that one came back from last.
    pub(super) redo: Option<usize>,
    pub(super) model: Arc<Model>,
    pub(super) numbers: Numbers,
}

/// How well a variant fits.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Numbers {
    /// Root mean square over the position coordinates of the poses that the fit has, m.
    pub position_rmse: f64,
    /// Root mean square over the components of their rotation vectors, rad; null without
    /// orientations.
    pub orientation_rmse: Option<f64>,
    /// χ² over its degrees of freedom; null where no noise is stated.
    pub reduced_chi2: Option<f64>,
    /// Sum of squared residuals over the stated noise; null where none is.
    pub chi2: Option<f64>,
    /// m_b / m_a; null without a second dynamic body, and where the poses don't tell it.
    pub mass_ratio: Option<f64>,
    /// The restitution; null where the poses don't tell it.
    pub restitution: Option<f64>,
    /// From the act to the fit, ms.
    pub milliseconds: f64,
}

impl Numbers {
    /// Takes those of a result; not how long it took.
    pub(super) fn take(&mut self, result: &Reconstruction) {
        *self = Numbers {
            position_rmse: result.fit.position_rmse,
            orientation_rmse: result.fit.orientation_rmse,
            reduced_chi2: result.fit.reduced_chi2,
            chi2: result.fit.chi2,
            mass_ratio: result.mass_ratio.as_ref().and_then(|estimate| estimate.value),
            restitution: result.restitution.value,
            milliseconds: self.milliseconds,
        };
    }
}

/// All variants, and which are seen. Parents come before their children.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tree {
    pub(super) variants: Vec<Variant>,
    pub(super) current: usize,
    /// Further ones that are shown; never the current one.
    pub(super) compared: Vec<usize>,
}

impl Tree {
    /// The base model alone.
    pub(super) fn new() -> Tree {
        let root = Variant {
            parent: None,
            change: None,
            redo: None,
            model: Arc::default(),
            numbers: Numbers::default(),
        };
        Tree { variants: vec![root], current: 0, compared: Vec::new() }
    }

    pub(super) fn current(&self) -> &Variant {
        &self.variants[self.current]
    }

    /// Adds a variant of `parent`, and returns its number; `None` where the change changes nothing.
    ///
    /// # Errors
    /// The change can't be made.
    pub(super) fn grow(
        &mut self,
        scene: &Scene,
        parent: usize,
        change: Change,
    ) -> Result<Option<usize>> {
        self.check_room()?;
        let old = &self.variants[parent].model;
        let model = old.changed(scene, &change)?;
        if model == **old {
            return Ok(None);
        }
        Ok(Some(self.push(parent, change, Arc::new(model))))
    }

    /// Adds a variant of `parent`, and returns its number.
    pub(super) fn push(&mut self, parent: usize, change: Change, model: Arc<Model>) -> usize {
        self.variants.push(Variant {
            parent: Some(parent),
            change: Some(change),
            redo: None,
            model,
            numbers: Numbers::default(),
        });
        self.variants.len() - 1
    }

    /// Refuses one more than a session holds.
    pub(super) fn check_room(&self) -> Result<()> {
        if self.variants.len() >= MOST_VARIANTS {
            let problem =
                format!("the session holds {} already", counted(MOST_VARIANTS, "variant"));
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("keep this session, and start a new one: --session FILE"));
        }
        Ok(())
    }

    /// Takes a step.
    ///
    /// # Errors
    /// There is nothing to go to.
    pub(super) fn step(&mut self, step: Step) -> Result<()> {
        let nowhere = |problem: &str| {
            Err(Error::new(ErrorKind::Invalid, problem).mend("choose a variant of the tree"))
        };
        match step {
            Step::Undo => match self.current().parent {
                Some(parent) => self.go(parent),
                None => return nowhere("this is the first variant"),
            },
            Step::Redo => match self.current().redo {
                Some(child) => self.go(child),
                None => return nowhere("nothing was undone here"),
            },
            Step::Go { variant } => {
                self.check("variant", variant)?;
                self.go(variant);
            }
            Step::Compare { variant, shown } => {
                self.check("variant", variant)?;
                self.compared.retain(|other| *other != variant);
                if shown && variant != self.current {
                    self.compared.push(variant);
                }
                if self.compared.len() > MOST_COMPARED {
                    let problem = format!("{MOST_COMPARED} are shown already");
                    return Err(Error::invalid("variant", problem).mend("hide one of them first"));
                }
            }
        }
        Ok(())
    }

    /// Makes `variant` the current one, and remembers the way back to where one was.
    pub(super) fn go(&mut self, variant: usize) {
        let mut child = self.current;
        while let Some(parent) = self.variants[child].parent {
            self.variants[parent].redo = Some(child);
            child = parent;
        }
        self.current = variant;
        self.compared.retain(|other| *other != variant);
    }

    /// Adds the variants of another tree of the same scene, and goes where that one is. What both have
    /// isn't doubled.
    ///
    /// # Errors
    /// Both together are too large.
    pub(super) fn graft(&mut self, other: &Tree) -> Result<()> {
        let mut places = vec![0];
        for variant in &other.variants[1..] {
            let parent = places[variant.parent.unwrap_or(0)];
            let is_same =
                |known: &Variant| known.parent == Some(parent) && known.change == variant.change;
            let place = self.variants.iter().position(is_same).unwrap_or(self.variants.len());
            if place == self.variants.len() {
                self.variants.push(Variant { parent: Some(parent), redo: None, ..variant.clone() });
            }
            places.push(place);
        }
        if self.variants.len() > MOST_VARIANTS {
            let problem = format!("both together are {}", counted(self.variants.len(), "variant"));
            return Err(Error::new(ErrorKind::Invalid, problem).mend(format!(
                "{MOST_VARIANTS} go into a session: open this one by itself, with --session FILE"
            )));
        }
        for (variant, &place) in other.variants.iter().zip(&places) {
            if let Some(redo) = variant.redo {
                self.variants[place].redo = Some(places[redo]);
            }
        }
        self.go(places[other.current]);
        // Siblings of the same change are one here: several may lead to the same place.
        for place in other.compared.iter().map(|&variant| places[variant]) {
            let is_new = place != self.current && !self.compared.contains(&place);
            if is_new && self.compared.len() < MOST_COMPARED {
                self.compared.push(place);
            }
        }
        Ok(())
    }

    /// Refuses the number of a variant that isn't there.
    pub(super) fn check(&self, place: &str, variant: usize) -> Result<()> {
        if variant < self.variants.len() {
            return Ok(());
        }
        Err(Error::invalid(place, format!("there is no variant {variant}"))
            .mend(format!("there are 0 to {}", self.variants.len() - 1)))
    }
}
