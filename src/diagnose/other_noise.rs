//! Noise that isn't as the scene states it: residuals that look random, but are too large or too small
//! for the stated noise, tell of that as well as of an effect.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::goodness::IMPROBABLE;
use super::reported;
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::{self, Fitted};
use crate::words::significant;
use crate::{Result, Scene};

/// The noise that the poses show by themselves, where χ² contradicts the stated one, and what is missing
/// beside it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OtherNoise {
    /// One σ of a position coordinate, m.
    pub position: f64,
    /// One σ of a component of the rotation vector, rad; null when no orientation was fitted.
    pub orientation: Option<f64>,
    /// What the scene states for `position`.
    pub stated_position: f64,
    /// What the scene states for `orientation`; null with it.
    pub stated_orientation: Option<f64>,
    /// `NAME@BODY` of the effects that are missing with that noise; empty where nothing is.
    pub missing: Vec<String>,
}

impl OtherNoise {
    /// Of `scene`, whose best model leaves `fitted`. `missing`: what is missing from a scene that states no
    /// noise; `None` where something is left over there, too.
    pub(crate) fn of(
        scene: &Scene,
        options: &RefinedOptions,
        fitted: &Fitted,
        missing: impl FnOnce(&Scene) -> Result<Option<Vec<String>>>,
    ) -> Result<Option<OtherNoise>> {
        let Some(stated) = scene.noise().filter(|_| contradicts(fitted)) else { return Ok(None) };
        let scene = scene.without_noise();
        let Some(missing) = missing(&scene)? else { return Ok(None) };
        let mut options = options.clone();
        for label in &missing {
            options.effects.push(EffectRequest::parse(label)?);
        }
        let shown = reported(&scene, &refined::fit(&scene, &options)?)?.noise;
        let told = shown.filter(|noise| noise.estimated && noise.reason.is_none());
        Ok(told.map(|noise| OtherNoise {
            position: noise.position,
            orientation: noise.orientation,
            stated_position: stated.position,
            stated_orientation: noise.orientation.map(|_| stated.orientation),
            missing,
        }))
    }

    /// In a sentence or two.
    pub fn in_words(&self) -> String {
        let shown = both(self.position, self.orientation);
        let stated = both(self.stated_position, self.stated_orientation);
        let missing = are_missing(&self.missing);
        match self.position > self.stated_position {
            true => format!(
                "Or the noise is larger than stated: what is left looks random, and with {shown} \
                 instead of {stated} {missing}."
            ),
            false => format!(
                "The noise is smaller than stated: the poses scatter by {shown} instead of {stated}, \
                 and with that {missing}."
            ),
        }
    }

    /// What to do about it.
    pub const MEND: &str = "check the noise that SCENE states (`noise`): left out, it is \
                                   estimated from the poses";
}

/// `magnus@a is all that is missing`.
pub(super) fn are_missing(labels: &[String]) -> String {
    match labels {
        [] => "nothing is missing".to_string(),
        [one] => format!("{one} is all that is missing"),
        all => format!("{} are all that is missing", all.join(" and ")),
    }
}

/// Whether χ² is too large, or too small, for the stated noise.
fn contradicts(fitted: &Fitted) -> bool {
    let spare = (fitted.numbers() - fitted.used()).max(1.0);
    ChiSquared::new(spare)
        .is_ok_and(|chi| f64::min(chi.sf(fitted.chi2()), chi.cdf(fitted.chi2())) < IMPROBABLE)
}

/// `2.0 mm and 0.57°`.
fn both(position_m: f64, orientation_rad: Option<f64>) -> String {
    let turn = orientation_rad
        .map_or(String::new(), |angle| format!(" and {}°", significant(angle.to_degrees(), 2)));
    format!("{} mm{turn}", significant(1e3 * position_m, 2))
}
