//! What a diagnosis tells of its candidates.

use super::candidates::is_own;
use super::diagnosis::{CandidateReport, Shift};
use super::ranking::look_alikes;
use super::{Candidate, reported};
use crate::reconstruct::{Estimate, Reconstruction};
use crate::{Result, Scene};

/// Candidates that are told even if they don't stand out.
const FEWEST_TOLD: usize = 5;

/// The candidates that stand out, or are the user's own, and the best of the others; `odds`: each one's
/// probability. What doesn't predict better never comes first.
pub(super) fn told(
    scene: &Scene,
    result: &Reconstruction,
    candidates: &[Candidate],
    odds: &[f64],
    inflation: f64,
) -> Result<Vec<CandidateReport>> {
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    let bic = |index: usize| candidates[index].bic;
    order.sort_by(|&a, &b| odds[b].total_cmp(&odds[a]).then(bic(a).total_cmp(&bic(b))));
    order.sort_by_key(|&index| !candidates[index].stands_out());
    let count = candidates.iter().filter(|c| c.stands_out()).count().max(FEWEST_TOLD);
    let is_told =
        |(rank, index): &(usize, usize)| *rank < count || is_own(candidates[*index].instance());
    let told = order.into_iter().enumerate().filter(is_told);
    told.map(|(_, index)| report(scene, result, candidates, index, (odds[index], inflation)))
        .collect()
}

fn report(
    scene: &Scene,
    before: &Reconstruction,
    candidates: &[Candidate],
    index: usize,
    (probability, inflation): (f64, f64),
) -> Result<CandidateReport> {
    let candidate = &candidates[index];
    let after = reported(scene, &candidate.fitted)?;
    let shifts = shifts(before, &after);
    let effect = after.effects.into_iter().next_back();
    let instance = candidate.instance();
    let alike = look_alikes(candidates, index, inflation).into_iter();
    Ok(CandidateReport {
        effect: instance.effect.name.clone(),
        body: instance.body.map(|body| scene.bodies()[body].name.clone()),
        delta_chi2: candidate.evidence.delta_chi2,
        parameters_added: candidate.evidence.parameters,
        p_value: candidate.evidence.p_value,
        probability,
        stands_out: candidate.stands_out(),
        heldout_rmse_before: candidate
            .held_out
            .as_ref()
            .map(|(before, _)| before.position_rmse_m()),
        heldout_rmse_after: candidate.held_out.as_ref().map(|(_, after)| after.position_rmse_m()),
        reduced_chi2: after.fit.reduced_chi2,
        parameters: effect.map(|effect| effect.parameters).unwrap_or_default(),
        indistinguishable_from: alike
            .map(|other| candidates[other].instance().label(scene))
            .collect(),
        shifts,
        throws: None,
    })
}

/// What the mass ratio and the restitution do.
fn shifts(before: &Reconstruction, after: &Reconstruction) -> Vec<Shift> {
    let shift = |quantity: &str, before: Option<&Estimate>, after: Option<&Estimate>| {
        let (before, after) = (before?, after?);
        let (from, to) = (before.value?, after.value?);
        let in_sigma = before.std.filter(|std| *std > 0.0).map(|std| (to - from) / std);
        Some(Shift { quantity: quantity.to_string(), before: from, after: to, in_sigma })
    };
    [
        shift("mass_ratio", before.mass_ratio.as_ref(), after.mass_ratio.as_ref()),
        shift("restitution", Some(&before.restitution), Some(&after.restitution)),
    ]
    .into_iter()
    .flatten()
    .collect()
}
