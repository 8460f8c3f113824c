//! The paper's three phases and its segment search, to the letter.
//!
//! ```text
//! scene ─► internal scene ─► segment search ─► phase 2 ─► phase 3 ─► reconstruction
//!          (gravity frame)   (phase 1 in each) (impulse)  (contact)  (world, SI, flags)
//! ```

#[cfg(test)]
mod energy_tests;
mod fit;
mod gravity_frame;
mod internal;
mod phases;
mod push;
mod report;
mod segment_search;
mod start;
mod states;

use super::{PaperOptions, Progress, Reconstruction, SegmentCriterion, solver_error};
use crate::{Error, ErrorKind, Result, Scene};

/// Reconstructs the collision in `scene` as the paper does.
pub(super) fn reconstruct(
    scene: &Scene,
    options: &PaperOptions,
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
