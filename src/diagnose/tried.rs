//! Every effect on top of a model: those that its slopes favour first, and where that has lost its way,
//! from flights alone.

use rayon::prelude::*;

use super::candidates::{candidate, promising};
use super::rivals::{Rival, rivals};
use super::{Candidate, Goodness, HeldOut};
use crate::reconstruct::refined::{Fitted, HOPELESS, Instance, Loose};
use crate::{Result, Scene};

/// What was tried on top of a model.
pub(crate) struct Tried {
    /// All candidates that can be fitted, the best first by Schwarz's criterion.
    pub(crate) candidates: Vec<Candidate>,
    /// Laws that the catalogue hasn't got, as [`rivals()`] finds them; `None` where nobody asked yet.
    laws: Option<Vec<Rival>>,
}

impl Tried {
    /// As [`rivals()`], but found once.
    pub(crate) fn laws(
        &mut self,
        scene: &Scene,
        fitted: &Fitted,
        tried: usize,
    ) -> Result<Vec<Rival>> {
        match self.laws.take() {
            Some(laws) => Ok(laws),
            None => rivals(scene, fitted, tried),
        }
    }
}

/// Tries all `instances` on top of `fitted`.
pub(crate) fn tried(scene: &Scene, fitted: &Fitted, instances: &[Instance]) -> Tried {
    let before = HeldOut::of(fitted, fitted.collision_time_s());
    // A score test that fails leaves all to be refitted.
    let likely = promising(scene, fitted, instances).unwrap_or_else(|_| instances.to_vec());
    let judged = |with| candidate(scene, fitted, with, instances.len(), before.as_ref());
    let refitted = |chosen: &[Instance]| -> Vec<Candidate> {
        let refitted = chosen
            .par_iter()
            .filter_map(|instance| judged(fitted.with_at_once(scene, instance).ok()?));
        refitted.collect()
    };
    let mut candidates = refitted(&likely);
    // Far from the null slopes foretell little: where none of these will do, another may, and where
    // the model is bent far, another may do better.
    let is_structured = |candidate: &Candidate| Goodness::by(&candidate.fitted, &[]).is_structured;
    if fitted.is_far_off() || candidates.iter().all(is_structured) {
        let others = instances.iter().filter(|instance| !likely.contains(instance));
        candidates.extend(refitted(&others.cloned().collect::<Vec<_>>()));
    }
    let mut laws = None;
    // It takes most of a diagnosis' time, and is needless beside what leaves nothing.
    if fitted.is_lost() && candidates.iter().all(is_structured) {
        let found = rivals(scene, fitted, instances.len()).unwrap_or_default();
        candidates = followed(scene, fitted, candidates, found.first(), judged);
        laws = Some(found);
    }
    candidates.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    Tried { candidates, laws }
}

/// The candidates on top of `fitted`, which has lost its way, with what else is found of each. `law`: the
/// best that the catalogue hasn't got.
fn followed(
    scene: &Scene,
    fitted: &Fitted,
    candidates: Vec<Candidate>,
    law: Option<&Rival>,
    judged: impl Fn(Fitted) -> Option<Candidate> + Sync,
) -> Vec<Candidate> {
    // Beside a law that leaves nothing only what it holds as a special case is of interest.
    let law = law.filter(|law| law.leaves_nothing(scene));
    let is_of_interest = |candidate: &Candidate| law.is_none_or(|law| law.holds(candidate, scene));
    let loosely = |candidate: Candidate| {
        let loose = is_of_interest(&candidate).then(|| fitted.loosely(scene, &candidate.fitted));
        (candidate, loose.flatten())
    };
    let mut all: Vec<(Candidate, Option<Loose>)> =
        candidates.into_par_iter().map(loosely).collect();
    let cost = |loose: &Option<Loose>| loose.as_ref().map_or(f64::INFINITY, |loose| loose.cost);
    all.sort_by(|(_, a), (_, b)| cost(a).total_cmp(&cost(b)));
    let again = |(candidate, loose): &(Candidate, Option<Loose>), most: f64| {
        let loose = loose.as_ref().filter(|loose| loose.cost < most);
        let with =
            loose.and_then(|loose| fitted.again_quickly(candidate.fitted.clone(), loose).ok());
        with.and_then(&judged).unwrap_or_else(|| candidate.clone())
    };
    let Some((first, others)) = all.split_first() else { return Vec::new() };
    let first = again(first, f64::INFINITY);
    // Where the noise isn't stated each has its own, and costs can't be compared. Where the first leaves more
    // than noise a difference counts for less: twice its cost is worse in any case.
    let most = match fitted.has_stated_noise() {
        true => first.fitted.chi2() + HOPELESS,
        false => f64::INFINITY,
    };
    let others = others.par_iter().map(|other| again(other, most));
    std::iter::once(first).chain(others.collect::<Vec<_>>()).collect()
}
