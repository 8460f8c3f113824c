//! When the bodies are seen.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scene::bounds::MOST_OBSERVATIONS;
use crate::scene::{ObservationFile, SceneFile};

/// A collision farther off is taken to be here; up to here f64 holds every whole and half frame.
const FARTHEST_FRAME: f64 = 1e15;

/// When a body is seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Sampling {
    /// At these frames; frame n is at n / fps.
    Frames(Vec<f64>),
    /// At these times, in s.
    Times(Vec<f64>),
    /// At regular frames with a gap around the collision, as in the paper's section 5.1.
    Regular(RegularSampling),
}

/// Every `interval`-th frame of a film, counted from the collision outwards on both sides.
///
/// An annotator can't see the collision itself: `gap` frames lie between the last pose before it
/// and the first one after it, as centred as whole frames allow.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RegularSampling {
    /// Frames from one pose to the next.
    #[schemars(range(min = 1))]
    pub interval: u32,
    /// The film's length: frames 0 to `frame_count` − 1 exist.
    #[schemars(range(min = 1))]
    pub frame_count: u32,
    /// Frames across the collision; twice the interval when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub gap: Option<u32>,
}

impl RegularSampling {
    /// Every frame of a film of `frame_count` frames.
    pub fn every_frame(frame_count: u32) -> Self {
        RegularSampling { interval: 1, frame_count, gap: Some(1) }
    }

    /// The frame numbers, in order, for a collision at `collision_frame` (rarely a whole number).
    ///
    /// No more than 100 000 on each side, those nearest the collision: no scene holds more.
    ///
    /// Of 90 frames with an interval of 19 and a collision at frame 45: 7, 26, 64 and 83.
    pub fn frame_numbers(&self, collision_frame: f64) -> Vec<u32> {
        let interval = i64::from(self.interval.max(1));
        let gap = self.gap.unwrap_or(self.interval.saturating_mul(2));
        let middle = collision_frame.clamp(-FARTHEST_FRAME, FARTHEST_FRAME);
        let last_before = (middle - f64::from(gap) / 2.0).round() as i64;
        let first_after = last_before + i64::from(gap);
        let last_frame = i64::from(self.frame_count) - 1;
        // Frames off the film are stepped over, not walked through.
        let steps_over = |frames: i64| interval * ((frames.max(0) + interval - 1) / interval);
        let latest = last_before - steps_over(last_before - last_frame);
        let earliest = first_after + steps_over(-first_after);
        let interval = interval as usize;
        let before = (0..=latest).rev().step_by(interval).take(MOST_OBSERVATIONS);
        let after = (earliest..=last_frame).step_by(interval).take(MOST_OBSERVATIONS);
        let mut frames: Vec<u32> = before.chain(after).map(|frame| frame as u32).collect();
        frames.sort_unstable();
        // Without a gap both sides hold the frame between them.
        frames.dedup();
        frames
    }
}

/// The same scene with only those observations whose frame is one of `frame_numbers`, as
/// [`RegularSampling::frame_numbers`] gives them; observations by time are dropped.
#[must_use]
pub fn keep_frames(mut scene_file: SceneFile, frame_numbers: &[u32]) -> SceneFile {
    let is_kept = |observation: &ObservationFile| {
        frame_numbers.iter().any(|&number| observation.frame == Some(f64::from(number)))
    };
    for observations in scene_file.bodies.iter_mut().filter_map(|body| body.observations.as_mut()) {
        observations.retain(is_kept);
    }
    scene_file
}
