//! What a user does: changes, of which each makes a new variant, and steps between the variants.

use schemars::JsonSchema;
use serde::Serialize;

use crate::Result;
use crate::json::decode_part;

/// What a user does in the studio.
#[derive(Debug, Clone, PartialEq, JsonSchema)]
#[schemars(untagged)]
pub enum Action {
    /// Makes a new variant.
    Change(Change),
    /// Goes to a variant, or shows one.
    Step(Step),
}

/// What makes a new variant of the current one.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Change {
    /// Adds an effect.
    Add {
        /// `NAME[@BODY][:parameter=value,…]`: of the catalogue, or a law of one's own.
        effect: String,
    },
    /// Takes an effect out.
    Remove {
        /// Its label, `NAME[@BODY]`.
        effect: String,
    },
    /// Puts a law of one's own in: a new one, or instead of that of the same name.
    Law {
        /// The effect's file, TOML.
        text: String,
        /// `NAME[@BODY][:parameter=value,…]`, by the name in the text.
        effect: String,
    },
    /// Leaves a pose out of the fit, or takes it in again.
    Mark {
        /// The body's name.
        body: String,
        /// Which of its observations, in order of time, from 0.
        observation: usize,
        /// Whether it is wrong.
        wrong: bool,
    },
    /// Moves a pose in time.
    Time {
        /// The body's name.
        body: String,
        /// Which of its observations, in order of time, from 0.
        observation: usize,
        /// When it was seen, s; between its neighbours.
        time: f64,
    },
    /// States a pose's own noise: how many times as noisy it is as the others.
    PoseNoise {
        /// The body's name.
        body: String,
        /// Which of its observations, in order of time, from 0.
        observation: usize,
        /// Its σ over that of the noise; 1 for as noisy as the others.
        scale: f64,
    },
    /// States other noise; with neither number the scene's own again.
    Noise {
        /// One σ of a position coordinate, m.
        #[serde(skip_serializing_if = "Option::is_none")]
        position: Option<f64>,
        /// One σ of a component of the rotation vector, rad; not needed where no orientation is measured.
        #[serde(skip_serializing_if = "Option::is_none")]
        orientation: Option<f64>,
    },
}

/// What changes which variants are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, JsonSchema)]
#[schemars(tag = "do", rename_all = "lowercase")]
pub enum Step {
    /// Back to the variant that the current one was made from.
    Undo,
    /// To the variant that one came back from.
    Redo,
    /// To any variant.
    Go {
        /// Which.
        variant: usize,
    },
    /// Shows a variant beside the current one, or no longer.
    Compare {
        /// Which.
        variant: usize,
        /// Whether it is to be seen.
        shown: bool,
    },
}

impl Action {
    /// Reads an action from JSON.
    ///
    /// # Errors
    /// It isn't JSON, or no action; with place, value and mend.
    pub fn parse(text: &str) -> Result<Action> {
        decode_part(text)
    }
}
