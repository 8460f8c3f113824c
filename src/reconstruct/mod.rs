//! From a scene to a reconstruction: the paper's three phases and its segment search.
//!
//! ```text
//! scene ─► internal scene ─► segment search ─► phase 2 ─► phase 3 ─► reconstruction
//!          (gravity frame)   (phase 1 in each) (impulse)  (contact)  (world, SI, flags)
//! ```

#[cfg(test)]
mod energy_tests;
mod fit;
mod flags;
mod gravity_frame;
mod internal;
mod phases;
mod progress;
mod push;
mod report;
mod result;
mod scatter;
mod segment_search;
mod start;
mod states;

pub use flags::Flag;
pub use progress::{Progress, Stage};
pub use result::{
    BodyResult, Effect, Estimate, Fit, Parameter, PhaseReport, Preset, RESULT_SCHEMA,
    Reconstruction,
};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Error, ErrorKind, Result, Scene};

/// How to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Options {
    /// Which segment of the search is kept.
    pub segment_by: SegmentCriterion,
    /// Seeds the paper's random start of the impulse.
    pub seed: u64,
}

impl Options {
    /// The paper to the letter: its energy, its phases, its criterion.
    pub fn paper() -> Self {
        Options { segment_by: SegmentCriterion::Distance, seed: 0 }
    }
}

impl Default for Options {
    /// The paper's energy with the criterion that finds the right segment far more often.
    fn default() -> Self {
        Options { segment_by: SegmentCriterion::Cost, ..Options::paper() }
    }
}

/// What the right segment has least of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum SegmentCriterion {
    /// The paper's: distance of the two centres at the collision, or of the centre from the plane.
    Distance,
    /// The cost that phase 1 ends with.
    Cost,
}

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
    let internal = internal::InternalScene::new(scene)?;
    if options.segment_by == SegmentCriterion::Distance && !internal.has_partner_or_plane() {
        let problem = "a single body without a plane has no distance to choose the segment by";
        return Err(Error::new(ErrorKind::Invalid, problem)
            .at("bodies")
            .mend("add the other body or a static plane, or use `--segment-by cost`"));
    }
    let collision_frames = internal.collision_frames(scene, options.segment_by);
    let solved = phases::solve(&internal.paper, &collision_frames, options, progress)?;
    report::reconstruction(scene, &internal, options, &solved)
}

fn solver_error(error: cxx::Exception) -> Error {
    Error::new(ErrorKind::Solve, format!("the optimiser failed: {}", error.what()))
        .mend("look at the scene for poses far off their neighbours, and at its sizes")
}
