//! The result as it stands in a file, `smash.result/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::{ActiveEffect, Flag, Intervals, Options, SegmentCriterion};
use crate::scene::Setting;

/// The value of a result file's field `schema`.
pub const RESULT_SCHEMA: &str = "smash.result/1";

/// How two bodies collided, as far as the poses tell. SI units, world frame, at the collision.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.result/1")]
pub struct Reconstruction {
    /// Always `smash.result/1`.
    #[schemars(extend("const" = RESULT_SCHEMA))]
    pub schema: String,
    /// The scene's name.
    pub scene: String,
    /// The method.
    pub preset: Preset,
    /// What it was made with: with the same scene, options and version of smash the same result comes
    /// again. Missing in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub options: Option<Options>,
    /// The SHA-256 of all that the scene says of the collision (not of its text, nor of the scene's
    /// name and source): of which poses the result is. Missing in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scene_fingerprint: Option<String>,
    /// What chose the segment.
    pub segment_by: SegmentCriterion,
    /// m_b / m_a; null without a second dynamic body.
    pub mass_ratio: Option<Estimate>,
    /// c = −(relative normal velocity after) / (before), SMASH eq. 15.
    pub restitution: Estimate,
    /// t_c in s.
    pub collision_time: Estimate,
    /// x_c in m. Along the impulse it isn't determined; this is the point of that line on the
    /// plane, or nearest to the middle between the centres. Null where no spin tells the line.
    pub contact_point: Option<[f64; 3]>,
    /// J on the reference body per unit of its mass, in N·s/kg; −J acts on the other.
    pub impulse: [f64; 3],
    /// Unit: J/|J| between two bodies, the plane's on a static one; null without an impulse.
    pub normal: Option<[f64; 3]>,
    /// The dynamic bodies, the reference body first.
    pub bodies: Vec<BodyResult>,
    /// The acceleration of free fall in the world, m/s², tilted as the fit found it. A file without
    /// it is read as having the scene's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<[f64; 3]>,
    /// Effects beyond the base model.
    pub effects: Vec<ActiveEffect>,
    /// The noise that the fit reckons with; missing in the `paper` preset, which has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<NoiseReport>,
    /// How sure the reported numbers are; missing in the `paper` preset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<Uncertainty>,
    /// Other optima that are nearly as good.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub alternatives: Vec<Alternative>,
    /// Poses that lie too far off to be noise, the worst first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub outliers: Vec<Outlier>,
    /// How the 95 % intervals were found; missing in the `paper` preset.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub intervals: Option<Intervals>,
    /// How well the model meets the poses.
    pub fit: Fit,
    /// The solver's phases; in the first, the chosen segment's.
    pub phases: Vec<PhaseReport>,
    /// What is doubtful.
    pub flags: Vec<Flag>,
    /// What looked odd in the scene.
    pub warnings: Vec<String>,
    /// Where and when the collision was seen: with it the motion can be flown again without the
    /// scene. Missing in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub setting: Option<Setting>,
}

/// How a scene is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Preset {
    /// The SMASH paper's energy.
    Paper,
    /// The most accurate solution: exact conservation, continuous time, residuals over the noise.
    Refined,
}

/// A number and how sure it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Estimate {
    /// The estimate; null where the data don't determine it.
    pub value: Option<f64>,
    /// One standard deviation; null where it can't be computed.
    pub std: Option<f64>,
    /// From and to: holds the truth in 95 of 100 collisions. Missing where it can't be computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interval_95: Option<[f64; 2]>,
    /// Why `value` or `std` is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Estimate {
    /// What the data don't tell, and why.
    pub(crate) fn unknown(reason: &str) -> Self {
        Estimate { value: None, std: None, interval_95: None, reason: Some(reason.to_string()) }
    }
}

/// The noise that residuals were divided by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NoiseReport {
    /// One σ of a position coordinate, m.
    pub position: f64,
    /// One σ of a component of the rotation vector, rad; null when no orientation was fitted.
    pub orientation: Option<f64>,
    /// Estimated from the residuals, not stated in the scene.
    pub estimated: bool,
    /// Why `orientation` is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// Another optimum that explains the poses nearly as well.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Alternative {
    /// What differs: the segment, or whole turns of a spin.
    pub differs_in: String,
    /// How much larger its χ² is: 4 is as improbable as two standard deviations.
    pub delta_chi2: f64,
    /// m_b / m_a; null without a second dynamic body.
    pub mass_ratio: Option<f64>,
    /// The restitution; null where the poses don't tell it.
    pub restitution: Option<f64>,
    /// t_c in s.
    pub collision_time: f64,
}

