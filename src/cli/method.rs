//! The options that choose the method, the same for every command that reconstructs.

use clap::error::ErrorKind;
use clap::{Args, ValueEnum};
use smash::effect::EffectRequest;
use smash::reconstruct::{
    Intervals, Loss, Options, PaperOptions, RefinedOptions, SegmentCriterion,
};

/// The method, as it was typed.
#[derive(Args)]
pub struct Method {
    /// The method
    #[arg(long, default_value = "refined")]
    preset: Preset,
    /// Between which two observations the bodies collided. The refined method goes by cost
    #[arg(long, value_name = "CRITERION")]
    segment_by: Option<SegmentBy>,
    /// How sure the scene's `up` is: one standard deviation in degrees (refined method)
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = positive)]
    tilt_std: Option<f64>,
    /// Let a few wrong annotations hardly count (refined method)
    #[arg(long)]
    robust: bool,
    /// How the 95 % intervals are found (refined method)
    #[arg(long, value_name = "HOW", default_value = "covariance")]
    intervals: IntervalsBy,
    /// An effect beyond the base model, by its name or its file: NAME[@BODY][:parameter=value,…].
    /// May be given several times (refined method)
    #[arg(long, value_name = "EFFECT")]
    with: Vec<String>,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum IntervalsBy {
    /// From the covariance at the optimum
    Covariance,
    /// From the profile likelihood of mass ratio, restitution and collision time: slower
    Profile,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
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
    ///
    /// # Errors
    /// An effect isn't one, or its file is faulty.
    pub fn options(&self) -> smash::Result<Options> {
        match self.preset {
            Preset::Paper => Ok(self.paper()),
            Preset::Refined => self.refined().map(Options::Refined),
        }
    }

    fn paper(&self) -> Options {
        let asks_refined =
            self.robust || self.tilt_std.is_some() || self.intervals != IntervalsBy::Covariance;
        if asks_refined || !self.with.is_empty() {
            usage_error(
                "the paper's method has no `--with`, `--tilt-std`, `--robust` or `--intervals`: \
                 leave them out",
            );
        }
        let segment_by = match self.segment_by {
            Some(SegmentBy::Cost) => SegmentCriterion::Cost,
            Some(SegmentBy::Distance) | None => SegmentCriterion::Distance,
        };
        Options::Paper(PaperOptions { segment_by, ..PaperOptions::default() })
    }

    /// The refined method's options; a usage error as [`Method::options`].
    ///
    /// # Errors
    /// As [`Method::options`].
    pub fn refined(&self) -> smash::Result<RefinedOptions> {
        if self.preset == Preset::Paper {
            usage_error("effects are sought by the refined method: leave `--preset paper` out");
        }
        if matches!(self.segment_by, Some(SegmentBy::Distance)) {
            usage_error("`--segment-by distance` is the paper's criterion: add `--preset paper`");
        }
        if self.robust && self.intervals == IntervalsBy::Profile {
            usage_error("`--intervals profile` is of least squares: leave it or `--robust` out");
        }
        let default = RefinedOptions::default();
        Ok(RefinedOptions {
            tilt_std_rad: self.tilt_std.map_or(default.tilt_std_rad, f64::to_radians),
            loss: if self.robust { Loss::Robust } else { Loss::Squares },
            intervals: match self.intervals {
                IntervalsBy::Covariance => Intervals::Covariance,
                IntervalsBy::Profile => Intervals::Profile,
            },
            effects: self
                .with
                .iter()
                .map(|text| EffectRequest::parse(text))
                .collect::<smash::Result<_>>()?,
        })
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (1e-6..=90.0).contains(&value) => Ok(value),
        _ => Err("give an angle above 0, from 1e-6 to 90".to_string()),
    }
}

fn usage_error(problem: &str) -> ! {
    super::usage_error(ErrorKind::ArgumentConflict, problem)
}
