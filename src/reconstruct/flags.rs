//! What is doubtful about a reconstruction, and what to do about it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
                "the bodies hardly changed their velocities: the poses don't tell the mass ratio"
            }
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
        }
    }
}

/// The bounds of the paper (section 5.1), with room for a solver that stops just inside.
pub(super) fn mass_ratio_at_bound(mass_ratio: f64) -> bool {
    !(1.001e-5..=9.999).contains(&mass_ratio)
}
