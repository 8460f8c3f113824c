//! Which of several throws' candidates is the best, and what it makes of the throws.

use rayon::prelude::*;

use super::Goodness;
use super::dependence::inflation;
use super::own::Own;
use super::pooled::{PooledCandidate, Throw, dispersed};
use super::ranking::TELLS_APART;
use super::throws::looks;
use crate::Result;

/// The best of the candidates, and what it makes of the throws.
pub(crate) struct Best<'a> {
    /// With it.
    pub(crate) throws: Vec<Throw<'a>>,
    /// Whether more than noise is left over.
    pub(crate) is_structured: bool,
}

/// Puts the most probable of the candidates that stand out, and that every throw can be flown with,
/// first; `None` where there is none. What a throw says counts for less by what the best explanation
/// leaves over in it, with the values that are best for that throw.
pub(crate) fn put_best_first<'a>(
    throws: &[Throw<'a>],
    candidates: &mut Vec<PooledCandidate>,
) -> Result<Option<Best<'a>>> {
    let helps = |candidate: &PooledCandidate| candidate.bic < 0.0;
    let Some((index, with)) = first(throws, candidates, helps) else { return Ok(None) };
    if looks(&with)?.1 {
        let own = with_own(throws, &candidates[index]).unwrap_or(with);
        let dispersions = own.iter().map(dispersion).collect::<Result<Vec<f64>>>()?;
        *candidates = dispersed(throws, candidates, &dispersions);
    } else if candidates[index].stands_out() {
        candidates[..=index].rotate_right(1);
        return Ok(Some(Best { is_structured: false, throws: with }));
    }
    let Some((index, throws)) = first(throws, candidates, PooledCandidate::stands_out) else {
        return Ok(None);
    };
    candidates[..=index].rotate_right(1);
    Ok(Some(Best { is_structured: looks(&throws)?.1, throws }))
}

/// The first candidate that `will_do` and that all throws can be flown with, and they with it.
fn first<'a>(
    throws: &[Throw<'a>],
    candidates: &[PooledCandidate],
    will_do: impl Fn(&PooledCandidate) -> bool,
) -> Option<(usize, Vec<Throw<'a>>)> {
    let mut good = (0..candidates.len()).filter(|&index| will_do(&candidates[index]));
    good.find_map(|index| Some((index, with_effect(throws, &candidates[index]).ok()?)))
}

/// How much less what a throw says counts, by what it leaves over.
fn dispersion(throw: &Throw) -> Result<f64> {
    let is_structured = Goodness::of(throw.scene, &throw.fitted)?.is_structured;
    Ok(if is_structured { inflation(&throw.fitted) } else { 1.0 })
}

/// The throws with an effect more, with what all of them say of it.
pub(crate) fn with_effect<'a>(
    throws: &[Throw<'a>],
    effect: &PooledCandidate,
) -> Result<Vec<Throw<'a>>> {
    let with = |(index, throw): (usize, &Throw<'a>)| -> Result<Throw<'a>> {
        let fitted = match effect.held(index) {
            Some(held) => throw.fitted.with(throw.scene, &held)?,
            None => throw.fitted.clone(),
        };
        Ok(Throw { scene: throw.scene, fitted })
    };
    throws.par_iter().enumerate().map(with).collect()
}

/// The throws with an effect more, each as it says itself: what it says of other quantities then is as
/// sure as it knows the effect. `None` where one can't be flown with it.
pub(crate) fn with_own<'a>(
    throws: &[Throw<'a>],
    effect: &PooledCandidate,
) -> Option<Vec<Throw<'a>>> {
    let with = |(throw, own): (&Throw<'a>, &Option<Own>)| {
        let fitted = match own {
            Some(own) => throw.fitted.with(throw.scene, &own.instance).ok()?,
            None => throw.fitted.clone(),
        };
        Some(Throw { scene: throw.scene, fitted })
    };
    throws.iter().zip(&effect.own).map(with).collect()
}

/// The candidates that the throws can't tell from `candidate`.
pub(crate) fn alike<'a>(
    candidates: &'a [PooledCandidate],
    candidate: &'a PooledCandidate,
) -> impl Iterator<Item = &'a PooledCandidate> {
    candidates.iter().filter(move |other| {
        other.label != candidate.label
            && other.stands_out() == candidate.stands_out()
            && other.behind(candidate).abs() < TELLS_APART
    })
}
