//! A reconstruction in words, for a person.

use std::fmt::Write;

use smash::files::Output;
use smash::reconstruct::{
    ActiveEffect, Alternative, BodyResult, Estimate, NoiseReport, Outlier, ParameterEstimate,
    Preset, Reconstruction, SegmentCriterion,
};

use super::table::{decimals, digits_of};

/// The summary that `smash reconstruct` prints.
pub fn of(result: &Reconstruction, next: &[String], output: Option<&Output>) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_summary(&mut text, result, next, output);
    text
}

fn write_summary(
    out: &mut String,
    result: &Reconstruction,
    next: &[String],
    output: Option<&Output>,
) -> std::fmt::Result {
    let name = if result.scene.is_empty() { "the collision" } else { &result.scene };
    writeln!(out, "{name} ({})\n", method(result))?;
    for (index, flag) in result.flags.iter().enumerate() {
        writeln!(out, "flag: {}", flag.meaning())?;
        // The same advice for several in a row stands once, below the last.
        if result.flags.get(index + 1).is_none_or(|next| next.advice() != flag.advice()) {
            writeln!(out, "  hint: {}", flag.advice())?;
        }
    }
    if !result.flags.is_empty() {
        writeln!(out)?;
    }
    // The paper's method has no deviations at all: no need to say so three times.
    let number = |estimate: &Estimate, unit: &str| match result.preset {
        Preset::Paper if estimate.value.is_some() => {
            number(&Estimate { reason: None, ..estimate.clone() }, unit)
        }
        _ => number(estimate, unit),
    };
    match &result.mass_ratio {
        Some(estimate) => writeln!(out, "  mass ratio m_b/m_a   {}", number(estimate, ""))?,
        None => writeln!(out, "  mass ratio m_b/m_a   none: a single body")?,
    }
    writeln!(out, "  restitution          {}", number(&result.restitution, ""))?;
    writeln!(out, "  collision time       {}", number(&result.collision_time, " s"))?;
    let first = result.bodies.first().map_or("a", |body| body.name.as_str());
    writeln!(
        out,
        "  {:19}  ({}) N·s per kg of {first}\n",
        format!("impulse on {first}"),
        digits(result.impulse).join(", ")
    )?;
    writeln!(out, "{}", table(&result.bodies))?;
    writeln!(out, "  error of the fit     {}", fit_error(result))?;
    if let Some(noise) = &result.noise {
        writeln!(out, "  noise                {}", noise_words(noise, result.fit.reduced_chi2))?;
    }
    write_effects(out, &result.effects)?;
    write_alternatives(out, &result.alternatives)?;
    write_outliers(out, &result.outliers)?;
    if result.flags.is_empty() {
        writeln!(out, "\n{}", no_flags(result))?;
    }
    if output.is_none() && next.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nNext")?;
    if let Some(output) = output {
        writeln!(out, "  the numbers are in {}", output.path().display())?;
    }
    for step in next {
        writeln!(out, "  {step}")?;
    }
    Ok(())
}

/// A flag takes residuals of twice the noise; what is beyond chance is worth a word before.
fn no_flags(result: &Reconstruction) -> String {
    let fit = &result.fit;
    match fit.reduced_chi2.filter(|_| fit.is_beyond_chance()) {
        Some(reduced) => format!(
            "No flags; but the residuals are {:.2} times as large as the stated noise, which is beyond \
             chance.",
            reduced.sqrt()
        ),
        None if leaves_a_parameter_open(result) => {
            "No flags: the fit shows none of the known signs of failure. But these poses don't determine \
             all\nparameters above: give those a value, or leave the effect out."
                .to_string()
        }
        None => "No flags: the fit shows none of the known signs of failure.".to_string(),
    }
}

fn leaves_a_parameter_open(result: &Reconstruction) -> bool {
    let mut parameters = result.effects.iter().flat_map(|effect| effect.parameters.values());
    parameters.any(ParameterEstimate::is_open)
}

fn method(result: &Reconstruction) -> &'static str {
    match (result.preset, result.segment_by) {
        (Preset::Paper, SegmentCriterion::Distance) => {
            "the paper to the letter: segment by distance"
        }
        (Preset::Paper, _) => "the paper's method, segment by cost",
        _ => "refined",
    }
}

fn number(estimate: &Estimate, unit: &str) -> String {
    let Some(value) = estimate.value else {
        return format!("not determined: {}", estimate.reason.as_deref().unwrap_or(""));
    };
    let reason = estimate.reason.as_ref().map_or(String::new(), |reason| format!("    ({reason})"));
    let Some(std) = estimate.std else { return format!("{value:.4}{unit}{reason}") };
    let digits = digits_of(std);
    let mut text = format!("{value:.digits$} ± {std:.digits$}{unit}");
    if let Some([low, high]) = estimate.interval_95 {
        text += &format!("    95 %: {low:.digits$} to {high:.digits$}");
    }
    text + &reason
}

