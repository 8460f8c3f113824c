//! Noise that isn't as the scene states it: residuals without order that are too large or too small for
//! the stated noise tell of that as well as of an effect.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::goodness::IMPROBABLE;
use super::otherwise::{Cause, Explained, Otherwise, all_that_is_missing};
use crate::reconstruct::refined::Fitted;
use crate::words::significant;
use crate::{Result, Scene};

/// Noise within a tenth of what is stated is as stated: so few poses tell it no better.
const AS_STATED: f64 = 0.1;
/// The root mean square over what the median tells of it, beyond which a few poses make the noise.
const HEAVY_TAILS: f64 = 1.5;
/// The median of a normal deviate's size.
const MEDIAN: f64 = 0.6745;

/// The noise that the poses show by themselves, where χ² contradicts the stated one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OtherNoise {
    /// One σ of a position coordinate, m.
    pub position: f64,
    /// One σ of a component of the rotation vector, rad; null where orientations don't tell it.
    pub orientation: Option<f64>,
    /// What the scene states for `position`.
    pub stated_position: f64,
    /// What the scene states for `orientation`; null with it.
    pub stated_orientation: Option<f64>,
}

impl OtherNoise {
    /// Of `scene`, whose best model leaves `fitted`. `None` where it isn't so, where even so something is
    /// left over, or where a few wrong poses would be taken for noise.
    pub(super) fn told(
        scene: &Scene,
        fitted: &Fitted,
        explained: impl FnOnce(&Scene) -> Result<Explained>,
    ) -> Result<Option<Otherwise>> {
        let Some(stated) = scene.noise().filter(|_| contradicts(fitted)) else { return Ok(None) };
        let Explained { missing, mut fitted, leaves_more: false } =
            explained(&scene.without_noise())?
        else {
            return Ok(None);
        };
        fitted.settle()?;
        let [position, orientation] = fitted.noise.estimates();
        let told = position.filter(|_| !has_heavy_tails(&fitted));
        let Some(position) = told else { return Ok(None) };
        let noise = OtherNoise {
            position,
            orientation,
            stated_position: stated.position,
            stated_orientation: orientation.map(|_| stated.orientation),
        };
        Ok(Some(Otherwise {
            words: noise.in_words(&missing),
            mend: "check the noise that the scene states (`noise`): left out, it is estimated from the \
                   poses"
                .to_string(),
            missing,
            cause: Cause::OtherNoise(noise),
        }))
    }

    fn in_words(&self, missing: &[String]) -> String {
        let orientations = self.orientation.zip(self.stated_orientation);
        let ratios: Vec<f64> = std::iter::once((self.position, self.stated_position))
            .chain(orientations)
            .map(|(shown, stated)| shown / stated)
            .collect();
        let missing = all_that_is_missing(missing);
        let digits = match ratios.iter().all(|ratio| (ratio - 1.0).abs() < AS_STATED) {
            true => 3,
            false => 2,
        };
        let shown = both(self.position, self.orientation, digits);
        let stated = both(self.stated_position, self.stated_orientation, digits);
        let grows = ratios.iter().any(|ratio| *ratio > 1.0 + AS_STATED);
        let shrinks = ratios.iter().any(|ratio| *ratio < 1.0 - AS_STATED);
        let how = match (grows, shrinks) {
            (true, false) => "larger",
            (false, true) => "smaller",
            _ => "other",
        };
        format!("The noise may be {how} than stated: with {shown} instead of {stated} {missing}.")
    }
}

/// Whether χ² is too large, or too small, for the stated noise: either in one scene of ten thousand.
fn contradicts(fitted: &Fitted) -> bool {
    let spare = (fitted.numbers() - fitted.used()).max(1.0);
    ChiSquared::new(spare)
        .is_ok_and(|chi| f64::min(chi.sf(fitted.chi2()), chi.cdf(fitted.chi2())) < IMPROBABLE)
}

/// Whether a few residuals are much larger than the others.
fn has_heavy_tails(fitted: &Fitted) -> bool {
    let residuals = &fitted.best().solution.residuals;
    let positions = residuals.iter().flat_map(|residual| residual.position_m);
    let turns = residuals.iter().flat_map(|residual| residual.turn_rad);
    [positions.collect::<Vec<f64>>(), turns.collect()].into_iter().any(|mut sizes| {
        sizes.iter_mut().for_each(|size| *size = size.abs());
        // Of orientations that nobody annotated.
        sizes.retain(|size| *size > 0.0);
        sizes.sort_by(f64::total_cmp);
        let squares: f64 = sizes.iter().map(|size| size * size).sum();
        let median = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
        (squares / sizes.len() as f64).sqrt() > HEAVY_TAILS * median / MEDIAN
    })
}

/// `2.0 mm and 0.57°`.
fn both(position_m: f64, orientation_rad: Option<f64>, digits: usize) -> String {
    let turn = orientation_rad.map_or(String::new(), |angle| {
        format!(" and {}°", significant(angle.to_degrees(), digits))
    });
    format!("{} mm{turn}", significant(1e3 * position_m, digits))
}
