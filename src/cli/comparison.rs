//! A comparison in words and tables, for a person.

use std::fmt::Write;
use std::path::Path;

use smash::Comparison;
use smash::compare::{Channel, ChannelResidual, ResultResiduals, Segment};

use super::table::{aligned, decimals, degrees, lines, millimetres, sigmas};
use super::{ledger, side_by_side};

/// A part by which two numbers must differ for people to wonder.
const VISIBLE_SHARE: f64 = 0.05;

/// What `smash compare` prints.
pub fn in_words(comparison: &Comparison) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_all(&mut text, comparison);
    text
}

fn write_all(out: &mut String, comparison: &Comparison) -> std::fmt::Result {
    let name = if comparison.scene.is_empty() { "the collision" } else { &comparison.scene };
    let names = short_names(comparison);
    writeln!(out, "{name}\n")?;
    if !comparison.against_truth.is_empty() {
        let columns = [&["the truth".to_string()], names.as_slice()].concat();
        let rows = side_by_side::rows(&comparison.against_truth, &columns);
        write!(
            out,
            "{}\nDifferences are from the truth, of vectors their length, in σ of the result: of the \
             coordinate that\nis furthest off.\n\n",
            aligned(&rows)
        )?;
    }
    if names.len() > 1 {
        write!(out, "{}", aligned(&side_by_side::rows(&comparison.quantities, &names)))?;
        writeln!(
            out,
            "\nDifferences are from {}, of vectors their length, in σ the coordinate that differs \
             most. The\nresults come from the same poses: σ is a yardstick here, not a test. \
             Motions are each at the result's\nown collision time.\n",
            names[0]
        )?;
    }
    writeln!(out, "Poses minus model, root mean square a coordinate, and the largest miss{}\n", {
        noise(comparison)
    })?;
    write!(out, "{}", aligned(&residuals(comparison, &names)))?;
    for (name, result) in names.iter().zip(&comparison.results) {
        if let Some(note) = note(result) {
            writeln!(out, "\n{name}: {note}")?;
        }
    }
    write!(out, "\n{}", failures(comparison, &names))?;
    write!(out, "{}", outliers(comparison, &names))?;
    if let [result] = comparison.results.as_slice() {
        write!(out, "{}", ledger::in_words(&result.ledger))?;
    }
    Ok(())
}

/// What to know of a result's residuals.
fn note(result: &ResultResiduals) -> Option<String> {
    if result.reason.is_some() {
        return result.reason.clone();
    }
    let (own, here) = (result.reported_orientation_rmse?, result.orientation_rmse?);
    let differs = (own - here).abs() > VISIBLE_SHARE * here;
    differs.then(|| {
        format!(
            "it reports {} itself, by its solver's own steps in time; above, rotation is exact",
            degrees(own)
        )
    })
}

/// The files' names, without their folders where they differ without.
fn short_names(comparison: &Comparison) -> Vec<String> {
    let short: Vec<String> = comparison
        .results
        .iter()
        .map(|result| match Path::new(&result.name).file_name() {
            Some(name) => name.to_string_lossy().into_owned(),
            None => result.name.clone(),
        })
        .collect();
    let distinct: std::collections::HashSet<&String> = short.iter().collect();
    if distinct.len() == short.len() {
        return short;
    }
    comparison.results.iter().map(|result| result.name.clone()).collect()
}

