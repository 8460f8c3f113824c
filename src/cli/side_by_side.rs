//! What results say, quantity by quantity, beside each other.

use smash::compare::{Difference, Entry, NOT_IN_THE_MODEL, Quantity};

use super::table::{decimals, digits_of, sigmas};

/// A header, and a row for each quantity: what each result says, and how far later ones are from the
/// first.
pub fn rows(quantities: &[Quantity], names: &[String]) -> Vec<Vec<String>> {
    let mut header = vec![String::new(), names[0].clone()];
    for name in &names[1..] {
        header.extend([name.clone(), "difference".into(), String::new()]);
    }
    let rows = quantities.iter().map(|quantity| {
        let digits = digits(quantity);
        let mut row = vec![label(quantity), value(&quantity.entries[0], digits)];
        for (entry, difference) in quantity.entries[1..].iter().zip(&quantity.differences) {
            let far = difference.in_sigma.map_or(String::new(), sigmas);
            row.extend([value(entry, digits), size(quantity, difference, digits), far]);
        }
        row
    });
    std::iter::once(header).chain(rows).collect()
}

/// `a.velocity_before` as people say it, with its unit.
fn label(quantity: &Quantity) -> String {
    let words = match quantity.quantity.rsplit_once('.') {
        Some((body, words)) => format!("{body}  {}", words.replace('_', " ")),
        None => quantity.quantity.replace('_', " "),
    };
    match quantity.unit.as_str() {
        "" => words,
        unit => format!("{words} ({unit})"),
    }
}

/// Digits behind the point, the same for all entries: two of the least deviation.
fn digits(quantity: &Quantity) -> usize {
    let entries = quantity.entries.iter();
    let stds = entries.flat_map(|entry| &entry.std).flatten().filter(|std| **std > 0.0);
    match stds.copied().min_by(f64::total_cmp) {
        Some(least) => digits_of(least).min(6),
        None if is_scalar(quantity) => 4,
        None => 3,
    }
}

fn is_scalar(quantity: &Quantity) -> bool {
    quantity.entries.iter().filter_map(|entry| entry.value.as_ref()).all(|value| value.len() == 1)
}

fn value(entry: &Entry, digits: usize) -> String {
    match (entry.value.as_deref(), entry.std.as_slice()) {
        (None, _) if entry.reason.as_deref() == Some(NOT_IN_THE_MODEL) => NOT_IN_THE_MODEL.into(),
        (None, _) => "not determined".into(),
        (Some(&[value]), &[Some(std)]) => {
            format!("{} ± {}", decimals(value, digits), decimals(std, digits))
        }
        (Some(&[value]), _) => decimals(value, digits),
        (Some(numbers), _) => {
            let width = digits + 4;
            let cells: Vec<String> = numbers
                .iter()
                .map(|&number| format!("{:>width$}", decimals(number, digits)))
                .collect();
            cells.join(" ")
        }
    }
}

fn size(quantity: &Quantity, difference: &Difference, digits: usize) -> String {
    /// A degree is about a fiftieth of a radian.
    const FEWER_IN_DEGREES: usize = 2;
    let text = match (difference.difference.as_deref(), difference.size) {
        (Some(&[signed]), _) => {
            let sign = if signed > 0.0 { "+" } else { "" };
            format!("{sign}{}", decimals(signed, digits))
        }
        (_, Some(angle)) if quantity.difference_unit == "rad" => {
            let digits = digits.saturating_sub(FEWER_IN_DEGREES).max(2);
            format!("{}°", decimals(angle.to_degrees(), digits))
        }
        (_, Some(size)) => decimals(size, digits),
        _ => String::new(),
    };
    format!("{text:>10}")
}
