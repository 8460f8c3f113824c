//! The effects that a scene could show, each fitted on top of a model.

use super::FALSE_ALARM;
use super::evidence::{Evidence, evidence};
use super::held_out::Tangent;
use crate::effect::{EffectRequest, catalogue};
use crate::reconstruct::refined::{Fitted, Instance, instances, points, possible};
use crate::{Result, Scene};

/// A model with one effect more, and what speaks for it.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    pub(crate) fitted: Fitted,
    pub(crate) evidence: Evidence,
    /// Against none: the smaller, the better; −2 ln of the odds but for a constant.
    pub(crate) bic: f64,
    /// Root mean square of predicted positions, m, without and with the effect.
    pub(crate) held_out_m: Option<[f64; 2]>,
}

impl Candidate {
    /// The effect that it adds.
    pub(crate) fn instance(&self) -> &Instance {
        &self.fitted.acting[self.fitted.acting.len() - 1].instance
    }

    /// Whether the evidence is strong, and the effect predicts what it hasn't seen.
    pub(crate) fn stands_out(&self) -> bool {
        let predicts = self.held_out_m.is_none_or(|[without, with]| with < without);
        self.evidence.p_value < FALSE_ALARM && self.bic < 0.0 && predicts
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
    Ok(all)
}

/// What speaks for `with`, which has one effect more than `without`; `None` where the data don't
/// depend on the effect. `tried`: how many candidates there are.
pub(super) fn candidate(
    scene: &Scene,
    without: &Fitted,
    with: Fitted,
    tried: usize,
    tangent: Option<&Tangent>,
) -> Option<Candidate> {
    let instance = &with.acting.last()?.instance;
    let scanned = points(scene, instance).len().max(1);
    let evidence = evidence(without, &with, scanned, tried)?;
    let bic = evidence.bic(with.numbers(), instance.is_of_a_pose().then_some(scanned));
    let held_out_m = tangent.and_then(|before| {
        let after = Tangent::of(&with)?;
        Some([before.held_out_rmse_m()?, after.held_out_rmse_m()?])
    });
    Some(Candidate { fitted: with, evidence, bic, held_out_m })
}
