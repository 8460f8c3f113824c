//! From a scene to a reconstruction.
//!
//! The presets share what they are given and what they answer: [`Scene`] in, [`Reconstruction`]
//! out; each has its own room.

pub(crate) mod active_effect;
mod collision;
mod flags;
mod made_with;
mod options;
mod paper;
mod progress;
mod read;
pub(crate) mod refined;
mod result;
mod scatter;

pub use active_effect::{ActiveEffect, Number, ParameterEstimate};
pub use flags::Flag;
pub use options::{Intervals, Loss, Options, PaperOptions, RefinedOptions, SegmentCriterion};
pub use progress::{Progress, Stage};
pub(crate) use read::check_numbers;
pub use result::{
    Alternative, BodyResult, Estimate, Fit, NoiseReport, Outlier, PhaseReport, Preset,
    RESULT_SCHEMA, Reconstruction, Uncertainty,
};

use crate::{Error, ErrorKind, Result, Scene};

/// Reconstructs the collision in `scene`.
///
/// The same scene and options give the same numbers to the last bit, on any number of threads
/// and however many reconstructions run at once.
///
/// # Errors
/// The optimiser finds no usable solution, or the scene is too large for the paper's method.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let result = smash::reconstruct(&scene, &smash::Options::default())?;
/// println!("m_b/m_a = {:?}", result.mass_ratio);
/// # Ok::<(), smash::Error>(())
/// ```
pub fn reconstruct(scene: &Scene, options: &Options) -> Result<Reconstruction> {
    reconstruct_with_progress(scene, options, &|_| {})
}

/// [`reconstruct`], telling `progress` of each step done, from any thread.
///
/// # Errors
/// As [`reconstruct`].
pub fn reconstruct_with_progress(
    scene: &Scene,
    options: &Options,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Reconstruction> {
    match options {
        Options::Paper(options) => paper::reconstruct(scene, options, progress),
        Options::Refined(options) => refined::reconstruct(scene, options),
    }
}

pub(crate) fn solver_error(error: cxx::Exception) -> Error {
    Error::new(ErrorKind::Solve, format!("the optimiser failed: {}", error.what()))
        .mend("look at the scene for poses far off their neighbours, and at its sizes")
}
