//! Neighbouring poses that share their errors, as after a tracker or a spline that smooths: what is left
//! comes in waves then, as beside a force that is missing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Goodness;
use super::dependence::{flights, waves};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Fewer poses of a flight show next to nothing.
const LEAST_LEFT: usize = 5;

/// Poses so far apart that their errors hardly know of each other, where what is left of them looks random.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SharedErrors {
    /// How many neighbours say the same: 1 + 2 Σ ρ over the residuals' correlations ρ.
    pub correlation_length: f64,
    /// Every so manieth pose was kept, outwards from the collision.
    pub every: usize,
    /// `NAME@BODY` of the effects that are missing from those; empty where nothing is.
    pub missing: Vec<String>,
}

impl SharedErrors {
    /// Of `scene`, whose best model leaves `fitted`. `missing`: what is missing from a scene of fewer poses;
    /// `None` where something is left over there, too.
    pub(crate) fn of(
        scene: &Scene,
        fitted: &Fitted,
        missing: impl FnOnce(&Scene) -> Result<Option<Vec<String>>>,
    ) -> Result<Option<SharedErrors>> {
        let flights = flights(fitted).into_iter().map(|flight| flight.len());
        let shortest = flights.filter(|poses| *poses > 0).min().unwrap_or(0);
        let correlation_length = waves(fitted);
        let every = (correlation_length.ceil() as usize).min(shortest / LEAST_LEFT);
        if every < 2 || !Goodness::of(scene, fitted)?.is_structured {
            return Ok(None);
        }
        let missing = missing(&scene.thinned(every, fitted.collision_time_s()))?;
        Ok(missing.map(|missing| SharedErrors { correlation_length, every, missing }))
    }

    /// In a sentence.
    pub fn in_words(&self) -> String {
        format!(
            "Or neighbouring poses share their errors, as after a tracker or a spline that smooths: of one \
             pose in {} what is left looks random, and {}.",
            self.every,
            super::other_noise::are_missing(&self.missing)
        )
    }

    /// What to do about it.
    pub fn mend(&self) -> String {
        format!(
            "if the poses come from a tracker or a spline that smooths, keep one in {} of them: what their \
             errors share is taken for physics",
            self.every
        )
    }
}
