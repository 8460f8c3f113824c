//! What messages say of the user's own words: quoted, shortened, and with the likely meaning.

/// The characters of a quotation that are shown; the rest tells nothing new.
const LONGEST_QUOTE: usize = 60;

/// `text` between backticks, shortened, with control characters escaped.
pub(crate) fn quoted(text: &str) -> String {
    format!("`{}`", shortened(text))
}

/// `text` without its tail if it is long, with control characters escaped.
pub(crate) fn shortened(text: &str) -> String {
    let mut shown = String::new();
    let mut chars = text.chars();
    for character in chars.by_ref().take(LONGEST_QUOTE) {
        match character {
            '"' | '\'' | '\\' => shown.push(character),
            other => shown.extend(other.escape_debug()),
        }
    }
    if chars.next().is_some() {
        shown.push('…');
    }
    shown
}

/// The mend for a word that isn't among the `known` ones.
pub(crate) fn did_you_mean(word: &str, known: &[&str]) -> String {
    // Similarity costs the product of the lengths: a word of a megabyte is no misspelling.
    let near = if word.len() > LONGEST_QUOTE { None } else { nearest(word, known) };
    match near {
        Some(meant) => format!("did you mean `{meant}`?"),
        None if known.is_empty() => "leave it out".into(),
        None => format!("known here: {}", listed(known)),
    }
}

fn nearest<'a>(word: &str, known: &[&'a str]) -> Option<&'a str> {
    let lower = word.to_lowercase();
    let scored = known.iter().map(|&one| (strsim::damerau_levenshtein(&lower, one), one));
    let (distance, meant) = scored.min_by_key(|&(distance, _)| distance)?;
    // A third of the letters wrong is still a slip; more is another word.
    (distance * 3 <= meant.chars().count().max(lower.chars().count())).then_some(meant)
}

/// The words between backticks, with commas.
pub(crate) fn listed(words: &[&str]) -> String {
    words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
}

/// A value with its unit, which a pure number hasn't got.
pub(crate) fn measured(value: &str, unit: &str) -> String {
    if unit == "1" { value.to_string() } else { format!("{value} {unit}") }
}

/// `count` with its noun: "1 pose", "2 poses".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// `value` to six decimals, without zeros at the end.
pub(crate) fn rounded(value: f64) -> String {
    let text = format!("{value:.6}");
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".into(),
        short => short.into(),
    }
}

/// A limit as people write it: powers of ten only where the zeros can't be counted at a glance.
pub(crate) fn limit(value: f64) -> String {
    let is_short = value == 0.0 || (1e-4..1e7).contains(&value.abs());
    if is_short { value.to_string() } else { format!("{value:e}") }
}

/// `value` to the last digit that its deviation tells, and the deviation, to two digits.
pub(crate) fn with_std(value: f64, std: f64) -> [String; 2] {
    let told = significant(std, 2);
    let magnitude = |x: f64| if x == 0.0 { 0.0 } else { x.abs().log10().floor() };
    let value = match told.split_once('.') {
        Some((_, decimals)) if !told.contains('e') => format!("{value:.*}", decimals.len()),
        None if !told.contains('e') => format!("{value:.0}"),
        _ => {
            significant(value, (magnitude(value) - magnitude(std) + 2.0).clamp(3.0, 17.0) as usize)
        }
    };
    [value, told]
}

/// `value` to so many significant digits, in powers of ten where it is very small or large.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let exponent = value.abs().log10().floor() as i32;
    if !(-5..7).contains(&exponent) {
        return format!("{value:.*e}", digits - 1);
    }
    let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
    format!("{value:.decimals$}")
}
