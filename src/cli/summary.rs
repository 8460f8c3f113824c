//! A reconstruction in words, for a person.

use std::fmt::Write;

use smash::files::Output;
use smash::reconstruct::{BodyResult, Estimate, Flag, Reconstruction};

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
    writeln!(out, "{name} (preset {}, segment by {})\n", result.preset, result.segment_by)?;
    match &result.mass_ratio {
        Some(estimate) => writeln!(out, "  mass ratio m_b/m_a   {}", number(estimate, ""))?,
        None => writeln!(out, "  mass ratio m_b/m_a   none: a single body")?,
    }
    writeln!(out, "  restitution          {}", number(&result.restitution, ""))?;
    writeln!(out, "  collision time       {}", number(&result.collision_time, " s"))?;
    let [x, y, z] = result.impulse;
    writeln!(out, "  impulse on a         ({x:.3}, {y:.3}, {z:.3}) N·s per kg of a\n")?;
    writeln!(out, "{}", table(&result.bodies))?;
    writeln!(out, "  error of the fit     {}\n", fit_error(result))?;
    for flag in &result.flags {
        write_flag(out, *flag)?;
    }
    if result.flags.is_empty() {
        writeln!(out, "No flags: the fit shows none of the known signs of failure.")?;
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

fn number(estimate: &Estimate, unit: &str) -> String {
    match (estimate.value, estimate.std) {
        (Some(value), Some(std)) => format!("{value:.4}{unit} ± {std:.1e}{unit}"),
        (Some(value), None) => format!("{value:.4}{unit}"),
        (None, _) => format!("not determined: {}", estimate.reason.as_deref().unwrap_or("")),
    }
}

/// Velocities and spins before and after, one row each.
fn table(bodies: &[BodyResult]) -> String {
    let width = bodies.iter().map(|body| body.name.chars().count()).max().unwrap_or(0);
    let mut text = format!("  {:width$}  {:<30}{:<30}\n", "", "velocity (m/s)", "spin (rad/s)",);
    for body in bodies {
        let rows = [
            ("before", body.velocity_before, body.angular_velocity_before),
            ("after", body.velocity_after, body.angular_velocity_after),
        ];
        for (side, velocity, spin) in rows {
            let spin = spin.map_or("not measured".to_string(), vector);
            let name = if side == "before" { body.name.as_str() } else { "" };
            let _ = writeln!(text, "  {name:width$}  {side:<7}{:<28}{spin}", vector(velocity));
        }
    }
    text
}

fn vector([x, y, z]: [f64; 3]) -> String {
    format!("({x:7.3}, {y:7.3}, {z:7.3})")
}

fn fit_error(result: &Reconstruction) -> String {
    let position = format!("{:.2} mm a coordinate", 1e3 * result.fit.position_rmse);
    match result.fit.orientation_rmse {
        Some(angle) => format!("{position}, {:.2}° an axis", angle.to_degrees()),
        None => position,
    }
}

fn write_flag(out: &mut String, flag: Flag) -> std::fmt::Result {
    writeln!(out, "flag: {}", flag.meaning())?;
    writeln!(out, "  hint: {}", flag.advice())
}
