//! Numbers in the tables' cells.

/// `97.5 %`, or `–` of none.
pub fn percent(count: usize, of: usize) -> String {
    match of {
        0 => "–".into(),
        _ => format!("{:.1} %", 100.0 * count as f64 / of as f64),
    }
}

/// With one decimal, or `–` of none.
pub fn number(value: Option<f64>) -> String {
    value.map_or("–".into(), |value| format!("{value:.1}"))
}

/// Median and 90th percentile.
pub fn spread(values: impl Iterator<Item = f64>) -> String {
    let values: Vec<f64> = values.collect();
    match values.is_empty() {
        true => "–".into(),
        false => format!("{:.4} / {:.4}", quantile(&values, 0.5), quantile(&values, 0.9)),
    }
}

/// Root mean square.
pub fn pooled(values: impl Iterator<Item = f64>) -> String {
    let finite: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    let squares: f64 = finite.iter().map(|value| value * value).sum();
    format!("{:.3}", (squares / finite.len() as f64).sqrt())
}

/// The value below which this share of them is, of those that are finite.
pub fn quantile(values: &[f64], share: f64) -> f64 {
    let mut values: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    let place = share * (values.len().max(1) - 1) as f64;
    values.get(place.round() as usize).copied().unwrap_or(f64::NAN)
}
