//! What a caller may choose.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effect::{EffectRequest, RequestFile};

/// How to solve.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "preset", rename_all = "lowercase")]
#[non_exhaustive]
pub enum Options {
    /// The SMASH paper's energy, three phases and segment search, to the letter.
    Paper(PaperOptions),
    /// The most accurate solution, with its uncertainty.
    Refined(RefinedOptions),
}

/// Choices of the `refined` preset.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RefinedOptions {
    /// One σ of the angle about each horizontal axis by which the scene's `up` may be wrong, in rad;
    /// above 0.
    pub tilt_std_rad: f64,
    /// What a residual costs.
    pub loss: Loss,
    /// How the 95 % intervals are found.
    pub intervals: Intervals,
    /// Effects beyond the base model, in the order in which they are added.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(with = "Vec<RequestFile>")]
    pub effects: Vec<EffectRequest>,
}

/// What a residual costs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Loss {
    /// Its square: best where the noise is Gaussian.
    Squares,
    /// Student's t with four degrees of freedom: a few wrong annotations hardly count.
    Robust,
}

/// How 95 % intervals are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Intervals {
    /// From the covariance at the optimum: the model is taken as linear.
    Covariance,
    /// From the profile likelihood: slower, right for lopsided ones too.
    Profile,
}

/// A hundredth of a degree: the base model takes gravity as known. What is off by more is a finding,
/// or known to be uncertain and stated.
const TILT_STD_RAD: f64 = 0.01 * std::f64::consts::PI / 180.0;

impl Default for RefinedOptions {
    fn default() -> Self {
        RefinedOptions {
            tilt_std_rad: TILT_STD_RAD,
            loss: Loss::Squares,
            intervals: Intervals::Covariance,
            effects: Vec::new(),
        }
    }
}

/// Choices of the `paper` preset.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
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
