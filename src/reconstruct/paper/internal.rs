//! The scene as the paper's energy sees it: in the gravity frame, with time in frames.

use super::super::SegmentCriterion;
use super::gravity_frame::GravityFrame;
use crate::bridge::paper::ffi::{PaperBody, PaperObservation, PaperScene};
use crate::rigid_body::principal_inertia_per_mass;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::DynamicBody;
use crate::{Error, ErrorKind, Result, Scene};

/// The paper's own frame rate, for scenes with times and no frames.
const NOMINAL_FRAMES_PER_SECOND: f64 = 60.0;

/// Beyond this many Euler steps in one evaluation of all segments the search takes more than some
/// ten minutes on a core: 4e6 take about 20 s (`benches/reconstruct.rs` has such scenes).
const MOST_EULER_STEPS: f64 = 1e8;

/// A scene turned into the paper's terms, with the way back.
pub(super) struct InternalScene {
    pub(super) paper: PaperScene,
    pub(super) frame: GravityFrame,
}

impl InternalScene {
    /// # Errors
    /// The scene is so long or so dense that the paper's method would not come to an end.
    pub(super) fn new(scene: &Scene) -> Result<Self> {
        let frame = GravityFrame::new(&scene.up_in_world());
        let frames_per_second = scene.fps().unwrap_or(NOMINAL_FRAMES_PER_SECOND);
        let bodies = scene.bodies().iter().map(|body| paper_body(body, frames_per_second, &frame));
        let plane = scene.plane();
        let paper = PaperScene {
            frames_per_second,
            gravity_m_s2: scene.gravity_m_s2(),
            bodies: bodies.collect(),
            plane_normal: plane
                .map_or([0.0; 3], |plane| frame.vector_from_world(&plane.normal_in_world)),
            plane_height_m: plane.map_or(0.0, |plane| plane.height_m),
        };
        check_work(&paper)?;
        Ok(InternalScene { paper, frame })
    }

    pub(super) fn has_partner_or_plane(&self) -> bool {
        self.paper.bodies.len() == 2 || self.paper.plane_normal != [0.0; 3]
    }

    /// The collision times to search through, in frames: the middle of each gap between
    /// observations. By cost only gaps with two poses a side: a single pose on a side fits any
    /// parabola at no cost.
    pub(super) fn collision_frames(&self, scene: &Scene, by: SegmentCriterion) -> Vec<f64> {
        let gaps = match by {
            SegmentCriterion::Distance => scene.all_gaps(),
            SegmentCriterion::Cost => scene.gaps(),
        };
        gaps.iter().map(|gap| gap.midpoint_s() * self.paper.frames_per_second).collect()
    }

    pub(super) fn seconds(&self, frames: f64) -> f64 {
        frames / self.paper.frames_per_second
    }
}

fn paper_body(body: &DynamicBody, frames_per_second: f64, frame: &GravityFrame) -> PaperBody {
    let observations: Vec<_> = body
        .observations
        .iter()
        .map(|observation| PaperObservation {
            time_frames: observation.time_s * frames_per_second,
            position: frame.vector_from_world(&observation.position_in_world),
            orientation: observation
                .world_from_body
                .map_or([1.0, 0.0, 0.0, 0.0], |q| to_wxyz(&frame.orientation_from_world(&q))),
            has_orientation: observation.world_from_body.is_some(),
        })
        .collect();
    PaperBody {
        inertia_per_mass: principal_inertia_per_mass(&body.shape).into(),
        // One orientation alone says nothing of the spin.
        has_spin: observations.iter().filter(|o| o.has_orientation).count() >= 2,
        observations,
    }
}

/// Refuses what would seem to hang: every segment integrates from its middle to every pose.
fn check_work(paper: &PaperScene) -> Result<()> {
    let times = || {
        let turning = paper.bodies.iter().filter(|body| body.has_spin);
        turning.flat_map(|b| &b.observations).filter(|o| o.has_orientation).map(|o| o.time_frames)
    };
    let first = times().fold(f64::INFINITY, f64::min);
    let last = times().fold(f64::NEG_INFINITY, f64::max);
    let poses = times().count() as f64;
    let steps = poses * poses * 4.0 * (last - first) / 3.0;
    // Without orientations there is nothing to integrate: `last` - `first` is then -infinity.
    if steps.is_nan() || steps <= MOST_EULER_STEPS {
        return Ok(());
    }
    let problem = format!(
        "{poses} poses over {:.0} frames are too many for the paper's method, which tries every \
         segment and steps a quarter frame at a time",
        last - first
    );
    Err(Error::new(ErrorKind::Invalid, problem)
        .at("bodies")
        .mend("keep the poses near the collision, or every n-th of them; check `fps` and `time`"))
}
