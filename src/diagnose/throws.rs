//! The diagnosis of several throws together.

use rayon::prelude::*;

use super::advice::known_effects;
use super::best_of_throws::{Best, put_best_first, with_own};
use super::candidates::is_own;
use super::diagnosis::{CandidateReport, DIAGNOSIS_SCHEMA, Diagnosis, Verdict};
use super::near_collisions::{ExplainedThrows, NearCollisions};
use super::pooled::{PooledCandidate, Throw, pooled};
use super::throws_in_words::explanation_of_throws;
use super::throws_told::{advice, report};
use super::together::together;
use super::verdict::EXPLAINS;
use super::{Goodness, all_candidates, held_out_rmse_m, reported};
use crate::compare::{ChannelTest, channels};
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::{self, Instance};
use crate::words::quoted;
use crate::{Error, ErrorKind, Result, Scene};

/// Candidates that are told even if they don't stand out.
const FEWEST_TOLD: usize = 5;
/// Of so many throws one may fail by chance, or by a fault of its own.
const MANY: usize = 4;

/// Finds which effect is missing from the models of several throws of the same objects: as
/// [`super::diagnose`], with the parameters of an effect the same in all; but for impulses of third
/// parties at the collision, which are each throw's own. What happens to single poses or at other
/// moments isn't looked for.
///
/// # Errors
/// A scene can't be reconstructed, or an effect doesn't fit it; the message names the scene.
pub fn diagnose_throws(
    scenes: &[Scene],
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<Diagnosis> {
    let (diagnosis, throws) = diagnosed(scenes, options, further)?;
    let leaves_more = diagnosis.stays_structured || diagnosis.verdict == Verdict::UnknownEffect;
    let without = leaves_more.then(|| {
        NearCollisions::told(&throws, |rest| {
            let (again, _) = diagnosed(rest, options, further)?;
            let missing = again.missing();
            Ok(ExplainedThrows {
                missing: missing.map(CandidateReport::label).into_iter().collect(),
                words: String::new(),
                leaves_more: again.stays_structured || again.verdict == Verdict::UnknownEffect,
            })
        })
    });
    // What can't be asked says nothing.
    let otherwise = without.and_then(|told| told.ok().flatten());
    let mut diagnosis = Diagnosis { otherwise, ..diagnosis };
    diagnosis.explanation = explanation_of_throws(&diagnosis, scenes.len());
    diagnosis.advice.extend(diagnosis.otherwise.iter().map(|otherwise| otherwise.mend.clone()));
    Ok(diagnosis)
}

/// The diagnosis, without words and what else it may be, and the throws with the best effect.
fn diagnosed<'a>(
    scenes: &'a [Scene],
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<(Diagnosis, Vec<Throw<'a>>)> {
    let throws = throws(scenes, options)?;
    let instances = instances(&throws, further)?;
    let mut candidates = pooled(&throws, &instances);
    let (channels, is_structured) = looks(&throws)?;
    let best = put_best_first(&throws, &mut candidates)?;
    let stays_structured = best.as_ref().is_some_and(|best| best.is_structured);
    let explains = |best: &Best| misses_m2(&best.throws) < EXPLAINS * misses_m2(&throws);
    let verdict = match &best {
        Some(best) if !stays_structured || explains(best) => Verdict::Missing,
        Some(_) => Verdict::UnknownEffect,
        None if is_structured => Verdict::UnknownEffect,
        None => Verdict::NothingMissing,
    };
    let against_none = |candidate: &PooledCandidate| match best {
        Some(_) => candidates[0].bic + candidate.behind(&candidates[0]).max(0.0),
        None => candidate.bic,
    };
    let bics: Vec<f64> = candidates.iter().map(against_none).collect();
    let least = bics.iter().copied().fold(0.0, f64::min);
    let weight = |bic: f64| (-0.5 * (bic - least)).exp();
    let total: f64 = weight(0.0) + bics.iter().copied().map(weight).sum::<f64>();
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| bics[a].total_cmp(&bics[b]));
    order.sort_by_key(|&index| (best.is_none() || index > 0, !candidates[index].stands_out()));
    let told = candidates.iter().filter(|c| c.stands_out()).count().max(FEWEST_TOLD);
    let is_own_law = |candidate: &PooledCandidate| {
        candidate.own.iter().flatten().next().is_some_and(|own| is_own(&own.instance))
    };
    let is_told = |(rank, index): &(usize, usize)| *rank < told || is_own_law(&candidates[*index]);
    let reports = order
        .iter()
        .copied()
        .enumerate()
        .filter(is_told)
        .filter_map(|(_, index)| report(&throws, &candidates, index, weight(bics[index]) / total))
        .collect();
    let names: Vec<String> = scenes.iter().map(|scene| scene.name().to_string()).collect();
    let mut diagnosis = Diagnosis {
        schema: DIAGNOSIS_SCHEMA.to_string(),
        scene: names.join(", "),
        verdict,
        model: Vec::new(),
        channels,
        reduced_chi2: reduced_chi2(&throws),
        candidates: reports,
        probability_of_nothing: weight(0.0) / total,
        stays_structured,
        unexplained: Vec::new(),
        other_laws: Vec::new(),
        otherwise: None,
        together: match verdict {
            Verdict::Missing => match with_own(&throws, &candidates[0]) {
                Some(own) => together(&own)?,
                None => Vec::new(),
            },
            _ => together(&throws)?,
        },
        explanation: String::new(),
        advice: Vec::new(),
    };
    let known = known_effects(throws[0].scene, &throws[0].fitted);
    diagnosis.advice = advice(&diagnosis, &known);
    Ok((diagnosis, best.map_or(throws, |best| best.throws)))
}