fn noise_words(noise: &NoiseReport, reduced_chi2: Option<f64>) -> String {
    let source = if noise.estimated { "estimated" } else { "stated" };
    let mut text = format!("{:.2} mm a coordinate", 1e3 * noise.position);
    if let Some(angle) = noise.orientation {
        text += &format!(", {:.2}° an axis", angle.to_degrees());
    }
    text += &format!(", {source}");
    if let Some(reduced) = reduced_chi2 {
        text += &format!("; the residuals are {:.2} times as large", reduced.sqrt());
    }
    text
}

/// Each effect, and below it a row for each parameter.
fn write_effects(out: &mut String, effects: &[ActiveEffect]) -> std::fmt::Result {
    if effects.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nEffects beyond the base model:")?;
    for effect in effects {
        writeln!(out, "  {}", effect.label())?;
        for (name, estimate) in &effect.parameters {
            writeln!(out, "    {name:18} {}", parameter(estimate))?;
        }
    }
    Ok(())
}

/// Value, deviation and unit, or why one is missing.
fn parameter(estimate: &ParameterEstimate) -> String {
    let reason = estimate.reason.as_ref().map_or(String::new(), |reason| format!("    ({reason})"));
    let Some(value) = &estimate.value else { return format!("not determined{reason}") };
    let unit = match estimate.unit.as_str() {
        "1" => String::new(),
        unit => format!(" {unit}"),
    };
    let list = |numbers: &[String]| match numbers {
        [single] => single.clone(),
        all => format!("({})", all.join(", ")),
    };
    let Some(std) = &estimate.std else {
        let shown: Vec<String> = value.components().iter().map(|v| decimals(*v, 4)).collect();
        return format!("{}{unit}{reason}", list(&shown));
    };
    let pairs = value.components().iter().zip(std.components());
    let shown = pairs.map(|(value, std)| [*value, *std].map(|x| decimals(x, digits_of(*std))));
    let (values, stds): (Vec<String>, Vec<String>) = shown.map(|[value, std]| (value, std)).unzip();
    format!("{} ± {}{unit}{reason}", list(&values), list(&stds))
}

fn write_alternatives(out: &mut String, alternatives: &[Alternative]) -> std::fmt::Result {
    if alternatives.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nNearly as good:")?;
    for other in alternatives {
        let [mass_ratio, restitution] = [other.mass_ratio, other.restitution]
            .map(|value| value.map_or("none".to_string(), |value| format!("{value:.3}")));
        writeln!(
            out,
            "  mass ratio {mass_ratio}, restitution {restitution}, at {:.4} s: χ² larger by {:.1}; \
             differs in {}",
            other.collision_time, other.delta_chi2, other.differs_in
        )?;
    }
    Ok(())
}

/// The worst few of the poses that lie too far off.
fn write_outliers(out: &mut String, outliers: &[Outlier]) -> std::fmt::Result {
    const MOST: usize = 5;
    if outliers.is_empty() {
        return Ok(());
    }
    writeln!(out, "\nToo far off to be noise (one in a thousand may be):")?;
    for outlier in outliers.iter().take(MOST) {
        let Outlier { body, time, channel, deviations } = outlier;
        writeln!(out, "  {channel} of {body} at {time:.4} s: {deviations:.1} σ")?;
    }
    if outliers.len() > MOST {
        writeln!(out, "  and {} more", outliers.len() - MOST)?;
    }
    Ok(())
}

/// Velocities and spins before and after, one row each.
fn table(bodies: &[BodyResult]) -> String {
    let mut rows =
        vec![[String::new(), String::new(), "velocity (m/s)".into(), "spin (rad/s)".into()]];
    for body in bodies {
        let sides = [
            ("before", body.velocity_before, body.angular_velocity_before),
            ("after", body.velocity_after, body.angular_velocity_after),
        ];
        for (side, velocity, spin) in sides {
            let name = if side == "before" { body.name.clone() } else { String::new() };
            rows.push([name, side.into(), row(velocity), spin.map_or("not measured".into(), row)]);
        }
    }
    let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
    let [name, side, velocity] = [width(0), width(1), width(2)];
    let lines = rows.iter().map(|[a, b, c, d]| {
        format!("  {a:name$}  {b:side$}  {c:velocity$}  {d}").trim_end().to_string() + "\n"
    });
    lines.collect()
}

/// Three numbers in columns; a wider one moves only its own row's end.
fn row(v: [f64; 3]) -> String {
    digits(v).map(|number| format!("{number:>9}")).concat()
}

/// Three digits behind the point, or scientific where that says nothing.
fn digits(v: [f64; 3]) -> [String; 3] {
    v.map(|x| match x.abs() {
        ..0.0005 => "0.000".to_string(),
        10_000.0.. => format!("{x:.2e}"),
        _ => format!("{x:.3}"),
    })
}

fn fit_error(result: &Reconstruction) -> String {
    let position = format!("{:.2} mm a coordinate", 1e3 * result.fit.position_rmse);
    match result.fit.orientation_rmse {
        Some(angle) => format!("{position}, {:.2}° an axis", angle.to_degrees()),
        None => position,
    }
}
