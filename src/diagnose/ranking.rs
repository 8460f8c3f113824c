//! Probabilities of the candidates, and which of them can't be told apart.

use super::Candidate;

/// Odds of twenty to one and more tell two candidates apart (Kass & Raftery, *Bayes Factors*, 1995).
const TELLS_APART: f64 = 6.0;

/// The probability of each candidate, and that of none, by Schwarz's criterion and equal odds
/// beforehand.
pub(super) fn probabilities(candidates: &[Candidate]) -> (Vec<f64>, f64) {
    let least = candidates.iter().map(|c| c.bic).fold(0.0, f64::min);
    let weight = |bic: f64| (-0.5 * (bic - least)).exp();
    let none = weight(0.0);
    let total: f64 = none + candidates.iter().map(|c| weight(c.bic)).sum::<f64>();
    (candidates.iter().map(|c| weight(c.bic) / total).collect(), none / total)
}

/// The places of the candidates that the data can't tell from number `index`.
pub(crate) fn look_alikes(candidates: &[Candidate], index: usize) -> Vec<usize> {
    let own = &candidates[index];
    let is_alike = |other: &usize| {
        *other != index
            && candidates[*other].stands_out() == own.stands_out()
            && (candidates[*other].bic - own.bic).abs() < TELLS_APART
    };
    (0..candidates.len()).filter(is_alike).collect()
}
