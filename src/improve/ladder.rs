//! The improvement as it stands in a file, `smash.improvement/1`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::words::explanation;
use crate::diagnose::{OtherLaw, Otherwise, Together, Verdict, in_words, listed, telling_apart};
use crate::reconstruct::ParameterEstimate;
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
    /// Laws of simple forms that the catalogue hasn't got, each of which alone does as well as all effects
    /// of the ladder, or explains 95 % of what they do and more than any single one; the best first.
    #[serde(default)]
    pub other_laws: Vec<OtherLaw>,
    /// What else than missing physics may leave what is left on the last rung: poses that aren't as the
    /// model takes them to be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub otherwise: Option<Otherwise>,
    /// Of several throws: their restitution and mass ratio on the last rung, put together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<Together>,
    /// The answer in plain words.
    pub explanation: String,
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
    /// The parameters of that effect in the model of the last rung. Of several throws their deviations are
    /// with the other effects held; empty where each throw has its own.
    #[serde(default)]
    pub parameters: BTreeMap<String, ParameterEstimate>,
    /// Whether several throws have the same parameters of that effect; else each has its own.
    #[serde(default = "crate::diagnose::yes")]
    pub is_shared: bool,
    /// `NAME@BODY` of the effects that the poses can't tell from it, with all others of the ladder.
    #[serde(default)]
    pub indistinguishable_from: Vec<String>,
    /// The same effects, with the parameters that they have in its place.
    #[serde(default)]
    pub look_alikes: Vec<EffectEstimate>,
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

/// An effect, and how large it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EffectEstimate {
    /// `NAME@BODY`.
    pub effect: String,
    /// Its parameters by name; empty where several throws have each its own.
    pub parameters: BTreeMap<String, ParameterEstimate>,
}

impl Rung {
    /// One that adds nothing yet, and knows nothing but its error in position, m.
    pub(super) fn of(position_rmse: f64) -> Rung {
        Rung {
            added: None,
            with: Vec::new(),
            p_value: None,
            parameters: BTreeMap::new(),
            is_shared: true,
            indistinguishable_from: Vec::new(),
            look_alikes: Vec::new(),
            position_rmse,
            orientation_rmse: None,
            reduced_chi2: None,
            heldout_position_rmse: None,
            mass_ratio: None,
            restitution: None,
        }
    }

    /// What it adds, how large that is, and what the poses can't tell it from; `None` of the first rung.
    pub fn in_words(&self) -> Option<String> {
        let added = match self.is_shared {
            true => with_values(self.added.as_ref()?, Some(&self.parameters)),
            false => format!("{} (each throw has its own)", self.added.as_ref()?),
        };
        // Older ladders have names alone.
        let sizes = |name: &String| {
            let known = self.look_alikes.iter().find(|other| other.effect == *name);
            with_values(name, known.map(|other| &other.parameters))
        };
        let others: Vec<String> = self.indistinguishable_from.iter().map(sizes).collect();
        Some(match others.as_slice() {
            [] => format!("{added}."),
            others => format!("{added}. These poses can't tell it from {}.", listed(others)),
        })
    }

    /// The rung with `effect` on it, and what else may be in its place.
    pub(super) fn adding(self, effect: EffectEstimate, look_alikes: Vec<EffectEstimate>) -> Rung {
        Rung {
            added: Some(effect.effect),
            parameters: effect.parameters,
            indistinguishable_from: look_alikes.iter().map(|one| one.effect.clone()).collect(),
            look_alikes,
            ..self
        }
    }
}

/// `NAME@BODY (k = 0.15 ± 0.01 1/m)`.
fn with_values(effect: &str, parameters: Option<&BTreeMap<String, ParameterEstimate>>) -> String {
    match parameters {
        Some(parameters) if !parameters.is_empty() => {
            format!("{effect} ({})", in_words(parameters))
        }
        _ => effect.to_string(),
    }
}

impl Improvement {
    /// The law that the catalogue hasn't got and that explains alone what no effect does.
    pub fn law_alone(&self) -> Option<&OtherLaw> {
        self.other_laws.first().filter(|_| self.ladder.len() == 1)
    }

    /// Whether the scene seems to be written otherwise than it is read.
    pub fn is_misread(&self) -> bool {
        self.otherwise.as_ref().is_some_and(Otherwise::is_misread)
    }

    /// What to film or measure to tell the rungs' effects from what else may be in their place.
    pub fn telling_apart(&self) -> Vec<String> {
        let alike = self.ladder.iter().filter(|rung| !rung.indistinguishable_from.is_empty());
        telling_apart(alike.flat_map(|rung| rung.added.iter().chain(&rung.indistinguishable_from)))
    }

    /// With its answer in words.
    pub(super) fn told(self) -> Improvement {
        Improvement { explanation: explanation(&self), ..self }
    }

    pub(super) fn new(scene: &Scene, ladder: Vec<Rung>, result: Reconstruction) -> Improvement {
        Improvement {
            schema: IMPROVEMENT_SCHEMA.to_string(),
            scene: scene.name().to_string(),
            ladder,
            dropped: Vec::new(),
            verdict: Verdict::UnknownEffect,
            result,
            other_laws: Vec::new(),
            otherwise: None,
            together: Vec::new(),
            explanation: String::new(),
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
