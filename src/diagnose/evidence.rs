//! How strongly the data speak for an effect, counting its parameters and the candidates tried.

use statrs::distribution::{ChiSquared, ContinuousCDF, FisherSnedecor};

use super::FALSE_ALARM;
use crate::reconstruct::refined::{Fitted, Gain};

/// What speaks for a larger model against one that it holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Evidence {
    /// By how much −2 ln L falls; χ² where the noise is stated.
    pub(crate) delta: f64,
    /// As improbable under noise alone, were the noise known.
    pub(crate) delta_chi2: f64,
    /// Directions that the data depend on, with a scanned one.
    pub(crate) parameters: usize,
    /// How often noise alone would do as much, in any of the candidates and at any point of a scan.
    pub(crate) p_value: f64,
}

/// The evidence for `with`; `None` where the data don't depend on what it adds. `scanned`: places
/// that a scan chose from; `tried`: candidates in all.
pub(crate) fn evidence(
    without: &Fitted,
    with: &Fitted,
    scanned: usize,
    tried: usize,
) -> Option<Evidence> {
    let acting = with.acting.last()?;
    let parameters = with.directions(acting);
    if parameters == 0 {
        return None;
    }
    let delta = without.fall_to(with).max(0.0);
    let count = parameters as f64;
    let chi = ChiSquared::new(count).ok()?;
    let single = match with.has_stated_noise() {
        true => chi.sf(delta),
        false => fisher(with, delta, count)?,
    };
    // Beyond what doubles can tell apart from none, χ² itself goes on telling.
    let delta_chi2 = match with.has_stated_noise() || single < 1e-280 {
        true => delta,
        false => chi.inverse_cdf(1.0 - single.max(1e-16)).max(tail(single, count)),
    };
    let chances = (scanned * tried) as f64;
    let p_value = (chances * single).min(1.0);
    Some(Evidence { delta, delta_chi2, parameters, p_value })
}

/// How often noise alone lets a model gain as much by one effect, told from its slopes.
pub(super) fn by_chance(fitted: &Fitted, gain: &Gain) -> f64 {
    let count = gain.directions as f64;
    if fitted.has_stated_noise() {
        return ChiSquared::new(count).map_or(1.0, |chi| chi.sf(gain.chi2));
    }
    let spare = fitted.numbers() - fitted.used();
    // The estimated noise is what is left, but no less than rounding: then χ² is smaller.
    let left = (fitted.chi2().max(spare) - gain.chi2).max(f64::MIN_POSITIVE);
    let f = gain.chi2 / count / (left / (spare - count));
    FisherSnedecor::new(count, spare - count).map_or(1.0, |fisher| fisher.sf(f))
}

/// Fisher's F-test of nested models, exact for one channel: how often noise alone lets −2 ln L fall
/// by `delta`.
fn fisher(with: &Fitted, delta: f64, parameters: f64) -> Option<f64> {
    let spare = with.numbers() - with.used();
    if spare < 1.0 {
        return None;
    }
    let f = (delta / spare).exp_m1() * spare / parameters;
    Some(FisherSnedecor::new(parameters, spare).ok()?.sf(f))
}

/// The χ² whose tail is `p`, where that is too small for an inverse by doubles: by halving.
fn tail(p: f64, degrees: f64) -> f64 {
    let Ok(chi) = ChiSquared::new(degrees) else { return 0.0 };
    let (mut low, mut high) = (0.0, 3000.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if chi.sf(middle) > p { low = middle } else { high = middle }
    }
    low
}

impl Evidence {
    /// Schwarz's criterion against the model without: −Δχ² and the penalty.
    pub(crate) fn bic(&self, numbers: f64, poses: Option<usize>) -> f64 {
        -self.delta_chi2 + penalty(self.parameters, numbers, poses)
    }
}

/// What Schwarz's criterion asks of a model with so many parameters more: k ln n; where a pose was
/// chosen from `poses` that choice counts too.
fn penalty(parameters: usize, numbers: f64, poses: Option<usize>) -> f64 {
    let chosen = poses.map_or(0.0, |poses| 2.0 * (poses as f64).ln());
    parameters as f64 * numbers.ln() + chosen
}

/// The Δχ² above which a candidate is both significant and more probable than none, where the noise
/// is stated; arguments as those of [`evidence`] and [`Evidence::bic`].
pub(crate) fn critical_chi2(
    parameters: usize,
    (scanned, tried): (usize, usize),
    numbers: f64,
    poses: Option<usize>,
) -> f64 {
    let significant = tail(FALSE_ALARM / (scanned * tried) as f64, parameters as f64);
    significant.max(penalty(parameters, numbers, poses))
}
