//! Tables and numbers for a person.

/// Rows of cells as indented lines.
pub fn aligned(rows: &[Vec<String>]) -> String {
    lines(rows).iter().map(|line| format!("  {}\n", line.trim_end())).collect()
}

/// Rows of cells, in columns as wide as their widest cell.
pub fn lines(rows: &[Vec<String>]) -> Vec<String> {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max()
    };
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:width$}"));
        cells.collect::<Vec<_>>().join("  ")
    };
    rows.iter().map(line).collect()
}

/// A length, from m.
pub fn millimetres(length_m: f64) -> String {
    format!("{} mm", decimals(1e3 * length_m, 2))
}

/// An angle, from rad.
pub fn degrees(angle_rad: f64) -> String {
    format!("{}°", decimals(angle_rad.to_degrees(), 2))
}

/// So many digits behind the point; a wide number in powers of ten, and no −0.
pub fn decimals(value: f64, digits: usize) -> String {
    if value.abs() >= 1e5 {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.digits$}");
    let is_zero = !text.contains(|c: char| ('1'..='9').contains(&c));
    if is_zero { text.trim_start_matches('-').to_string() } else { text }
}

/// Two digits of the deviation, and no more of the value.
pub fn digits_of(std: f64) -> usize {
    (1.0 - std.log10().floor()).clamp(0.0, 9.0) as usize
}

/// A p-value; whether it is 1e-20 or 1e-30 tells nobody anything.
pub fn p_value(p: f64) -> String {
    match p {
        _ if p < 1e-12 => "< 1e-12".to_string(),
        _ if p < 1e-3 => format!("{p:.1e}"),
        _ => format!("{p:.3}"),
    }
}

/// A probability, which is never quite 0 nor 1.
pub fn probability(p: f64) -> String {
    match p {
        _ if p < 1e-3 => "< 0.001".to_string(),
        _ if p > 0.999 => "> 0.999".to_string(),
        _ => format!("{p:.3}"),
    }
}

/// So many deviations, in a column.
pub fn sigmas(count: f64) -> String {
    format!("{:>6} σ", decimals(count, 1))
}
