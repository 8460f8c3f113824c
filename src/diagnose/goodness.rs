//! Whether what a model leaves over could be noise.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::reported;
use crate::compare::{ChannelTest, channels};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Noise alone leaves more in one scene of ten thousand.
pub(super) const IMPROBABLE: f64 = 1e-4;

/// How good a fit is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Goodness {
    /// By how much χ² exceeds what noise leaves; `None` where the noise is estimated.
    pub(crate) excess: Option<f64>,
    /// Whether it can't be noise.
    pub(crate) is_structured: bool,
}

impl Goodness {
    /// That of a fit of `scene`.
    pub(crate) fn of(scene: &Scene, fitted: &Fitted) -> Result<Goodness> {
        Ok(Goodness::by(fitted, &channels(scene, &reported(scene, fitted)?)?))
    }

    /// By the tests of randomness, and by χ² where the noise is stated.
    pub(crate) fn by(fitted: &Fitted, channels: &[ChannelTest]) -> Goodness {
        let looks_structured = channels.iter().any(|channel| channel.fails);
        if !fitted.has_stated_noise() {
            return Goodness { excess: None, is_structured: looks_structured };
        }
        let spare = (fitted.numbers() - fitted.used()).max(1.0);
        let chi2 = fitted.chi2();
        let tail = ChiSquared::new(spare).map_or(1.0, |chi| chi.sf(chi2));
        let is_structured = looks_structured || tail < IMPROBABLE;
        Goodness { excess: Some(chi2 - spare), is_structured }
    }
}
