//! How long a diagnosis takes, and an improvement, on one core.

use std::time::Instant;

use smash::reconstruct::RefinedOptions;
use smash::{Error, ErrorKind, Result};

use crate::case::Case;
use crate::table::quantile;

/// The table of times, in Markdown.
///
/// # Errors
/// A case can't be reconstructed.
pub fn table(cases: &[Case]) -> Result<String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.map_err(|error| Error::new(ErrorKind::Invalid, error.to_string()))?;
    let options = RefinedOptions::default();
    let timed = |what: &(dyn Fn(&Case) -> Result<()> + Sync)| -> Result<String> {
        let mut seconds = Vec::new();
        for case in cases {
            let started = Instant::now();
            pool.install(|| what(case))?;
            seconds.push(started.elapsed().as_secs_f64());
        }
        Ok(format!("{:.2} s / {:.2} s", quantile(&seconds, 0.5), quantile(&seconds, 0.9)))
    };
    let diagnose = timed(&|case| smash::diagnose(&case.scene, &options, &[]).map(drop))?;
    let improve = timed(&|case| smash::improve(&case.scene, &options, &[]).map(drop))?;
    Ok(format!(
        "## Time for 2 × 20 poses on one core\n\n\
         | scenes | diagnose: median / 90 % | improve: median / 90 % |\n|---|---|---|\n\
         | {} | {diagnose} | {improve} |\n",
        cases.len(),
    ))
}
