//! The options that choose the method, the same for every command that reconstructs.

use clap::error::ErrorKind;
use clap::{Args, CommandFactory, ValueEnum};
use smash::reconstruct::{Options, PaperOptions, RefinedOptions, SegmentCriterion};

/// The method, as it was typed.
#[derive(Args)]
pub struct Method {
    /// The method
    #[arg(long, default_value = "refined")]
    preset: Preset,
    /// Between which two observations the bodies collided. The refined method goes by cost
    #[arg(long, value_name = "CRITERION")]
    segment_by: Option<SegmentBy>,
}

#[derive(Clone, Copy, ValueEnum)]
enum Preset {
    /// The SMASH paper to the letter
    Paper,
    /// The most accurate solution, with its uncertainty
    Refined,
}

#[derive(Clone, Copy, ValueEnum)]
enum SegmentBy {
    /// The paper's criterion: least distance of the two centres (default of `--preset paper`)
    Distance,
    /// Least cost: right far more often
    Cost,
}

impl Method {
    /// What the library is asked for; ends the program with a usage error if that contradicts
    /// itself.
    pub fn options(&self) -> Options {
        let paper =
            |segment_by| Options::Paper(PaperOptions { segment_by, ..PaperOptions::default() });
        match (self.preset, self.segment_by) {
            (Preset::Paper, Some(SegmentBy::Cost)) => paper(SegmentCriterion::Cost),
            (Preset::Paper, _) => paper(SegmentCriterion::Distance),
            (Preset::Refined, Some(SegmentBy::Distance)) => super::Arguments::command()
                .error(
                    ErrorKind::ArgumentConflict,
                    "`--segment-by distance` is the paper's criterion: add `--preset paper`",
                )
                .exit(),
            (Preset::Refined, _) => Options::Refined(RefinedOptions::default()),
        }
    }
}
