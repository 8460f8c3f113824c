//! What the demo says, step by step.

use smash::compare::Comparison;
use smash::diagnose::Diagnosis;
use smash::improve::Improvement;
use smash::reconstruct::{Estimate, Number, Reconstruction};
use smash::simulate::{Simulation, Truth};

use super::super::improve::table_of;
use super::super::table::{aligned, decimals, digits_of, millimetres};

pub const FIT: &str = "How did they collide? Gravity and one impulse, that is the base model";
pub const MISFIT: &str = "Where does it miss the poses?";
pub const MISSING: &str = "Which effect is missing?";
pub const LADDER: &str = "Add what is missing, until nothing is, and watch the error fall";
pub const TRUTH: &str = "With what was found, beside the truth";
pub const REPORT: &str = "Look at it";

/// Findings that are told; the others say the same of the other body.
const MOST_FINDINGS: usize = 3;

pub fn opening(simulation: &Simulation) -> String {
    let bodies = simulation.scene.bodies();
    let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    let poses: usize = bodies.iter().map(|body| body.observations.len()).sum();
    let noise = simulation.scene.noise();
    let noise = noise.map_or(String::new(), |noise| {
        let (length, angle) = (1e3 * noise.position, noise.orientation.to_degrees());
        format!(", each good to {length} mm and {angle:.1}°")
    });
    let words = format!(
        "A spinning {} meet in mid-air. All that is known are {poses} poses from a film{noise}. The \
         film is simulated, and something acts in it that the model doesn't know: what it is comes at \
         the end. Below each question is the command that answers it.",
        names.join(" and a "),
    );
    wrapped(&words)
}

pub fn step(number: usize, title: &str, command: &str) -> String {
    format!("\n{number}. {title}\n\n   $ {command}\n\n")
}

pub fn fit(base: &Reconstruction) -> String {
    let mass_ratio = base.mass_ratio.as_ref().map_or("-".to_string(), number);
    let noise = base.noise.as_ref().map_or(f64::NAN, |noise| noise.position);
    wrapped(&format!(
        "mass ratio {mass_ratio}, restitution {}. But it misses the poses by {}: {} times their noise.",
        number(&base.restitution),
        millimetres(base.fit.position_rmse),
        decimals(base.fit.position_rmse / noise, 1),
    ))
}

pub fn misfit(comparison: &Comparison) -> String {
    let findings = comparison.results.iter().flat_map(|result| &result.findings);
    findings.take(MOST_FINDINGS).map(|finding| format!("   {finding}\n")).collect()
}

pub fn missing(diagnosis: &Diagnosis) -> String {
    wrapped(&diagnosis.explanation)
}

pub fn ladder(improvement: &Improvement) -> String {
    let rows = aligned(&table_of(&improvement.ladder));
    rows.lines().map(|line| format!(" {line}\n")).collect()
}

/// What each model says, beside what the scene was made with.
pub fn truth(base: &Reconstruction, better: &Reconstruction, truth: &Truth) -> String {
    let ratio = |result: &Reconstruction| result.mass_ratio.as_ref().map_or("-".into(), number);
    let row = |name: &str, base: String, better: String, truth: String| {
        vec![format!(" {name}"), base, better, truth]
    };
    let mut rows = vec![
        row("", "base model".into(), "with it".into(), "truth".into()),
        row(
            "mass ratio",
            ratio(base),
            ratio(better),
            truth.mass_ratio.map_or("-".into(), |ratio| ratio.to_string()),
        ),
        row(
            "restitution",
            number(&base.restitution),
            number(&better.restitution),
            truth.restitution.to_string(),
        ),
        row(
            "collision at, s",
            number(&base.collision_time),
            number(&better.collision_time),
            truth.collision_time.to_string(),
        ),
    ];
    for effect in &better.effects {
        for (name, found) in &effect.parameters {
            let label = effect.label();
            let is_it = |hidden: &&smash::simulate::EffectSpec| {
                hidden.name == effect.name && hidden.body == effect.body
            };
            let hidden = truth.effects.iter().find(is_it);
            let hidden = hidden.and_then(|hidden| hidden.parameters.get(name));
            let of_truth = hidden.map_or("none".into(), |hidden| numbers(hidden, None));
            let value = found.value.as_ref().map_or("-".into(), |v| numbers(v, found.std.as_ref()));
            rows.push(row(&format!("{name} of {label}"), "-".into(), value, of_truth));
        }
    }
    aligned(&rows)
}

/// `report`: where the page is, if there is one.
pub fn closing(report: Option<&str>, is_open: bool) -> String {
    let seen = "the collision in 3D, where each model misses, what is missing, all numbers";
    let look = match report {
        Some(report) if is_open => format!("{report} is open in the browser: {seen}."),
        Some(report) => format!("Open {report} in a browser: {seen}."),
        None => "No report: this smash was built without its page. `smash doctor` says what it \
                 needs."
            .to_string(),
    };
    wrapped(&look)
        + "\nWith poses of your own: smash import poses.csv -o scene.json, and on from step 1.\n"
}

fn number(estimate: &Estimate) -> String {
    match (estimate.value, estimate.std) {
        (Some(value), Some(std)) => numbers(&Number::Scalar(value), Some(&Number::Scalar(std))),
        (Some(value), None) => decimals(value, 4),
        (None, _) => "-".to_string(),
    }
}

/// The components with their deviations; of what is exact as it was written.
fn numbers(values: &Number, stds: Option<&Number>) -> String {
    let stds = stds.map_or(&[][..], Number::components).iter().map(Some);
    let pairs = values.components().iter().zip(stds.chain(std::iter::repeat(None)));
    let shown = pairs.map(|(value, std)| match std {
        Some(std) => {
            let digits = digits_of(*std);
            format!("{} ± {}", decimals(*value, digits), decimals(*std, digits))
        }
        None => value.to_string(),
    });
    shown.collect::<Vec<_>>().join(", ")
}

/// Lines of a text that a terminal's width takes, indented.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 92;
    let mut lines = vec![String::new()];
    for word in text.split(' ') {
        let last = lines.last().map_or(0, |line| line.chars().count());
        if last > 0 && last + 1 + word.chars().count() > WIDTH {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push(' ');
            line.push_str(word);
        }
    }
    lines.iter().map(|line| format!("  {line}\n")).collect()
}
