//! The answer as it stands in a file, `smash.power/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::json::pretty;
use crate::reconstruct::Number;
use crate::scene::Noise;

/// The value of the file's field `schema`.
pub const POWER_SCHEMA: &str = "smash.power/1";

/// What a planned film could show of an effect. SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(title = "smash.power/1")]
pub struct Power {
    /// Always `smash.power/1`.
    #[schemars(extend("const" = POWER_SCHEMA))]
    pub schema: String,
    /// The specification's name.
    pub scene: String,
    /// The effect's name.
    pub effect: String,
    /// The body that it acts on; null for all.
    pub body: Option<String>,
    /// What the film's annotations are planned to have.
    pub noise: Noise,
    /// Annotated poses of all bodies.
    pub poses: usize,
    /// How many candidates a diagnosis tries: the more, the more must stand out.
    pub candidates_tried: usize,
    /// One answer for each direction in which the effect can grow.
    pub axes: Vec<AxisPower>,
    /// The answer in plain words.
    pub explanation: String,
}

/// A parameter that grows from its null in one direction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AxisPower {
    /// The parameter's name.
    pub parameter: String,
    /// Of the parameter and of all sizes.
    pub unit: String,
    /// The value at which the effect does nothing.
    pub null: Number,
    /// 1 or −1, or a unit vector: a size s is the value null + s · direction.
    pub direction: Number,
    /// The least size that is found in one of two films; null where no size is.
    pub least_size_50: Option<f64>,
    /// The least size that is found in nine of ten films; null where no size is.
    pub least_size_90: Option<f64>,
    /// The size that all that follows is about: the one asked for, or the effect's typical one.
    pub size: f64,
    /// The probability that a diagnosis finds it.
    pub power: f64,
    /// χ² of the model without the effect, fitted to poses without noise: the noncentrality of the
    /// test.
    pub chi2: f64,
    /// What χ² must fall by, for the effect to be both significant among all candidates and more
    /// probable than none.
    pub critical_chi2: f64,
    /// Independent numbers that the effect adds.
    pub parameters: usize,
    /// With more or fewer frames within the same times.
    pub frames: Vec<Changed>,
    /// With more or less noise.
    pub noise: Vec<Changed>,
    /// What the collision's numbers become where the effect is overlooked.
    pub bias: Vec<Bias>,
    /// What else it could be taken for; null where no candidate stands out.
    pub alike: Option<Alike>,
}

/// The power in a film that differs in one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Changed {
    /// So many times the intervals between frames, or the noise.
    pub factor: f64,
    /// Annotated poses of all bodies; null where there is no such film.
    pub poses: Option<usize>,
    /// χ² without the effect, as above.
    pub chi2: Option<f64>,
    /// The probability that the effect is found.
    pub power: Option<f64>,
    /// Why the numbers are null.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reason: Option<String>,
}

/// A number of the collision that an overlooked effect moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Bias {
    /// `mass_ratio` or `restitution`.
    pub quantity: String,
    /// As the film is planned.
    pub truth: f64,
    /// As a model without the effect finds it in poses without noise.
    pub found: f64,
    /// The difference over the deviation that this model states; null where it states none.
    pub in_sigma: Option<f64>,
}

/// Effects that explain a film nearly as well.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Alike {
    /// The effect's size: the one asked for or, if larger, the least one that is found in nine of ten
    /// films.
    pub size: f64,
    /// `NAME@BODY` of those whose Schwarz criterion is within 6 of its own.
    pub effects: Vec<String>,
}

impl Power {
    /// `NAME@BODY`, or `NAME` where it acts on all.
    pub fn label(&self) -> String {
        match &self.body {
            Some(body) => format!("{}@{body}", self.effect),
            None => self.effect.clone(),
        }
    }

    /// The file's text: JSON, with a final newline.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}

impl AxisPower {
    /// The parameter's value at `size`.
    pub fn value(&self, size: f64) -> Number {
        let parts = self.null.components().iter().zip(self.direction.components());
        parts.map(|(null, part)| null + size * part).collect::<Vec<f64>>().into()
    }
}
