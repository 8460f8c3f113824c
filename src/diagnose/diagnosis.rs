//! The diagnosis as it stands in a file, `smash.diagnosis/1`.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::otherwise::Otherwise;
use super::rivals::OtherLaw;
use super::together::Together;
use super::unexplained::Unexplained;
use crate::Scene;
use crate::compare::ChannelTest;
use crate::reconstruct::{ActiveEffect, ParameterEstimate, Reconstruction};

/// The value of a diagnosis file's field `schema`.
pub const DIAGNOSIS_SCHEMA: &str = "smash.diagnosis/1";

/// Which effect the model of a scene lacks, and why one thinks so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.diagnosis/1")]
pub struct Diagnosis {
    /// Always `smash.diagnosis/1`.
    #[schemars(extend("const" = DIAGNOSIS_SCHEMA))]
    pub schema: String,
    /// The scene's name.
    pub scene: String,
    /// The answer.
    pub verdict: Verdict,
    /// The effects that the model has already.
    pub model: Vec<ActiveEffect>,
    /// How the residuals of that model look, by body, side of the collision and axis.
    pub channels: Vec<ChannelTest>,
    /// χ² over its degrees of freedom without any candidate; null where the scene states no noise.
    pub reduced_chi2: Option<f64>,
    /// The candidates, the best first: all that stand out, and the best of the others.
    pub candidates: Vec<CandidateReport>,
    /// How probable it is that nothing is missing, beside the candidates' probabilities.
    pub probability_of_nothing: f64,
    /// Whether even the best candidate leaves more than noise: then it may only be the nearest that
    /// the catalogue has.
    #[serde(default)]
    pub stays_structured: bool,
    /// The force, torque and swing that are left over, with the best candidate if one is missing, the
    /// clearest first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unexplained: Vec<Unexplained>,
    /// Laws of simple forms that the catalogue hasn't got, and that these poses can't tell from the
    /// best candidate, or prefer to it; the best first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub other_laws: Vec<OtherLaw>,
    /// Of several throws: their restitution and mass ratio put together, with the effect that is missing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub together: Vec<Together>,
    /// What else than missing physics may leave what is left: poses that aren't as the model takes them to
    /// be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub otherwise: Option<Otherwise>,
    /// The answer in plain words.
    pub explanation: String,
    /// What to film or measure to tell candidates apart, and the command to type next.
    pub advice: Vec<String>,
}

/// What a diagnosis finds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The model explains the poses to their noise, as far as these poses can tell.
    NothingMissing,
    /// The first of the candidates is missing, or one of those that can't be told apart from it.
    Missing,
    /// Something is missing that no candidate explains.
    UnknownEffect,
}

/// An effect that might be missing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CandidateReport {
    /// Its name.
    pub effect: String,
    /// The body that it acts on; null for all.
    pub body: Option<String>,
    /// By how much χ² falls with it; as improbable, where the noise is estimated.
    pub delta_chi2: f64,
    /// How many independent numbers it adds.
    pub parameters_added: usize,
    /// How often noise alone would seem such an effect, any of all candidates.
    pub p_value: f64,
    /// Among all candidates and none, each alone, by Schwarz's criterion.
    pub probability: f64,
    /// Whether it is significant, more probable than none, and predicts better.
    pub stands_out: bool,
    /// Root mean square in m of positions predicted from the other blocks of poses, without it.
    pub heldout_rmse_before: Option<f64>,
    /// The same with it.
    pub heldout_rmse_after: Option<f64>,
    /// χ² over its degrees of freedom with it; null where the scene states no noise.
    pub reduced_chi2: Option<f64>,
    /// Its parameters by name.
    pub parameters: BTreeMap<String, ParameterEstimate>,
    /// `NAME@BODY` of those that these poses can't tell from it.
    pub indistinguishable_from: Vec<String>,
    /// What the collision's numbers were without it and are with it.
    pub shifts: Vec<Shift>,
    /// Of several throws together: how they agree.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub throws: Option<Agreement>,
}

/// What several throws say of one effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Agreement {
    /// How often throws with the same parameters would differ as much, by noise alone; null of a
    /// single one.
    pub p_value: Option<f64>,
    /// How many times more they scatter than their own errors say, 1 and more; the deviations of the
    /// parameters are larger by as much (Birge's ratio).
    pub scatter: f64,
    /// Whether all throws are taken to have the same parameters; else each has its own.
    #[serde(default = "yes")]
    pub is_shared: bool,
    /// Each throw's own estimate.
    pub each: Vec<ThrowEstimate>,
}

/// Of what older files don't say.
pub(crate) fn yes() -> bool {
    true
}

/// What one throw says of an effect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ThrowEstimate {
    /// The scene's name.
    pub scene: String,
    /// Its parameters by name, with no other bounds than their size.
    pub parameters: BTreeMap<String, ParameterEstimate>,
}

/// A reported number that moves when an effect is added.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Shift {
    /// `mass_ratio` or `restitution`.
    pub quantity: String,
    /// Without the effect.
    pub before: f64,
    /// With it.
    pub after: f64,
    /// Over the deviation stated without it; null where none is.
    pub in_sigma: Option<f64>,
}

impl CandidateReport {
    /// `NAME@BODY`, or `NAME` where it acts on all: what `--with` takes.
    pub fn label(&self) -> String {
        match &self.body {
            Some(body) => format!("{}@{body}", self.effect),
            None => self.effect.clone(),
        }
    }
}

impl Diagnosis {
    /// Of `scene`, whose model gives `result` and `channels`, before anything was tried.
    pub(super) fn new(
        scene: &Scene,
        result: &Reconstruction,
        channels: Vec<ChannelTest>,
    ) -> Diagnosis {
        Diagnosis {
            schema: DIAGNOSIS_SCHEMA.to_string(),
            scene: scene.name().to_string(),
            verdict: Verdict::UnknownEffect,
            model: result.effects.clone(),
            channels,
            reduced_chi2: result.fit.reduced_chi2,
            candidates: Vec::new(),
            probability_of_nothing: 0.0,
            stays_structured: false,
            unexplained: Vec::new(),
            other_laws: Vec::new(),
            together: Vec::new(),
            otherwise: None,
            explanation: String::new(),
            advice: Vec::new(),
        }
    }

    /// What is missing, if that has a name.
    pub fn missing(&self) -> Option<&CandidateReport> {
        self.candidates.first().filter(|_| self.verdict == Verdict::Missing)
    }

    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self)
            .expect("plain numbers and strings always have a JSON form");
        text.push('\n');
        text
    }
}
