//! The comparison as it stands in a file, `smash.comparison/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::channels::ChannelTest;
use super::ledger::Ledger;
use crate::json::pretty;
use crate::reconstruct::{Outlier, Preset};

/// The value of a comparison file's field `schema`.
pub const COMPARISON_SCHEMA: &str = "smash.comparison/1";

/// Results against the poses, and against each other. SI units, world frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.comparison/1")]
pub struct Comparison {
    /// Always `smash.comparison/1`.
    #[schemars(extend("const" = COMPARISON_SCHEMA))]
    pub schema: String,
    /// The scene's name.
    pub scene: String,
    /// The noise that residuals are told in; null where neither the scene nor a result has one.
    pub noise: Option<ComparedNoise>,
    /// Each result against the poses.
    pub results: Vec<ResultResiduals>,
    /// What the results say, side by side.
    pub quantities: Vec<Quantity>,
    /// The truth of a simulated scene, where it was given, and each result beside it; differences are
    /// from the truth.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub against_truth: Vec<Quantity>,
    /// What looks odd, and what to do about it.
    pub warnings: Vec<String>,
}

/// One σ of the annotations, the same for all results.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ComparedNoise {
    /// Of a position coordinate, m.
    pub position: f64,
    /// Of a component of the rotation vector, rad; null when no orientation was fitted.
    pub orientation: Option<f64>,
    /// The result that it is from; null when the scene states it.
    pub from_result: Option<String>,
}

/// What a result's own motion leaves of the poses. It is computed from the numbers in the file: a
/// flight on each side of the collision, with the result's effects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResultResiduals {
    /// The result's name.
    pub name: String,
    /// The method.
    pub preset: Preset,
    /// Root mean square over all position coordinates, m; null where no motion is known.
    pub position_rmse: Option<f64>,
    /// Root mean square over all components of the residual rotation vectors, rad; null where no
    /// rotation is known or no orientation was measured.
    pub orientation_rmse: Option<f64>,
    /// What the result says of itself, m. It differs where the solver's model of flight does.
    pub reported_position_rmse: f64,
    /// What the result says of itself, rad. The paper's differs: it turns bodies by explicit Euler
    /// steps.
    pub reported_orientation_rmse: Option<f64>,
    /// Where the residuals are; none where no motion is known.
    pub channels: Vec<ChannelResidual>,
    /// Whether the residuals look random, along the axes where causes show.
    #[serde(default)]
    pub structure: Vec<ChannelTest>,
    /// Where they don't, in words, the clearest first; empty where nothing looks structured.
    #[serde(default)]
    pub findings: Vec<String>,
    /// Poses that lie too far off to be noise, the worst first: by noise alone there is one in one
    /// of a hundred scenes.
    #[serde(default)]
    pub outliers: Vec<Outlier>,
    /// Momentum, angular momentum and energy before and after the collision.
    pub ledger: Ledger,
    /// Why something is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A side of the collision.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Segment {
    /// Until the collision.
    Before,
    /// From the collision on.
    After,
}

/// What is observed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Channel {
    /// Of the centre of mass, in m.
    Position,
    /// As rotation vectors, in rad.
    Orientation,
}

/// The residuals (pose minus model) of one body, on one side, in one channel.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChannelResidual {
    /// The body's name.
    pub body: String,
    /// The side of the collision.
    pub segment: Segment,
    /// What is observed.
    pub channel: Channel,
    /// How many poses there are.
    pub poses: usize,
    /// Root mean square over all coordinates, in m or rad.
    pub rmse: f64,
    /// `rmse` over the noise: about 1 where noise is all there is. Null without noise.
    pub rmse_in_sigma: Option<f64>,
    /// Whether noise alone is so large in fewer than one case of a thousand. Null without noise.
    pub stands_out: Option<bool>,
    /// The pose that is missed most.
    pub largest: LargestMiss,
}

/// The pose that a model misses most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LargestMiss {
    /// The pose's time, s.
    pub time: f64,
    /// Distance in m, or angle in rad.
    pub size: f64,
    /// `size` over the noise of a coordinate: about √3 where noise is all there is. Null without
    /// noise.
    pub in_sigma: Option<f64>,
}

/// What each result says of one quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Quantity {
    /// Such as `mass_ratio`, `impulse` or, after a body's name, `a.velocity_after`; as in a result's
    /// `uncertainty`.
    pub quantity: String,
    /// Of the values; empty where there is none, as of quaternions.
    pub unit: String,
    /// Of the differences: `rad` of orientations, whose difference is a rotation vector; else that of
    /// the values.
    #[serde(default)]
    pub difference_unit: String,
    /// One for each result. States are each at its own collision time.
    pub entries: Vec<Entry>,
    /// Of each later result from the first.
    pub differences: Vec<Difference>,
}

/// A quantity in one result.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Entry {
    /// One number, x y z, or the quaternion w x y z; null where the result has none.
    pub value: Option<Vec<f64>>,
    /// One standard deviation of each number; of an orientation, of turns about the world's axes, in
    /// rad. Null where the result has none.
    pub std: Vec<Option<f64>>,
    /// Why `value` is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// How a later result differs from the first.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Difference {
    /// Later minus first, number by number; of an orientation, the turn from the first to the later
    /// one about the world's axes, in rad. Null where one of them is null.
    pub difference: Option<Vec<f64>>,
    /// Its length, or the angle between, in the quantity's unit.
    pub size: Option<f64>,
    /// The number that differs most, in its standard deviations: √(σ₁² + σ₂²) where both results
    /// have one, else that of the one that has. Both come from the same poses, so their errors are
    /// not independent: a yardstick, not a test. Null where neither has one.
    pub in_sigma: Option<f64>,
}

impl Comparison {
    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}