/// One line a channel, and the totals.
fn residuals(comparison: &Comparison, names: &[String]) -> Vec<Vec<String>> {
    let mut places: Vec<Place> = Vec::new();
    for place in comparison.results.iter().flat_map(|result| &result.channels).map(place) {
        if !places.contains(&place) {
            places.push(place);
        }
    }
    let totals = [Channel::Position, Channel::Orientation]
        .into_iter()
        .filter(|channel| places.iter().any(|(_, _, one)| one == channel));
    let totals: Vec<Channel> = totals.collect();
    let mut rows = vec![vec![String::new(); 3]];
    for (body, segment, channel) in &places {
        rows.push(vec![body.to_string(), side(*segment).into(), kind(*channel).into()]);
    }
    rows.extend(totals.iter().map(|one| vec!["all".into(), String::new(), kind(*one).into()]));
    for (name, result) in names.iter().zip(&comparison.results) {
        let of_places = places.iter().map(|wanted| {
            let one = result.channels.iter().find(|one| place(one) == *wanted);
            one.map_or(vec!["unknown".into()], |one| {
                let far = one.rmse_in_sigma.map_or(String::new(), sigmas);
                vec![format!("{:>9}", amount(one.channel, one.rmse)), far, miss(one)]
            })
        });
        let of_totals = totals.iter().map(|channel| {
            let total = match channel {
                Channel::Position => result.position_rmse,
                Channel::Orientation => result.orientation_rmse,
            };
            vec![total.map_or("unknown".into(), |total| format!("{:>9}", amount(*channel, total)))]
        });
        // One cell a row, so that the name above doesn't widen the first number's column.
        let cells = lines(&of_places.chain(of_totals).collect::<Vec<_>>());
        for (row, cell) in rows.iter_mut().zip(std::iter::once(name.clone()).chain(cells)) {
            row.push(cell);
        }
    }
    rows
}

type Place<'a> = (&'a str, Segment, Channel);

fn place(one: &ChannelResidual) -> Place<'_> {
    (&one.body, one.segment, one.channel)
}

fn miss(one: &ChannelResidual) -> String {
    let size = amount(one.channel, one.largest.size);
    format!("{size:>9} at {} s", decimals(one.largest.time, 3))
}

/// Where residuals aren't noise, the clearest first.
fn failures(comparison: &Comparison, names: &[String]) -> String {
    if comparison.results.iter().all(|result| result.structure.is_empty()) {
        return "Where it fails can't be said: nothing tells the noise. Add `noise` to the scene, or \
                compare with a\nrefined result.\n"
            .into();
    }
    let results = || names.iter().zip(&comparison.results);
    if results().all(|(_, result)| result.findings.is_empty()) {
        return "Nothing looks structured: what is left is like noise.\n".into();
    }
    let mut text = String::from("Where it fails, the clearest first\n");
    for (name, result) in results() {
        for finding in &result.findings {
            let whose = if names.len() > 1 { format!("{name}: ") } else { String::new() };
            text.push_str(&format!("  {whose}{finding}\n"));
        }
        if result.findings.is_empty() && names.len() > 1 {
            text.push_str(&format!("  {name}: nothing looks structured\n"));
        }
    }
    text
}

/// Single poses that are wrong, the worst first.
fn outliers(comparison: &Comparison, names: &[String]) -> String {
    /// More are no single ones: something else is wrong.
    const MOST: usize = 5;
    let mut rows = Vec::new();
    for (name, result) in names.iter().zip(&comparison.results) {
        for one in result.outliers.iter().take(MOST) {
            let time = format!("at {} s", decimals(one.time, 3));
            let far = sigmas(one.deviations);
            rows.push(vec![name.clone(), one.body.clone(), one.channel.clone(), time, far]);
        }
        if let Some(more) = result.outliers.len().checked_sub(MOST).filter(|more| *more > 0) {
            rows.push(vec![name.clone(), format!("and {more} more")]);
        }
    }
    match rows.is_empty() {
        true => String::new(),
        false => format!("\nPoses too far off to be noise\n{}", aligned(&rows)),
    }
}

/// The noise, as the title of a table goes on.
fn noise(comparison: &Comparison) -> String {
    let Some(noise) = &comparison.noise else { return String::new() };
    let turn = noise.orientation.map_or(String::new(), |angle| format!(", {}", degrees(angle)));
    let origin = match &noise.from_result {
        Some(name) => format!("by {name}"),
        None => "stated in the scene".into(),
    };
    format!(";\nσ: the noise, {}{turn}, {origin}", millimetres(noise.position))
}

fn side(segment: Segment) -> &'static str {
    match segment {
        Segment::Before => "before",
        Segment::After => "after",
    }
}

fn kind(channel: Channel) -> &'static str {
    match channel {
        Channel::Position => "position",
        Channel::Orientation => "orientation",
    }
}

fn amount(channel: Channel, value: f64) -> String {
    match channel {
        Channel::Position => millimetres(value),
        Channel::Orientation => degrees(value),
    }
}
