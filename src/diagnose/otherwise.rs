//! What else than missing physics may leave what is left over: the poses' errors themselves, or how they
//! are written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::dependence::waves_beside_curves;
use super::misread::Misread;
use super::near_collision::NearCollision;
use super::near_collisions::NearCollisions;
use super::other_noise::OtherNoise;
use super::shared_errors::{SharedErrors, WAVES};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Poses that aren't as the model takes them to be, and what is missing beside that.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Otherwise {
    /// What it may be.
    pub cause: Cause,
    /// `NAME@BODY` of the effects that are missing even so; empty where none is.
    pub missing: Vec<String>,
    /// The same in a sentence.
    pub words: String,
    /// What to do about it.
    pub mend: String,
}

/// How the poses may be.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Cause {
    /// With errors of another size than stated.
    OtherNoise(OtherNoise),
    /// With errors that neighbours share.
    SharedErrors(SharedErrors),
    /// With errors that are large where the bodies touch.
    NearCollision(NearCollision),
    /// The same in several throws.
    NearCollisions(NearCollisions),
    /// Written otherwise than they are read.
    Misread(Misread),
}

/// A scene as its best model explains it.
pub(crate) struct Explained {
    /// The effects that its model lacked.
    pub(crate) missing: Vec<String>,
    /// The model with them.
    pub(crate) fitted: Fitted,
    /// Whether that leaves something that no effect explains.
    pub(crate) leaves_more: bool,
}

impl Otherwise {
    /// Whether the scene seems to be written otherwise than it is read.
    pub fn is_misread(&self) -> bool {
        matches!(self.cause, Cause::Misread(_))
    }

    /// Of `scene`, whose best model leaves `fitted`, and that as more than noise if `is_structured`.
    /// `explained`: another scene of the same collision. What can't be asked says nothing: the first
    /// answer stands.
    pub(crate) fn of(
        scene: &Scene,
        fitted: &Fitted,
        is_structured: bool,
        explained: impl Fn(&Scene) -> Result<Explained>,
    ) -> Option<Otherwise> {
        if let Some(near) = NearCollision::of(scene, fitted).filter(|_| is_structured) {
            return near.told(scene, fitted, explained).ok().flatten();
        }
        // The size of independent noise makes no waves.
        match waves_beside_curves(fitted) < WAVES {
            true => OtherNoise::told(scene, fitted, explained).ok().flatten(),
            false if is_structured && !fitted.is_far_off() => {
                SharedErrors::told(scene, fitted, explained).ok().flatten()
            }
            false => None,
        }
    }
}

impl Explained {
    /// In words.
    pub(super) fn shows(&self) -> String {
        shows(&self.missing, self.leaves_more)
    }
}

/// What is `missing`, in words, and whether that is all.
pub(super) fn shows(missing: &[String], leaves_more: bool) -> String {
    match (missing, leaves_more) {
        (labels, false) => all_that_is_missing(labels),
        ([], true) => "something is left still that no effect explains".to_string(),
        ([one], true) => format!("{one} is missing, and something is left still"),
        (all, true) => {
            format!("{} are missing, and something is left still", all.join(" and "))
        }
    }
}

/// Of effects by their labels, in words.
pub(super) fn all_that_is_missing(labels: &[String]) -> String {
    match labels {
        [] => "nothing is missing".to_string(),
        [one] => format!("{one} is all that is missing"),
        all => format!("{} are all that is missing", all.join(" and ")),
    }
}
