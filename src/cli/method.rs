//! The options that choose the method, the same for every command that reconstructs.

use clap::{Args, ValueEnum};
use smash::reconstruct::{Options, PaperOptions, SegmentCriterion};

/// The method, as it was typed.
#[derive(Args)]
pub struct Method {
    /// The method. Without it: `paper` with `--segment-by cost`
    #[arg(long)]
    preset: Option<Preset>,
    /// What chooses between which two observations the bodies collided
    #[arg(long, value_name = "CRITERION")]
    segment_by: Option<SegmentBy>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Preset {
    /// The SMASH paper to the letter
    Paper,
}

#[derive(Clone, Copy, ValueEnum)]
enum SegmentBy {
    /// The paper's criterion: least distance of the two centres (default of `--preset paper`)
    Distance,
    /// Least cost of phase 1: right far more often
    Cost,
}

impl Method {
    /// What the library is asked for.
    pub fn options(&self) -> Options {
        let segment_by = match (self.preset, self.segment_by) {
            (_, Some(SegmentBy::Distance)) | (Some(Preset::Paper), None) => {
                SegmentCriterion::Distance
            }
            (_, Some(SegmentBy::Cost)) | (None, None) => SegmentCriterion::Cost,
        };
        Options::Paper(PaperOptions { segment_by, ..PaperOptions::default() })
    }
}
