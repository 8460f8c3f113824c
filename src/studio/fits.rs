//! Fits of variants, each made warm from the nearest one that is kept.
//!
//! A fit depends on the poses and on the effects in their order, not on the way that led there: it is
//! the base model's with effect after effect, as `smash reconstruct --with` makes it. So a session that
//! is opened again has the same numbers to the last bit.

use std::sync::Arc;

use super::edits::Edits;
use super::model::Model;
use crate::reconstruct::refined::{self, Fitted, Instance};
use crate::reconstruct::{Intervals, Reconstruction, RefinedOptions};
use crate::{Result, Scene};

/// Fits that are kept; the least recently used is dropped.
const MOST_KEPT: usize = 64;

/// A fitted model.
#[derive(Debug)]
pub(super) struct Fit {
    /// The poses that it is fitted to.
    pub(super) scene: Arc<Scene>,
    pub(super) fitted: Fitted,
    pub(super) result: Reconstruction,
}

/// The fits of one scene.
#[derive(Debug)]
pub(super) struct Fits {
    scene: Arc<Scene>,
    /// The most recently used last.
    kept: Vec<(Model, Arc<Fit>)>,
}

impl Fits {
    /// Of a scene, yet none.
    pub(super) fn new(scene: Arc<Scene>) -> Fits {
        Fits { scene, kept: Vec::new() }
    }

    /// The fit of `model`.
    ///
    /// # Errors
    /// What the edits leave is no scene, or the model can't be fitted.
    pub(super) fn fit(&mut self, model: &Model) -> Result<Arc<Fit>> {
        let (mut fit, known) = match self.nearest(model) {
            Some(nearest) => nearest,
            None => (self.base(&model.edits)?, 0),
        };
        for count in known..model.effects.len() {
            let fitted = fit.fitted.with(&fit.scene, &model.effects[count])?;
            fit = self.keep(&model.edits, &model.effects[..=count], fit.scene.clone(), fitted)?;
        }
        Ok(fit)
    }

    /// The kept fit to the same poses that has the most of the model's effects, none other, in their
    /// order; and how many.
    fn nearest(&mut self, model: &Model) -> Option<(Arc<Fit>, usize)> {
        let is_part =
            |kept: &Model| kept.edits == model.edits && model.effects.starts_with(&kept.effects);
        let parts = self.kept.iter().enumerate().filter(|(_, (kept, _))| is_part(kept));
        let (index, _) = parts.max_by_key(|(_, (kept, _))| kept.effects.len())?;
        let nearest = self.kept.remove(index);
        let found = (nearest.1.clone(), nearest.0.effects.len());
        self.kept.push(nearest);
        Some(found)
    }

    fn base(&mut self, edits: &Edits) -> Result<Arc<Fit>> {
        let scene = Arc::new(edits.fitted_poses(&self.scene)?);
        let fitted = refined::fit(&scene, &RefinedOptions::default())?;
        self.keep(edits, &[], scene, fitted)
    }

    fn keep(
        &mut self,
        edits: &Edits,
        effects: &[Arc<Instance>],
        scene: Arc<Scene>,
        fitted: Fitted,
    ) -> Result<Arc<Fit>> {
        let mut result = refined::report(&scene, &fitted, Intervals::Covariance)?;
        // The only numbers that would differ when the session is opened again.
        result.phases.iter_mut().for_each(|phase| phase.seconds = None);
        let fit = Arc::new(Fit { scene, fitted, result });
        if self.kept.len() == MOST_KEPT {
            self.kept.remove(0);
        }
        let model = Model { effects: effects.to_vec(), edits: edits.clone() };
        self.kept.push((model, fit.clone()));
        Ok(fit)
    }
}
