//! A session with all that is to be seen of it.

use std::sync::Arc;
use std::time::Instant;

use super::edits::Edits;
use super::fits::{Fit, Fits};
use super::law::labels;
use super::session::{OwnLaw, Session};
use super::state::{CatalogueEffect, LawView, Limits, STUDIO_SCHEMA, StudioState, VariantView};
use super::tree::Variant;
use crate::compare::compare;
use crate::diagnose::all_candidates;
use crate::effect::{EffectRequest, catalogue};
use crate::reconstruct::Reconstruction;
use crate::reconstruct::refined::Instance;
use crate::report::{self, Report};
use crate::{Result, Scene};

/// A session at one moment.
#[derive(Debug, Clone)]
pub(super) struct Shown {
    pub(super) session: Session,
    pub(super) revision: u64,
    /// Poses and effects of the current variant.
    pub(super) fit: Arc<Fit>,
    report: Arc<Report>,
    /// What could be added to it.
    candidates: Arc<Vec<Instance>>,
}

impl Shown {
    /// Fits what is seen of `session`.
    ///
    /// # Errors
    /// A variant can't be fitted.
    pub(super) fn new(
        mut session: Session,
        revision: u64,
        scene: &Scene,
        fits: &mut Fits,
    ) -> Result<Shown> {
        let current = session.tree.current;
        let fit = fits.fit(&session.tree.variants[current].model)?;
        // Those of a file may be another version's.
        session.tree.variants[current].numbers.take(&fit.result);
        let mut results = vec![(name(&session, scene, current), fit.result.clone())];
        for &variant in &session.tree.compared {
            let other = fits.fit(&session.tree.variants[variant].model)?;
            results.push((name(&session, scene, variant), other.result.clone()));
        }
        let report =
            Arc::new(reported(scene, &session.tree.current().model.edits, &fit.scene, &results)?);
        let further: Vec<EffectRequest> = session.laws().into_iter().map(request).collect();
        let candidates = Arc::new(all_candidates(&fit.scene, &fit.fitted, &further)?);
        Ok(Shown { session, revision, fit, report, candidates })
    }

    /// Says that the current variant was asked for at this moment.
    pub(super) fn took(&mut self, started: Instant) {
        let current = self.session.tree.current;
        self.session.tree.variants[current].numbers.milliseconds =
            1e3 * started.elapsed().as_secs_f64();
    }

    /// What the page is given.
    pub(super) fn state(&self, scene: &Scene, session: &str, session_file: &str) -> StudioState {
        let tree = &self.session.tree;
        let variants = tree.variants.iter().enumerate();
        StudioState {
            schema: STUDIO_SCHEMA.to_string(),
            revision: self.revision,
            session: session.to_string(),
            session_file: session_file.to_string(),
            current: tree.current,
            undo: tree.current().parent,
            redo: tree.current().redo,
            variants: variants.map(|(id, variant)| self.variant(scene, id, variant)).collect(),
            compared: tree.compared.clone(),
            edits: tree.current().model.edits.clone(),
            limits: Limits::new(),
            catalogue: catalogue()
                .iter()
                .map(|effect| CatalogueEffect {
                    name: effect.name.clone(),
                    title: effect.title.clone(),
                    looks_like: effect.help.looks_like.clone(),
                    tell_apart: effect.help.tell_apart.clone(),
                    labels: self.labels(scene, &effect.name),
                    reason: labels(scene, effect).err().map(|error| error.problem().to_string()),
                })
                .collect(),
            laws: self
                .session
                .laws()
                .into_iter()
                .map(|law| LawView {
                    labels: self.labels(scene, &law.effect.name),
                    name: law.effect.name,
                    text: law.text,
                })
                .collect(),
            draft: self.session.draft.clone(),
            report: (*self.report).clone(),
        }
    }

    /// The report, to be kept.
    pub(super) fn report(&self) -> Report {
        (*self.report).clone()
    }

    fn variant(&self, scene: &Scene, id: usize, variant: &Variant) -> VariantView {
        let parent = variant.parent.map(|parent| &self.session.tree.variants[parent].model);
        let told = parent.zip(variant.change.as_ref());
        VariantView {
            id,
            parent: variant.parent,
            did: told
                .map_or("base model".to_string(), |(parent, change)| parent.told(scene, change)),
            effects: variant.model.labels(scene),
            numbers: variant.numbers,
        }
    }

    /// Where an effect could be added.
    fn labels(&self, scene: &Scene, name: &str) -> Vec<String> {
        let named = self.candidates.iter().filter(|candidate| candidate.effect.name == name);
        named.map(|candidate| candidate.label(scene)).collect()
    }
}

/// A law as a candidate.
pub(super) fn request(law: OwnLaw) -> EffectRequest {
    EffectRequest { effect: law.effect, body: None, fixed: Default::default() }
}

/// What results are called in a report: a number, and the effects.
fn name(session: &Session, scene: &Scene, variant: usize) -> String {
    let labels = session.tree.variants[variant].model.labels(scene);
    match labels.as_slice() {
        [] => format!("{variant}: base model"),
        labels => format!("{variant}: {}", labels.join(", ")),
    }
}

/// The report of `results`, the current one's first: of all poses, with the tests of those that the fit
/// has.
fn reported(
    scene: &Scene,
    edits: &Edits,
    fitted_poses: &Scene,
    results: &[(String, Reconstruction)],
) -> Result<Report> {
    let mut whole = report::unchecked(&edits.all_poses(scene)?, results, None, None)?;
    // That results are of edited scenes is what the studio is for.
    whole.warnings.clear();
    if !edits.marked.is_empty() {
        let tested = compare(fitted_poses, results)?.results;
        for (model, residuals) in whole.models.iter_mut().zip(tested) {
            model.residuals = residuals;
        }
    }
    Ok(whole)
}
