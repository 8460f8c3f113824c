//! The improvement as it stands in a file, `smash.improvement/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::diagnose::{Together, Verdict};
use crate::{Reconstruction, Scene};

/// The value of an improvement file's field `schema`.
pub const IMPROVEMENT_SCHEMA: &str = "smash.improvement/1";

/// A model that grew effect by effect, and how the error fell.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.improvement/1")]
pub struct Improvement {
    /// Always `smash.improvement/1`.
    #[schemars(extend("const" = IMPROVEMENT_SCHEMA))]
    pub schema: String,
    /// The scene's name.
    pub scene: String,
    /// From the model that one started with, upwards.
    pub ladder: Vec<Rung>,
    /// `NAME@BODY` of effects that were added on the way, and became superfluous.
    pub dropped: Vec<String>,
    /// Of the whole ladder: `missing` where effects were added and explain the poses,
    /// `unknown_effect` where something is left that none explains.
    pub verdict: Verdict,
    /// That of the last rung; of several throws the first one's.
    pub result: Reconstruction,
    /// Of several throws: their restitution and mass ratio on the last rung, put together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<Together>,
}

/// A model on the ladder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Rung {
    /// `NAME@BODY` of the effect that it adds; null of the first.
    pub added: Option<String>,
    /// All that were added up to it: what `--with` takes.
    pub with: Vec<String>,
    /// How often noise alone would seem such an effect, any of all candidates; null of the first.
    pub p_value: Option<f64>,
    /// `NAME@BODY` of the effects that the poses can't tell from it, given those before.
    #[serde(default)]
    pub indistinguishable_from: Vec<String>,
    /// Root mean square over all position coordinates, m.
    pub position_rmse: f64,
    /// Root mean square over all components of the rotation vectors, rad; null without orientations.
    pub orientation_rmse: Option<f64>,
    /// χ² over its degrees of freedom; null where the scene states no noise.
    pub reduced_chi2: Option<f64>,
    /// Root mean square in m of positions predicted from the other blocks of poses.
    pub heldout_position_rmse: Option<f64>,
    /// m_b / m_a; null without a second dynamic body.
    pub mass_ratio: Option<f64>,
    /// The restitution; null where the poses don't tell it.
    pub restitution: Option<f64>,
}

impl Improvement {
    pub(super) fn new(
        scene: &Scene,
        verdict: Verdict,
        ladder: Vec<Rung>,
        dropped: Vec<String>,
        result: Reconstruction,
    ) -> Improvement {
        Improvement {
            schema: IMPROVEMENT_SCHEMA.to_string(),
            scene: scene.name().to_string(),
            ladder,
            dropped,
            verdict,
            result,
            together: Vec::new(),
        }
    }

    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self)
            .expect("plain numbers and strings always have a JSON form");
        text.push('\n');
        text
    }
}
