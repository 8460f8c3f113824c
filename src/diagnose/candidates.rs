//! The effects that a scene could show, each fitted on top of a model.

use super::FALSE_ALARM;
use super::evidence::{Evidence, evidence};
use super::held_out::HeldOut;
use crate::effect::{EffectRequest, Hook, Scan, Scope, catalogue};
use crate::reconstruct::refined::{Fitted, Instance, gains, instances, points, possible, scanned};
use crate::{Result, Scene};

/// Candidates that are refitted in any case, the best by score.
const FEWEST_REFITTED: usize = 6;
/// A candidate whose score is less than this share of the best one's isn't refitted.
const WORTH: f64 = 0.2;

/// A model with one effect more, and what speaks for it.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub(crate) fitted: Fitted,
    pub(crate) evidence: Evidence,
    /// Against none: the smaller, the better; −2 ln of the odds but for a constant.
    pub(crate) bic: f64,
    /// How poses are predicted without and with the effect.
    pub(crate) held_out: Option<(HeldOut, HeldOut)>,
    /// Whether they are predicted better with it, positions and orientations together.
    pub(crate) predicts: bool,
}

impl Candidate {
    /// The effect that it adds.
    pub(crate) fn instance(&self) -> &Instance {
        &self.fitted.acting[self.fitted.acting.len() - 1].instance
    }

    /// Whether the evidence is strong, and the effect predicts what it hasn't seen.
    pub(crate) fn stands_out(&self) -> bool {
        self.evidence.p_value < FALSE_ALARM && self.bic < 0.0 && self.predicts
    }
}

/// Every effect of the catalogue and of `further` on every body that `scene` can show it on; but not
/// twice what the model has, unless it is of single poses or moments.
pub(crate) fn all_candidates(
    scene: &Scene,
    fitted: &Fitted,
    further: &[EffectRequest],
) -> Result<Vec<Instance>> {
    let mut all: Vec<Instance> =
        catalogue().iter().flat_map(|effect| possible(scene, effect)).collect();
    for request in further {
        all.extend(instances(scene, request)?);
    }
    let is_new = |instance: &Instance| {
        let known = |acting: &&crate::reconstruct::refined::Acting| {
            acting.instance.effect.name == instance.effect.name
                && acting.instance.body == instance.body
        };
        instance.is_of_a_moment() || !fitted.acting.iter().any(|acting| known(&acting))
    };
    all.retain(is_new);
    // Of two clocks only the difference can be seen: body a's is the reference.
    let is_reference_clock = |instance: &Instance| {
        let moves_time = instance.effect.laws.iter().any(|(hook, _)| *hook == Hook::Time);
        moves_time && scene.bodies().len() == 2 && instance.body == Some(0)
    };
    all.retain(|instance| !is_reference_clock(instance));
    Ok(all)
}

/// Those of `instances` that are worth a refit: by the score test they explain much of what the best
/// does, or may by chance.
pub(super) fn promising(
    scene: &Scene,
    fitted: &Fitted,
    instances: &[Instance],
) -> Result<Vec<Instance>> {
    let is_scanned = |instance: &Instance| {
        matches!(instance.scan(), Some((Scan::ObservationTimes | Scan::GapTimes, _)))
    };
    let (scans, others): (Vec<usize>, Vec<usize>) =
        (0..instances.len()).partition(|&index| is_scanned(&instances[index]));
    let tests: Vec<(Instance, Vec<f64>)> =
        others.iter().map(|&i| (instances[i].clone(), instances[i].null())).collect();
    let mut scores = vec![f64::NEG_INFINITY; instances.len()];
    for (&index, gain) in others.iter().zip(gains(fitted, &tests)?) {
        scores[index] = gain.chi2;
    }
    for index in scans {
        let scanned = scanned(fitted, scene, &instances[index])?;
        scores[index] = scanned.iter().map(|scanned| scanned.gain).fold(0.0, f64::max);
    }
    for (score, instance) in scores.iter_mut().zip(instances) {
        *score -= fitted.numbers().ln() * instance.null().len() as f64;
    }
    let mut order: Vec<usize> = (0..instances.len()).collect();
    order.sort_by(|a, b| scores[*b].total_cmp(&scores[*a]));
    let best = scores[order[0]];
    let is_worth_it = |(rank, index): (usize, &usize)| {
        rank < FEWEST_REFITTED
            || scores[*index] > WORTH * best.max(0.0)
            // What is strong at the contact bends the model without it too far for slopes to tell.
            || instances[*index].effect.scope == Scope::Contact
            || is_own(&instances[*index])
    };
    let kept = order.iter().enumerate().filter(|(rank, index)| is_worth_it((*rank, index)));
    Ok(kept.map(|(_, index)| instances[*index].clone()).collect())
}

/// Whether it is a user's own law: who asks for it gets an answer.
pub(super) fn is_own(instance: &Instance) -> bool {
    !catalogue().contains(&instance.effect)
}

/// What the criterion of a body's effect is worse by than that of the scene's: next to nothing, so that
/// of two that are the same by construction, as a lone body's scale of depth and that of gravity, the
/// more general comes first.
pub(crate) fn of_a_body(instance: &Instance) -> f64 {
    if instance.body.is_some() { 0.1 } else { 0.0 }
}

/// What speaks for `with`, which has one effect more than `without`; `None` where the data don't
/// depend on the effect. `tried`: how many candidates there are.
pub(crate) fn candidate(
    scene: &Scene,
    without: &Fitted,
    with: Fitted,
    tried: usize,
    before: Option<&HeldOut>,
) -> Option<Candidate> {
    let instance = &with.acting.last()?.instance;
    let scanned = points(scene, instance).len().max(1);
    let evidence = evidence(without, &with, scanned, tried)?;
    let bic = evidence.bic(with.numbers(), instance.is_of_a_pose().then_some(scanned))
        + of_a_body(instance);
    let held_out = before.cloned().zip(HeldOut::of(&with, without.collision_time_s()));
    // What happens at one moment can't be told from the other poses.
    let predicts = instance.is_of_a_moment()
        || held_out.as_ref().is_none_or(|(before, after)| after.gain_on(before) > 0.0);
    Some(Candidate { fitted: with, evidence, bic, held_out, predicts })
}
