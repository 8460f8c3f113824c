//! What a caller may choose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How to solve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "preset", rename_all = "lowercase")]
#[non_exhaustive]
pub enum Options {
    /// The SMASH paper's energy, three phases and segment search, to the letter.
    Paper(PaperOptions),
    /// The most accurate solution, with its uncertainty.
    Refined(RefinedOptions),
}

/// Choices of the `refined` preset.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RefinedOptions {
    /// One σ of the angle about each horizontal axis by which the scene's `up` may be wrong, in rad;
    /// above 0.
    pub tilt_std_rad: f64,
}

/// A twentieth of a degree: the base model takes gravity as known. What is off by more is a finding,
/// not noise.
const TILT_STD_RAD: f64 = 0.05 * std::f64::consts::PI / 180.0;

impl Default for RefinedOptions {
    fn default() -> Self {
        RefinedOptions { tilt_std_rad: TILT_STD_RAD }
    }
}

/// Choices of the `paper` preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct PaperOptions {
    /// Which segment of the search is kept.
    pub segment_by: SegmentCriterion,
    /// Seeds the paper's random start of the impulse.
    pub seed: u64,
}

impl Options {
    /// The paper to the letter: its energy, its phases, its criterion.
    pub fn paper() -> Self {
        Options::Paper(PaperOptions::default())
    }

    /// The paper's energy with the criterion that finds the right segment far more often.
    pub fn paper_by_cost() -> Self {
        Options::Paper(PaperOptions { segment_by: SegmentCriterion::Cost, seed: 0 })
    }
}

impl Default for Options {
    fn default() -> Self {
        Options::Refined(RefinedOptions::default())
    }
}

impl Default for PaperOptions {
    fn default() -> Self {
        PaperOptions { segment_by: SegmentCriterion::Distance, seed: 0 }
    }
}

/// What the right segment has least of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum SegmentCriterion {
    /// The paper's: distance of the two centres at the collision, or of the centre from the plane.
    Distance,
    /// The least cost.
    Cost,
}