/// A pose that lies further off than one in a thousand would by the noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Outlier {
    /// The body's name.
    pub body: String,
    /// When, in s.
    pub time: f64,
    /// `position` or `orientation`.
    pub channel: String,
    /// How far off, in σ of a coordinate.
    pub deviations: f64,
}

/// Standard deviations and correlations of all reported numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Uncertainty {
    /// Names such as `mass_ratio`, `impulse.x` or, after a body's name, `a.velocity_after.x`. An
    /// orientation's three are turns about the world's axes, in rad. The parameters of the first
    /// effect are `effects[0].k`, or `effects[0].a.x`.
    pub quantities: Vec<String>,
    /// One standard deviation of each, in the unit of the quantity; null where the poses don't
    /// determine it.
    pub std: Vec<Option<f64>>,
    /// Row by row the correlation of each quantity with all up to itself; null where either is not
    /// determined or can't vary.
    pub correlation: Vec<Vec<Option<f64>>>,
}

/// A body at the moment of the collision.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BodyResult {
    /// The body's name in the scene.
    pub name: String,
    /// Centre of mass, m.
    pub position: [f64; 3],
    /// Quaternion [w, x, y, z], body to world; null when not measured.
    pub orientation: Option<[f64; 4]>,
    /// m/s.
    pub velocity_before: [f64; 3],
    /// m/s.
    pub velocity_after: [f64; 3],
    /// rad/s; null when the poses don't determine it.
    pub angular_velocity_before: Option<[f64; 3]>,
    /// rad/s; null when the poses don't determine it.
    pub angular_velocity_after: Option<[f64; 3]>,
    /// kg·m²/s with the reference body's mass 1; null with the angular velocity.
    pub angular_momentum_before: Option<[f64; 3]>,
    /// kg·m²/s with the reference body's mass 1; null with the angular velocity.
    pub angular_momentum_after: Option<[f64; 3]>,
    /// Why a rotation is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// How well the model meets the poses.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Fit {
    /// Root mean square over all position coordinates, m: to be compared with the noise.
    pub position_rmse: f64,
    /// Root mean square over all components of the residual rotation vectors, rad; null when no
    /// orientation was measured.
    pub orientation_rmse: Option<f64>,
    /// Sum of squared residuals over the stated noise; null when the scene states none.
    pub chi2: Option<f64>,
    /// Measured numbers minus free parameters of the model.
    pub dof: i64,
    /// chi2 / dof; null with either.
    pub reduced_chi2: Option<f64>,
    /// The energy at the end (SMASH eq. 16).
    pub cost: f64,
    /// Why a number is null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

impl Fit {
    /// Whether the stated noise alone leaves such residuals in fewer than one case of a thousand;
    /// false where none is stated.
    pub fn is_beyond_chance(&self) -> bool {
        const CHANCE: f64 = 1e-3;
        let law = ChiSquared::new(self.dof as f64).ok();
        self.chi2.zip(law).is_some_and(|(chi2, law)| law.sf(chi2) < CHANCE)
    }
}

/// One phase of the solver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PhaseReport {
    /// Of the paper `1 trajectories`, `2 impulse`, `3 contact point`; of the refined solver
    /// `1 flights`, `2 impulse`, `3 everything`, and then one for each effect, such as
    /// `4 quadratic_drag@a`.
    pub name: String,
    /// The energy at its start.
    pub cost_initial: f64,
    /// The energy at its end.
    pub cost_final: f64,
    /// Iterations of the optimiser.
    pub iterations: u32,
    /// Wall time in s, the only number that differs from run to run; null in a batch, whose scenes
    /// share the cores.
    pub seconds: Option<f64>,
}

impl Reconstruction {
    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self)
            .expect("plain numbers and strings always have a JSON form");
        text.push('\n');
        text
    }
}