/// Each scene fitted by the model of `options`.
pub(crate) fn throws<'a>(scenes: &'a [Scene], options: &RefinedOptions) -> Result<Vec<Throw<'a>>> {
    if scenes.is_empty() {
        return Err(Error::new(ErrorKind::Invalid, "there is no scene").mend("give one or more"));
    }
    refuse_copies(scenes)?;
    scenes
        .par_iter()
        .map(|scene| {
            let fitted = refined::fit(scene, options)
                .map_err(|error| error.in_file(scene.name().to_string()))?;
            Ok(Throw { scene, fitted })
        })
        .collect()
}

/// The same poses twice would count as two throws that agree.
fn refuse_copies(scenes: &[Scene]) -> Result<()> {
    let mut known: Vec<(String, &str)> = Vec::new();
    for scene in scenes {
        let fingerprint = scene.fingerprint();
        if let Some((_, other)) = known.iter().find(|(known, _)| *known == fingerprint) {
            let problem =
                format!("{} and {} hold the same poses", quoted(other), quoted(scene.name()));
            return Err(Error::new(ErrorKind::Invalid, problem)
                .mend("give each throw once: a copy would count as further evidence"));
        }
        known.push((fingerprint, scene.name()));
    }
    Ok(())
}

/// The sum of the mean squares by which unseen positions are missed, m².
fn misses_m2(throws: &[Throw]) -> f64 {
    throws.iter().filter_map(|throw| held_out_rmse_m(&throw.fitted)).map(|rmse| rmse * rmse).sum()
}

/// The candidates of each throw.
pub(crate) fn instances(throws: &[Throw], further: &[EffectRequest]) -> Result<Vec<Vec<Instance>>> {
    throws.iter().map(|throw| all_candidates(throw.scene, &throw.fitted, further)).collect()
}

/// How the residuals of all throws look, and whether they are more than noise.
pub(crate) fn looks(throws: &[Throw]) -> Result<(Vec<ChannelTest>, bool)> {
    let mut all = Vec::new();
    let mut structured = 0;
    for throw in throws {
        let own = channels(throw.scene, &reported(throw.scene, &throw.fitted)?)?;
        structured += usize::from(Goodness::by(&throw.fitted, &own).is_structured);
        all.extend(own);
    }
    Ok((all, structured * MANY > throws.len()))
}

pub(crate) fn reduced_chi2(throws: &[Throw]) -> Option<f64> {
    let stated = throws.iter().all(|throw| throw.fitted.has_stated_noise());
    let chi2: f64 = throws.iter().map(|throw| throw.fitted.chi2()).sum();
    let spare: f64 = throws.iter().map(|throw| throw.fitted.numbers() - throw.fitted.used()).sum();
    (stated && spare > 0.0).then(|| chi2 / spare)
}
