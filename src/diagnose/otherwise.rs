//! What else than missing physics may leave what is left over: the poses' errors themselves.

use super::other_noise::OtherNoise;
use super::shared_errors::SharedErrors;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Errors of the poses that aren't as the model takes them to be.
#[derive(Debug, Clone, Default)]
pub(crate) struct Otherwise {
    pub(crate) noise: Option<OtherNoise>,
    pub(crate) shared: Option<SharedErrors>,
}

impl Otherwise {
    /// Of `scene`, whose best model leaves `fitted`. `missing`: the effects that are missing from a scene of the
    /// same collision; `None` where something is left over that none explains.
    pub(crate) fn of(
        scene: &Scene,
        options: &RefinedOptions,
        fitted: &Fitted,
        missing: impl Fn(&Scene) -> Result<Option<Vec<String>>>,
    ) -> Result<Otherwise> {
        let noise = OtherNoise::of(scene, options, fitted, &missing)?;
        let shared = match &noise {
            Some(_) => None,
            None => SharedErrors::of(scene, fitted, &missing)?,
        };
        Ok(Otherwise { noise, shared })
    }
}
