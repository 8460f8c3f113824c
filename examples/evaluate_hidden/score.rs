//! What the fits miss, and their medians.

use smash::{Reconstruction, Result};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::case::Case;

/// A scene fitted without its effects, and with them.
pub struct Outcome {
    base: Errors,
    with: Errors,
}

/// A fit against the truth; infinite where the fit tells nothing.
#[derive(Clone, Copy)]
struct Errors {
    chi2: f64,
    dof: f64,
    /// |m / m_true − 1|; `None` against a static body.
    mass_ratio: Option<f64>,
    restitution: f64,
}

impl Outcome {
    pub fn of(case: &Case, base: Result<Reconstruction>, with: Result<Reconstruction>) -> Outcome {
        Outcome { base: Errors::of(case, base), with: Errors::of(case, with) }
    }
}

impl Errors {
    fn of(case: &Case, result: Result<Reconstruction>) -> Errors {
        let result = match result {
            Ok(result) => Some(result),
            Err(error) => {
                eprintln!("failed: {}: {error}", case.kind());
                None
            }
        };
        let result = result.as_ref();
        let found = |pick: fn(&Reconstruction) -> Option<f64>| {
            result.and_then(pick).unwrap_or(f64::INFINITY)
        };
        let mass_ratio = found(|result| result.mass_ratio.as_ref()?.value);
        Errors {
            chi2: found(|result| result.fit.chi2),
            dof: found(|result| Some(result.fit.dof as f64)),
            mass_ratio: case.mass_ratio.map(|truth| (mass_ratio / truth - 1.0).abs()),
            restitution: (found(|result| result.restitution.value) - case.restitution).abs(),
        }
    }

    /// Whether χ² is where it is in 95 of 100 fits by the right model.
    fn is_in_band(&self) -> bool {
        let Ok(distribution) = ChiSquared::new(self.dof) else { return false };
        (0.025..=0.975).contains(&distribution.cdf(self.chi2))
    }
}

/// The table's heading, in Markdown.
pub const HEADING: &str = "\
| hidden | scenes | χ² base | χ² with | dof | χ² in its 95 % band | error of m base: median / 90 % | with | error of c base: median / 90 % | with | null |
|---|---|---|---|---|---|---|---|---|---|---|";

/// A row of the table.
pub fn row(kind: &str, outcomes: &[Outcome]) -> String {
    let median = |pick: fn(&Outcome) -> f64| {
        format!("{:.0}", quantile(outcomes.iter().map(pick).collect(), 0.5))
    };
    let spread = |values: Vec<f64>| match values.is_empty() {
        true => "none".to_owned(),
        false => format!("{:.4} / {:.4}", quantile(values.clone(), 0.5), quantile(values, 0.9)),
    };
    let masses =
        |pick: fn(&Outcome) -> Option<f64>| spread(outcomes.iter().filter_map(pick).collect());
    let restitutions = |pick: fn(&Outcome) -> f64| spread(outcomes.iter().map(pick).collect());
    // What isn't determined has no error: it is counted.
    let is_null = |errors: &Errors| {
        errors.restitution.is_infinite() || errors.mass_ratio.is_some_and(f64::is_infinite)
    };
    let null = outcomes.iter().filter(|outcome| is_null(&outcome.with)).count();
    let in_band = outcomes.iter().filter(|outcome| outcome.with.is_in_band()).count();
    format!(
        "| {kind} | {} | {} | {} | {} | {in_band} | {} | {} | {} | {} | {null} |",
        outcomes.len(),
        median(|o| o.base.chi2),
        median(|o| o.with.chi2),
        median(|o| o.with.dof),
        masses(|o| o.base.mass_ratio),
        masses(|o| o.with.mass_ratio),
        restitutions(|o| o.base.restitution),
        restitutions(|o| o.with.restitution),
    )
}

/// The value below which this share of them is, of those that are finite.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.retain(|value| value.is_finite());
    values.sort_by(f64::total_cmp);
    let place = share * (values.len().max(1) - 1) as f64;
    values.get(place.round() as usize).copied().unwrap_or(f64::NAN)
}
