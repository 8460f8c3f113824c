//! From the evidence to an answer.

use super::advice::{advice, without_answer};
use super::diagnosis::{Diagnosis, Verdict};
use super::leftover::Leftover;
use super::otherwise::Otherwise;
use super::ranking::{TELLS_APART, first, probabilities, rank};
use super::rivals::{OtherLaw, Rival, lasting_push};
use super::swing::swings;
use super::told::told;
use super::unexplained::{Unexplained, clearest, unexplained};
use super::words::explanation;
use super::{Candidate, Goodness, Tried, reported, tried};
use crate::compare::channels;
use crate::reconstruct::refined::{Fitted, Instance};
use crate::{Result, Scene};

/// Firsts of a pair that are tried where one effect isn't enough.
const FIRSTS: usize = 3;
/// An effect that leaves more than this share of what the model misses doesn't explain it.
pub(super) const EXPLAINS: f64 = 0.5;
/// Where even that is ten times the noise: of a model bent so far any bend explains half.
const FAR_OFF_LEAVES: f64 = 0.05;

/// The answer for `scene`, which seems to be misread: what a candidate would do there says nothing.
pub(super) fn of_misread(scene: &Scene, fitted: &Fitted, misread: Otherwise) -> Result<Diagnosis> {
    let result = reported(scene, fitted)?;
    let channels = channels(scene, &result)?;
    let explanation =
        format!("The poses are missed by far more than their noise. {}", misread.words);
    Ok(Diagnosis {
        explanation,
        advice: vec![misread.mend.clone()],
        otherwise: Some(misread),
        ..Diagnosis::new(scene, &result, channels)
    })
}

/// The answer for `scene`, fitted, with its candidates in order. `otherwise`: what else may leave what a
/// model leaves.
pub(super) fn diagnosis(
    scene: &Scene,
    fitted: &Fitted,
    instances: Vec<Instance>,
    mut tried: Tried,
    otherwise: impl FnOnce(&Fitted, bool) -> Option<Otherwise>,
) -> Result<Diagnosis> {
    let result = reported(scene, fitted)?;
    let channels = channels(scene, &result)?;
    let before = Goodness::by(fitted, &channels);
    let mut laws = Vec::new();
    let (inflation, rest) = rank(scene, &mut tried.candidates)?;
    if first(&tried.candidates).is_some() {
        laws = tried.laws(scene, fitted, instances.len())?;
    }
    let candidates = tried.candidates;
    let first = first(&candidates);
    let stays_structured = rest.as_ref().is_some_and(Leftover::is_structured);
    laws.retain(|law| !instances.iter().any(|tried| law.is_the_law_of(tried)));
    // Far off, a law that leaves nothing needs no pair beside it: to look for one takes long.
    let law_explains =
        fitted.is_far_off() && laws.first().is_some_and(|law| law.leaves_nothing(scene));
    // Where the noise isn't known, what is left says little of a second.
    let second = match stays_structured && fitted.has_stated_noise() && !law_explains {
        true => second(scene, &candidates, &instances),
        false => None,
    };
    let weighed: Vec<&Rival> = laws
        .iter()
        .filter(|law| !first.is_some_and(|first| law.is_needless_beside(first, scene)))
        .collect();
    let (odds, none) = probabilities(&candidates, first, &weighed, inflation);
    let verdict = match (first, &rest) {
        (Some(first), Some(rest)) => {
            let good = candidates.iter().filter(|candidate| candidate.stands_out());
            let pair = second.iter().map(|(bic, _)| *bic);
            let bic = good.map(|candidate| candidate.bic).chain(pair).fold(0.0, f64::min);
            // By the usual criterion, whatever is left: to name nothing is the safer answer.
            let is_beaten = laws.iter().any(|law| law.bic < bic - TELLS_APART);
            laws.retain(|law| law.bic < bic + TELLS_APART);
            match is_beaten || (second.is_none() && !explains(first, &before, rest)) {
                true => Verdict::UnknownEffect,
                false => Verdict::Missing,
            }
        }
        _ if before.is_structured => Verdict::UnknownEffect,
        _ => Verdict::NothingMissing,
    };
    // An impact is a push that is short: it takes no part in what decides.
    let named = first.filter(|_| verdict == Verdict::Missing);
    let lasting = named.and_then(|first| lasting_push(fitted, first, instances.len()));
    laws.extend(lasting);
    laws.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    let law = laws.first().filter(|_| verdict == Verdict::UnknownEffect);
    // The best that there is for what is missing, with a name or without.
    let best = named.map(|first| &first.fitted).or(law.map(|law| &law.fitted)).unwrap_or(fitted);
    let other_laws: Vec<OtherLaw> =
        laws.iter().map(|law| law.told(scene)).collect::<Result<_>>()?;
    let leaves_more = match (named, law) {
        (None, Some(_)) => other_laws[0].leaves_more,
        (None, None) => verdict == Verdict::UnknownEffect,
        (Some(_), _) => stays_structured,
    };
    let mut diagnosis = Diagnosis {
        verdict,
        candidates: told(scene, &result, &candidates, &odds, inflation)?,
        probability_of_nothing: none,
        stays_structured,
        unexplained: left_over(scene, best, verdict, rest)?,
        other_laws,
        otherwise: otherwise(best, leaves_more),
        ..Diagnosis::new(scene, &result, channels)
    };
    let pair = second.as_ref().map(|(_, labels)| labels.as_str());
    diagnosis.explanation = explanation(&diagnosis, pair);
    diagnosis.advice = advice(scene, fitted, &diagnosis, leaves_more);
    diagnosis.advice.extend(without_answer(scene, fitted, &instances, &candidates));
    Ok(diagnosis)
}

