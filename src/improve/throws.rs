//! The ladder of several throws together: an effect that they share is added to all, with the values
//! that all of them together say.

use std::collections::BTreeMap;

use super::{EffectEstimate, Improvement, Rung};
use crate::diagnose::{
    ExplainedThrows, NearCollisions, PooledCandidate, Throw, Verdict, alike, held_out_rmse_m,
    instances, looks, pooled, put_best_first, reduced_chi2, reported, throws, together,
    with_effect, with_own,
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
    let (improvement, throws) = improved(scenes, options, further)?;
    if improvement.verdict != Verdict::UnknownEffect {
        return Ok(improvement.told());
    }
    let without = NearCollisions::told(&throws, |rest| {
        let (again, _) = improved(rest, options, further)?;
        let sizes: Vec<String> = again.ladder.iter().filter_map(Rung::in_words).collect();
        Ok(ExplainedThrows {
            missing: again.ladder.iter().filter_map(|rung| rung.added.clone()).collect(),
            words: sizes.join(" "),
            leaves_more: again.verdict == Verdict::UnknownEffect,
        })
    });
    // What can't be asked says nothing.
    Ok(Improvement { otherwise: without.ok().flatten(), ..improvement }.told())
}

/// The improvement, not yet in words, and the throws with its effects.
fn improved<'a>(
    scenes: &'a [Scene],
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<(Improvement, Vec<Throw<'a>>)> {
    let base = throws(scenes, options)?;
    let mut throws = base.clone();
    let mut added: Vec<PooledCandidate> = Vec::new();
    let mut ladder = vec![rung(&throws)?];
    for _ in 0..MOST_EFFECTS {
        let mut candidates = pooled(&throws, &instances(&throws, further)?);
        let Some(_) = put_best_first(&throws, &mut candidates)? else { break };
        let best = candidates[0].clone();
        let look_alikes = alike(&candidates, &best).map(effect).collect();
        added.push(best);
        settle(&base, &mut added)?;
        throws = with_all(&base, &added)?;
        let best = &added[added.len() - 1];
        let next = rung(&throws)?.adding(effect(best), look_alikes);
        ladder.push(Rung { p_value: Some(candidates[0].p_value), ..next });
        if best.is_apart() {
            break;
        }
    }
    let settings: Vec<String> = added.iter().filter_map(|added| setting(&base, added)).collect();
    for (index, rung) in ladder.iter_mut().enumerate() {
        rung.with = settings[..index.min(settings.len())].to_vec();
        if let Some(index) = index.checked_sub(1) {
            rung.parameters = effect(&added[index]).parameters;
            rung.is_shared = added[index].is_shared;
        }
    }
    // What was added later is there already.
    let labels: Vec<String> = added.iter().map(|added| added.label.clone()).collect();
    for rung in &mut ladder {
        rung.indistinguishable_from.retain(|label| !labels.contains(label));
        rung.look_alikes.retain(|other| !labels.contains(&other.effect));
    }
    let (_, is_structured) = looks(&throws)?;
    let verdict = match (ladder.len() > 1, is_structured) {
        (_, true) => Verdict::UnknownEffect,
        (true, false) => Verdict::Missing,
        (false, false) => Verdict::NothingMissing,
    };
    let result = reported(throws[0].scene, &throws[0].fitted)?;
    let own = added.iter().try_fold(base, |own, added| with_own(&own, added));
    let together = own.map_or(Ok(Vec::new()), |own| together(&own))?;
    let scene = throws[0].scene;
    let improvement = Improvement { verdict, together, ..Improvement::new(scene, ladder, result) };
    Ok((improvement, throws))
}

/// Gives each effect the values that all throws say of it with those of the others, in turn: what was
/// added first had been estimated without the last. Each new effect brings another round.
fn settle(base: &[Throw], added: &mut [PooledCandidate]) -> Result<()> {
    if added.len() == 1 {
        return Ok(());
    }
    for index in 0..added.len() {
        if !added[index].is_shared {
            continue;
        }
        let others = added.iter().enumerate().filter(|(other, _)| *other != index);
        let others: Vec<PooledCandidate> = others.map(|(_, other)| other.clone()).collect();
        let throws = with_all(base, &others)?;
        let own = added[index].own.iter().map(|own| own.iter().map(|own| own.instance.clone()));
        let mut again = pooled(&throws, &own.map(Iterator::collect).collect::<Vec<_>>());
        put_best_first(&throws, &mut again)?;
        added[index] = match again.pop() {
            Some(again) if again.is_shared && again.is_possible => again,
            _ => continue,
        };
    }
    Ok(())
}

/// The throws with these effects more, each with what all throws say of it.
fn with_all<'a>(base: &[Throw<'a>], effects: &[PooledCandidate]) -> Result<Vec<Throw<'a>>> {
    effects.iter().try_fold(base.to_vec(), |throws, effect| with_effect(&throws, effect))
}

/// What `--with` takes for a candidate in each throw.
fn setting(throws: &[Throw], added: &PooledCandidate) -> Option<String> {
    let held = (0..throws.len()).find_map(|index| added.held(index))?;
    Some(in_request(&added.label, &held))
}

/// How large a candidate is in all throws, if it is the same in all.
fn effect(candidate: &PooledCandidate) -> EffectEstimate {
    let parameters = match candidate.is_shared {
        true => candidate.parameters(),
        false => BTreeMap::new(),
    };
    EffectEstimate { effect: candidate.label.clone(), parameters }
}

/// `NAME@BODY:k=0.03`.
fn in_request(label: &str, held: &Instance) -> String {
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
fn rung(throws: &[Throw]) -> Result<Rung> {
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
        orientation_rmse: rms(results.iter().map(|r| r.fit.orientation_rmse).collect()),
        reduced_chi2: reduced_chi2(throws),
        heldout_position_rmse: rms(throws.iter().map(|t| held_out_rmse_m(&t.fitted)).collect()),
        ..Rung::of(position.unwrap_or(0.0))
    })
}
