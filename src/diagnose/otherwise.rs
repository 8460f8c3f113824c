//! What else than missing physics may leave what is left over: the poses' errors themselves.

use super::dependence::waves_beside_curves;
use super::other_noise::OtherNoise;
use super::shared_errors::{SharedErrors, WAVES};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Errors of the poses that aren't as the model takes them to be: one of both, or neither.
#[derive(Debug, Clone, Default)]
pub(crate) struct Otherwise {
    pub(crate) noise: Option<OtherNoise>,
    pub(crate) shared: Option<SharedErrors>,
}

/// A scene that is explained to its noise.
pub(crate) struct Explained {
    /// The effects that its model lacked.
    pub(crate) missing: Vec<String>,
    /// The model with them.
    pub(crate) fitted: Fitted,
}

impl Otherwise {
    /// Of `scene`, whose best model leaves `fitted`, and that as more than noise if `is_structured`.
    /// `explained`: another scene of the same collision; `None` where something is left over that no effect
    /// explains. What can't be asked says nothing: the first answer stands.
    pub(crate) fn of(
        scene: &Scene,
        fitted: &Fitted,
        is_structured: bool,
        explained: impl Fn(&Scene) -> Result<Option<Explained>>,
    ) -> Otherwise {
        // The size of independent noise makes no waves.
        match waves_beside_curves(fitted) < WAVES {
            true => Otherwise {
                noise: OtherNoise::of(scene, fitted, explained).ok().flatten(),
                shared: None,
            },
            false if is_structured && !fitted.is_far_off() => Otherwise {
                noise: None,
                shared: SharedErrors::of(scene, fitted, explained).ok().flatten(),
            },
            false => Otherwise::default(),
        }
    }
}
