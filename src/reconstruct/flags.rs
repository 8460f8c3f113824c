//! What is doubtful about a reconstruction, and what to do about it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Fit;

/// A doubt, as a word in the result file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Flag {
    /// The mass ratio ended at a bound, 10⁻⁵ or 10 (the paper's sign of failure).
    MassRatioAtBound,
    /// The restitution is not within 0 to 1 (the paper's other sign of failure).
    RestitutionOutOfRange,
    /// The limit on iterations ended the last phase.
    NotConverged,
    /// The bodies hardly pushed each other: the poses don't tell the mass ratio.
    MassRatioUnidentifiable,
    /// The model misses the poses by more than their noise, or visibly where none is stated.
    PoorFit,
}

impl Flag {
    /// The doubt in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Flag::MassRatioAtBound => "the mass ratio ended at its bound: this is a failed fit",
            Flag::RestitutionOutOfRange => {
                "the restitution is not between 0 and 1: the bodies would gain energy or pass \
                 through each other"
            }
            Flag::NotConverged => "the last phase ended before it settled",
            Flag::MassRatioUnidentifiable => {
                "the jumps in velocity don't stand out of the noise: the poses don't tell the mass ratio"
            }
            Flag::PoorFit => "the model misses the poses by more than annotations scatter",
        }
    }

    /// What the user can do about it.
    pub fn advice(self) -> &'static str {
        match self {
            Flag::MassRatioAtBound | Flag::RestitutionOutOfRange => {
                "check the poses nearest the collision, their times and the sizes; more poses on \
                 each side help most; try the other --segment-by"
            }
            Flag::NotConverged => "check for poses far off their neighbours",
            Flag::MassRatioUnidentifiable => "film a harder hit, or annotate longer flights",
            Flag::PoorFit => {
                "look for wrong poses or times; a dense annotation of fast spins misleads the \
                 paper's start: try every 5th to 10th pose"
            }
        }
    }
}

/// Without a stated noise: an annotator sees a pose that is 0.1 rad off, or off by a quarter of the
/// body's shortest extent.
const VISIBLE_ANGLE_RAD: f64 = 0.1;
const VISIBLE_SHARE_OF_EXTENT: f64 = 0.25;

/// With a stated noise: residuals of twice the noise. The paper's fixed collision time alone makes
/// them larger than the noise.
const POOR_REDUCED_CHI2: f64 = 4.0;

/// Whether the residuals are too large. `shortest_extent_m`: of the smaller body.
pub(super) fn is_poor(fit: &Fit, shortest_extent_m: f64) -> bool {
    match fit.reduced_chi2 {
        Some(reduced) => reduced > POOR_REDUCED_CHI2,
        None => {
            fit.position_rmse > VISIBLE_SHARE_OF_EXTENT * shortest_extent_m
                || fit.orientation_rmse.is_some_and(|angle| angle > VISIBLE_ANGLE_RAD)
        }
    }
}

/// The bounds of the paper (section 5.1), with room for a solver that stops just inside.
pub(super) fn mass_ratio_at_bound(mass_ratio: f64) -> bool {
    !(1.001e-5..=9.999).contains(&mass_ratio)
}
