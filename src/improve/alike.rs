//! What the poses can't tell from an effect of the ladder, with all its other effects there.

use super::EffectEstimate;
use super::search::Step;
use crate::diagnose::{
    Candidate, HeldOut, Leftover, all_candidates, candidate, inflation_of, look_alikes, reported,
};
use crate::reconstruct::refined::{Fitted, Instance};
use crate::{Result, Scene};

/// What may be in the place of step `index`, of those that were alike when it was added. `base`: without
/// any step.
pub(super) fn alike(
    scene: &Scene,
    base: &Fitted,
    steps: &[Step],
    index: usize,
) -> Result<Vec<EffectEstimate>> {
    let step = &steps[index];
    let is_there = |instance: &Instance| {
        let mut labels = steps.iter().map(|step| step.instance.label(scene));
        labels.any(|label| label == instance.label(scene))
    };
    let others: Vec<&Instance> =
        step.look_alikes.iter().filter(|instance| !is_there(instance)).collect();
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let mut without = base.clone();
    for (_, other) in steps.iter().enumerate().filter(|(other, _)| *other != index) {
        without = without.with(scene, &other.instance)?;
    }
    let tried = all_candidates(scene, &without, &[])?.len();
    let before = HeldOut::of(&without, without.collision_time_s());
    let fitted = |instance: &Instance| -> Option<Candidate> {
        // What can't be flown with the others doesn't do as well.
        let with = without.with(scene, instance).ok()?;
        candidate(scene, &without, with, tried, before.as_ref())
    };
    let Some(own) = fitted(&step.instance) else { return Ok(Vec::new()) };
    let inflation = inflation_of(&own.fitted, &Leftover::of(scene, &own.fitted)?);
    let others = others.into_iter().filter_map(fitted);
    let candidates: Vec<Candidate> = std::iter::once(own).chain(others).collect();
    let alike = look_alikes(&candidates, 0, inflation).into_iter();
    let estimates = alike.map(|index| {
        let candidate = &candidates[index];
        let result = reported(scene, &candidate.fitted)?;
        let parameters = result.effects.into_iter().next_back().map(|effect| effect.parameters);
        Ok(EffectEstimate {
            effect: candidate.instance().label(scene),
            parameters: parameters.unwrap_or_default(),
        })
    });
    estimates.collect()
}
