//! All that the page shows, `smash.studio/1`.

use std::ops::RangeInclusive;

use schemars::JsonSchema;
use serde::Serialize;

use super::edits::Edits;
use super::tree::Numbers;
use crate::report::Report;
use crate::scene::bounds::{NOISE, NOISE_SCALE};

/// The value of a state's field `schema`.
pub const STUDIO_SCHEMA: &str = "smash.studio/1";

/// What a studio shows. SI units, world frame.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[schemars(title = "smash.studio/1")]
pub struct StudioState {
    /// Always `smash.studio/1`.
    #[schemars(extend("const" = STUDIO_SCHEMA))]
    pub schema: String,
    /// Another one whenever anything has changed, larger than before.
    pub revision: u64,
    /// Which session it is: the same whenever its file is opened, of another file another. Browsers keep
    /// things under it.
    pub session: String,
    /// Where the session is saved after each act.
    pub session_file: String,
    /// The variant that is seen.
    pub current: usize,
    /// Where undo leads; null at the first.
    pub undo: Option<usize>,
    /// Where redo leads; null where nothing was undone.
    pub redo: Option<usize>,
    /// All that were tried, by their numbers. None is ever deleted.
    pub variants: Vec<VariantView>,
    /// Further ones that are shown beside the current one.
    pub compared: Vec<usize>,
    /// What is changed of the poses, in the current one.
    pub edits: Edits,
    /// How large and small stated noise may be.
    pub limits: Limits,
    /// The effects that smash knows.
    pub catalogue: Vec<CatalogueEffect>,
    /// The user's own.
    pub laws: Vec<LawView>,
    /// The law that is being typed.
    pub draft: String,
    /// Of the current variant, then of those compared. All poses are in it, also those that the fit
    /// leaves out; tests of the residuals are of the others.
    pub report: Report,
}

/// The least and the most of what can be stated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct Limits {
    /// One σ of the noise, m or rad.
    pub noise: [f64; 2],
    /// A pose's own σ over that of the noise.
    pub noise_scale: [f64; 2],
}

impl Limits {
    /// Those of scenes.
    pub(super) fn new() -> Limits {
        let ends = |range: RangeInclusive<f64>| [*range.start(), *range.end()];
        Limits { noise: ends(NOISE), noise_scale: ends(NOISE_SCALE) }
    }
}

/// A model that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct VariantView {
    /// Its number.
    pub id: usize,
    /// The variant that it was made from; null of the first.
    pub parent: Option<usize>,
    /// What was changed, in a few words.
    pub did: String,
    /// Labels of its effects, such as `quadratic_drag@a`.
    pub effects: Vec<String>,
    /// How well it fits.
    #[serde(flatten)]
    pub numbers: Numbers,
}

/// An effect of the catalogue.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct CatalogueEffect {
    /// Its name.
    pub name: String,
    /// What it is, in a few words.
    pub title: String,
    /// How it shows in poses and residuals.
    pub looks_like: String,
    /// How to tell it from what it is confused with.
    pub tell_apart: String,
    /// What can be added to the current variant, such as `quadratic_drag@a`.
    pub labels: Vec<String>,
    /// Why the scene can't show it; null where it can.
    pub reason: Option<String>,
}

/// A law of the user's own.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct LawView {
    /// Its name.
    pub name: String,
    /// Its file.
    pub text: String,
    /// What can be added to the current variant, such as `tether@a`.
    pub labels: Vec<String>,
}
