//! What a model leaves over, asked in all ways: χ², tests of randomness by channel, and a free force
//! and torque on each body.

use super::Goodness;
use super::unexplained::{Unexplained, unexplained};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// What a fit leaves over.
pub(crate) struct Leftover {
    pub(super) goodness: Goodness,
    pub(super) unexplained: Vec<Unexplained>,
}

impl Leftover {
    pub(crate) fn of(scene: &Scene, fitted: &Fitted) -> Result<Leftover> {
        let goodness = Goodness::of(scene, fitted)?;
        Ok(Leftover { goodness, unexplained: unexplained(scene, fitted)? })
    }

    /// Whether it is more than noise.
    pub(crate) fn is_structured(&self) -> bool {
        self.goodness.is_structured || !self.unexplained.is_empty()
    }
}
