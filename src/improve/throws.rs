//! The ladder of several throws together: an effect that they share is added to all, with the values
//! that all of them together say.

use std::collections::BTreeMap;

use super::{EffectEstimate, Improvement, Rung};
use crate::diagnose::{
    PooledCandidate, Throw, Verdict, alike, held_out_rmse_m, instances, looks, pooled,
    put_best_first, reduced_chi2, reported, throws, together, with_own,
};
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::Instance;
use crate::{Reconstruction, Result, Scene};

/// Effects that throws can share and still be told apart.
const MOST_EFFECTS: usize = 4;

/// Improves the models of several throws of the same objects: as [`super::improve`], with the
/// parameters of each effect the same in all.
///
/// # Errors
/// As [`crate::diagnose::diagnose_throws`].
pub fn improve_throws(
    scenes: &[Scene],
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<Improvement> {
    let mut throws = throws(scenes, options)?;
    let mut own = Some(throws.clone());
    let mut ladder = vec![rung(&throws, Vec::new())?];
    for _ in 0..MOST_EFFECTS {
        let mut candidates = pooled(&throws, &instances(&throws, further)?);
        let Some(best) = put_best_first(&throws, &mut candidates)? else { break };
        let added = &candidates[0];
        let is_last = added.is_apart();
        let setting = (0..throws.len()).find_map(|index| added.held(index));
        let setting = setting.map(|held| with_values(&added.label, &held));
        let look_alikes = alike(&candidates, added).map(effect).collect();
        throws = best.throws;
        own = own.and_then(|own| with_own(&own, added));
        let known = ladder.last().map(|rung: &Rung| rung.with.clone()).unwrap_or_default();
        let with: Vec<String> = known.into_iter().chain(setting).collect();
        let next = rung(&throws, with)?.adding(effect(added), look_alikes);
        ladder.push(Rung { p_value: Some(added.p_value), ..next });
        if is_last {
            break;
        }
    }
    let (_, is_structured) = looks(&throws)?;
    let verdict = match (ladder.len() > 1, is_structured) {
        (_, true) => Verdict::UnknownEffect,
        (true, false) => Verdict::Missing,
        (false, false) => Verdict::NothingMissing,
    };
    let result = reported(throws[0].scene, &throws[0].fitted)?;
    let together = own.map_or(Ok(Vec::new()), |own| together(&own))?;
    let scene = throws[0].scene;
    Ok(Improvement { together, ..Improvement::new(scene, verdict, ladder, Vec::new(), result) })
}

/// How large a candidate is in all throws.
fn effect(candidate: &PooledCandidate) -> EffectEstimate {
    EffectEstimate { effect: candidate.label.clone(), parameters: candidate.parameters() }
}

/// `NAME@BODY:k=0.03`: what `--with` takes for each throw.
fn with_values(label: &str, held: &Instance) -> String {
    let one = |(name, values): (&String, &Vec<f64>)| match values.as_slice() {
        [single] => format!("{name}={single}"),
        all => {
            let all: Vec<String> = all.iter().map(f64::to_string).collect();
            format!("{name}=[{}]", all.join(","))
        }
    };
    let settings: Vec<String> = held.fixed.iter().map(one).collect();
    if settings.is_empty() {
        return label.to_string();
    }
    format!("{label}:{}", settings.join(","))
}

/// A rung, over the poses of all throws.
fn rung(throws: &[Throw], with: Vec<String>) -> Result<Rung> {
    let results: Vec<Reconstruction> =
        throws.iter().map(|throw| reported(throw.scene, &throw.fitted)).collect::<Result<_>>()?;
    let poses: Vec<f64> = throws
        .iter()
        .map(|throw| throw.fitted.refined.bodies.iter().map(|body| body.poses.len() as f64).sum())
        .collect();
    let rms = |values: Vec<Option<f64>>| -> Option<f64> {
        let known =
            values.iter().zip(&poses).filter_map(|(value, count)| Some((value.as_ref()?, count)));
        let (count, squares) = known.fold((0.0, 0.0), |(count, squares), (value, poses)| {
            (count + poses, squares + poses * value * value)
        });
        (count > 0.0).then(|| (squares / count).sqrt())
    };
    let position = rms(results.iter().map(|result| Some(result.fit.position_rmse)).collect());
    Ok(Rung {
        added: None,
        with,
        p_value: None,
        parameters: BTreeMap::new(),
        indistinguishable_from: Vec::new(),
        look_alikes: Vec::new(),
        position_rmse: position.unwrap_or(0.0),
        orientation_rmse: rms(results.iter().map(|r| r.fit.orientation_rmse).collect()),
        reduced_chi2: reduced_chi2(throws),
        heldout_position_rmse: rms(throws.iter().map(|t| held_out_rmse_m(&t.fitted)).collect()),
        mass_ratio: None,
        restitution: None,
    })
}
