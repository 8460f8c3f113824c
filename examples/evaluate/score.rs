//! Errors against the truth, and their medians.

use smash::reconstruct::Flag;
use smash::{Reconstruction, Result};
use statrs::function::erf::erf;

use crate::cases::{Bound, Case};

/// One reconstruction against its truth.
pub struct Outcome {
    /// |m / m_true − 1|; infinite where none was found.
    pub mass_ratio_error: f64,
    /// |c − c_true|; infinite where none was found.
    pub restitution_error: f64,
    /// The collision was placed in the segment that holds it.
    right_segment: bool,
    /// The paper's signs of failure.
    flagged: bool,
    /// The least deviations possible, where the noise has any.
    pub bound: Option<Bound>,
    /// Why there is no result.
    pub failure: Option<String>,
}

impl Outcome {
    pub fn of(
        case: &Case,
        interval: u32,
        result: Result<Reconstruction>,
        bound: Option<Bound>,
    ) -> Outcome {
        match result {
            Ok(result) => Outcome { bound, ..Outcome::of_result(case, interval, &result) },
            Err(error) => Outcome {
                mass_ratio_error: f64::INFINITY,
                restitution_error: f64::INFINITY,
                right_segment: false,
                flagged: true,
                bound,
                failure: Some(error.to_string()),
            },
        }
    }

    fn of_result(case: &Case, interval: u32, result: &Reconstruction) -> Outcome {
        let mass_ratio = result.mass_ratio.as_ref().and_then(|m| m.value);
        let time_s = result.collision_time.value.unwrap_or(f64::INFINITY);
        let frames_off = (60.0 * time_s - case.collision_frame).abs();
        let is_failure =
            |flag: &Flag| matches!(flag, Flag::MassRatioAtBound | Flag::RestitutionOutOfRange);
        Outcome {
            mass_ratio_error: mass_ratio
                .map_or(f64::INFINITY, |m| (m / case.mass_ratio - 1.0).abs()),
            restitution_error: result
                .restitution
                .value
                .map_or(f64::INFINITY, |c| (c - case.restitution).abs()),
            // The gap is two intervals wide and the collision in its middle.
            right_segment: frames_off < f64::from(interval),
            flagged: result.flags.iter().any(is_failure),
            bound: None,
            failure: None,
        }
    }
}

/// All scenes with one noise, interval and method.
pub struct Score {
    pub noise_name: &'static str,
    pub interval: u32,
    pub method: &'static str,
    pub outcomes: Vec<Outcome>,
}

/// The table's heading, in Markdown.
pub const HEADING: &str = "\
| noise | interval | method | scenes | error of m: median / 90 % (bound) | error of c: median / 90 % (bound) | right segment | flagged | null |
|---|---|---|---|---|---|---|---|---|";

impl Score {
    /// A row of the table.
    pub fn row(&self) -> String {
        let count = self.outcomes.len();
        let percent = |is: fn(&Outcome) -> bool| {
            let hits = self.outcomes.iter().filter(|outcome| is(outcome)).count();
            format!("{:.0} %", 100.0 * hits as f64 / count as f64)
        };
        for failure in self.outcomes.iter().filter_map(|outcome| outcome.failure.as_ref()) {
            eprintln!("failed: {failure}");
        }
        format!(
            "| {} | {} | {} | {count} | {} / {}{} | {} / {}{} | {} | {} | {} |",
            self.noise_name,
            self.interval,
            self.method,
            two_digits(self.quantile(0.5, |o| o.mass_ratio_error)),
            two_digits(self.quantile(0.9, |o| o.mass_ratio_error)),
            self.bounds(|bound| bound.mass_ratio),
            two_digits(self.quantile(0.5, |o| o.restitution_error)),
            two_digits(self.quantile(0.9, |o| o.restitution_error)),
            self.bounds(|bound| bound.restitution),
            percent(|o| o.right_segment),
            percent(|o| o.flagged),
            percent(|o| o.mass_ratio_error.is_infinite()),
        )
    }

    /// The median and the 90th percentile of errors that are as small as can be; nothing where the
    /// noise is none or isn't Gaussian.
    fn bounds(&self, std: impl Fn(&Bound) -> f64) -> String {
        let stds: Vec<f64> =
            self.outcomes.iter().filter_map(|o| o.bound.as_ref()).map(std).collect();
        if stds.is_empty() {
            return String::new();
        }
        let [median, tail] = [0.5, 0.9].map(|share| two_digits(mixture_quantile(&stds, share)));
        format!(" ({median} / {tail})")
    }

    /// The quantile of an error over the scenes that have a number, linear between them; the other
    /// scenes are counted as null.
    pub fn quantile(&self, share: f64, error: impl Fn(&Outcome) -> f64) -> f64 {
        let mut errors: Vec<f64> =
            self.outcomes.iter().map(error).filter(|e| e.is_finite()).collect();
        if errors.is_empty() {
            return f64::NAN;
        }
        errors.sort_by(f64::total_cmp);
        let place = share * (errors.len() - 1) as f64;
        let (low, high) = (errors[place.floor() as usize], errors[place.ceil() as usize]);
        if low == high { low } else { low + (high - low) * place.fract() }
    }
}

/// The quantile of |x| where x is Gaussian with each of these deviations equally often.
fn mixture_quantile(stds: &[f64], share: f64) -> f64 {
    let below = |x: f64| stds.iter().map(|std| erf(x / (std * 2.0_f64.sqrt()))).sum::<f64>();
    let (mut low, mut high) = (0.0, 10.0 * stds.iter().fold(0.0_f64, |a, b| a.max(*b)));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) < share * stds.len() as f64 { low = middle } else { high = middle }
    }
    high
}

fn two_digits(value: f64) -> String {
    match value {
        ..0.001 => format!("{value:.0e}"),
        0.001..0.1 => format!("{value:.4}"),
        _ => format!("{value:.2}"),
    }
}