/// What `best`, the model that explains most, leaves over; `rest`: what the best candidate leaves.
fn left_over(
    scene: &Scene,
    best: &Fitted,
    verdict: Verdict,
    rest: Option<Leftover>,
) -> Result<Vec<Unexplained>> {
    let is_structured = rest.as_ref().is_some_and(Leftover::is_structured);
    let mut left = match (best.is_far_off(), verdict) {
        (true, _) => clearest(scene, best).into_iter().collect(),
        (false, Verdict::UnknownEffect) => unexplained(scene, best)?,
        (false, _) => rest.map_or(Vec::new(), |rest| rest.unexplained),
    };
    if is_structured || verdict == Verdict::UnknownEffect {
        left.extend(swings(scene, best)?);
    }
    Ok(left)
}

/// Whether a candidate explains most of what is missed; where the noise isn't stated, most of what
/// unseen poses are missed by.
fn explains(candidate: &Candidate, before: &Goodness, rest: &Leftover) -> bool {
    let free = rest.unexplained.first().map_or(0.0, |one| one.delta_chi2);
    let gain = candidate.evidence.delta_chi2;
    let of_force = gain > EXPLAINS * (gain + free);
    let share = if candidate.fitted.is_far_off() { FAR_OFF_LEAVES } else { EXPLAINS };
    let after = rest.goodness;
    of_force
        && match (before.excess, after.excess, &candidate.held_out) {
            _ if !after.is_structured => true,
            (Some(before), Some(after), _) => after < share * before,
            (_, _, Some((before, after))) => {
                after.position_rmse_m().powi(2) < EXPLAINS * before.position_rmse_m().powi(2)
            }
            _ => false,
        }
}

/// Two effects, one of the best candidates and another, that together explain the poses to their
/// noise: their criterion and labels.
fn second(
    scene: &Scene,
    candidates: &[Candidate],
    instances: &[Instance],
) -> Option<(f64, String)> {
    let firsts = candidates.iter().filter(|candidate| candidate.stands_out());
    // What is still far off hardly needs but one.
    let firsts = firsts
        .enumerate()
        .filter(|(rank, first)| *rank == 0 || !first.fitted.is_far_off())
        .map(|(_, first)| first)
        .take(FIRSTS);
    let mut pairs: Vec<(f64, String, bool)> = Vec::new();
    for first in firsts {
        let own = first.instance().label(scene);
        let others = instances.iter().filter(|one| one.is_of_a_moment() || one.label(scene) != own);
        let seconds = tried(scene, &first.fitted, &others.cloned().collect::<Vec<_>>());
        let Some(second) = seconds.candidates.iter().find(|second| second.stands_out()) else {
            continue;
        };
        let explains = Leftover::of(scene, &second.fitted).is_ok_and(|rest| !rest.is_structured());
        let label =
            format!("{} and {}", first.instance().label(scene), second.instance().label(scene));
        pairs.push((first.bic + second.bic, label, explains));
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs.into_iter().find(|(_, _, explains)| *explains).map(|(bic, label, _)| (bic, label))
}
