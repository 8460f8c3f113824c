//! Probabilities of the candidates, and which of them can't be told apart.

use super::Candidate;
use super::dependence::{inflation_of, quasi_bic};
use super::leftover::Leftover;
use super::misses::{Misses, most_counted};
use super::rivals::Rival;
use crate::{Result, Scene};

/// Odds of a hundred and fifty to one and more tell two candidates apart, very strong evidence (Kass &
/// Raftery, *Bayes Factors*, 1995): the best of some twenty is there by luck, too.
pub(crate) const TELLS_APART: f64 = 10.0;

/// The probability of each candidate, of which `first` is the best, and that of none, by Schwarz's
/// criterion and equal odds beforehand, also of `rivals`; its differences count for less by
/// `inflation`.
pub(super) fn probabilities(
    candidates: &[Candidate],
    first: Option<&Candidate>,
    rivals: &[&Rival],
    inflation: f64,
) -> (Vec<f64>, f64) {
    let of_laws = rivals.iter().map(|law| quasi_bic(law.bic, law.evidence.delta_chi2, inflation));
    let against_none = |one: &Candidate| match first {
        // The first stays it, also where another with fewer parameters is as good.
        Some(first) => quasi(first, inflation) + behind(one, first, inflation).max(0.0),
        None => quasi(one, inflation),
    };
    let own: Vec<f64> = candidates.iter().map(against_none).collect();
    let all = own.iter().copied().chain(of_laws);
    let least = all.clone().fold(0.0, f64::min);
    let weight = |bic: f64| (-0.5 * (bic - least)).exp();
    let none = weight(0.0);
    let total: f64 = none + all.map(weight).sum::<f64>();
    (own.iter().map(|bic| weight(*bic) / total).collect(), none / total)
}

/// By how much Schwarz's criterion of `one` is worse than that of `other`, where differences count for
/// less by `inflation`: there something is left that none explains, and they count for no more than they
/// are sure to.
fn behind(one: &Candidate, other: &Candidate, inflation: f64) -> f64 {
    let by_parameters =
        (one.bic + one.evidence.delta_chi2) - (other.bic + other.evidence.delta_chi2);
    let missed = other.evidence.delta_chi2 - one.evidence.delta_chi2;
    // Single poses are all that is to be said of what happens at one moment.
    let is_of_poses = ![one, other].iter().any(|candidate| candidate.instance().is_of_a_moment());
    let most = match inflation > 1.0 && is_of_poses {
        true => most_counted(&[&Misses::of(&other.fitted)], &[&Misses::of(&one.fitted)]),
        false => f64::INFINITY,
    };
    by_parameters + (missed / inflation).clamp(-most, most)
}

/// Schwarz's criterion, where differences count for less by `inflation`.
pub(crate) fn quasi(candidate: &Candidate, inflation: f64) -> f64 {
    quasi_bic(candidate.bic, candidate.evidence.delta_chi2, inflation)
}

/// The first that stands out.
pub(super) fn first(candidates: &[Candidate]) -> Option<&Candidate> {
    candidates.iter().find(|candidate| candidate.stands_out())
}

/// Puts the most probable first. Returns by how much differences count for less, by what the best fit
/// leaves over, and what the first leaves over.
pub(super) fn rank(scene: &Scene, candidates: &mut [Candidate]) -> Result<(f64, Option<Leftover>)> {
    let left_over = |candidates: &[Candidate]| {
        first(candidates).map(|first| Leftover::of(scene, &first.fitted)).transpose()
    };
    candidates.sort_by(|a, b| a.bic.total_cmp(&b.bic));
    let rest = left_over(candidates)?;
    let Some((first, rest)) = first(candidates).zip(rest) else { return Ok((1.0, None)) };
    let inflation = inflation_of(&first.fitted, &rest);
    if inflation == 1.0 {
        return Ok((inflation, Some(rest)));
    }
    candidates.sort_by(|a, b| quasi(a, inflation).total_cmp(&quasi(b, inflation)));
    Ok((inflation, left_over(candidates)?))
}

/// The places of the candidates that the data can't tell from number `index`, where differences count
/// for less by `inflation`.
pub(crate) fn look_alikes(candidates: &[Candidate], index: usize, inflation: f64) -> Vec<usize> {
    let own = &candidates[index];
    let is_alike = |other: &usize| {
        *other != index
            && candidates[*other].stands_out() == own.stands_out()
            && behind(&candidates[*other], own, inflation).abs() < TELLS_APART
    };
    (0..candidates.len()).filter(is_alike).collect()
}
