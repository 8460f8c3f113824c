//! One hidden effect: is it named, and what becomes of the errors once it is added?

use std::collections::BTreeMap;

use rayon::prelude::*;
use smash::Result;

use crate::answer::Answer;
use crate::case::Case;
use crate::fit::{Errors, Fit};
use crate::table::{number, percent, pooled, quantile, spread};

/// A case, what the diagnosis says of it, and what the right model does.
pub struct Single {
    kind: String,
    pub answer: Answer,
    is_first: bool,
    is_in_set: bool,
    is_of_class: bool,
    base: Errors,
    with: Errors,
    /// By how much χ² with the right effect is worse than with its parameters at the truth.
    missed: Option<f64>,
    /// From another solver's numbers, in deviations.
    differs: Vec<f64>,
    name: String,
    /// Where the right effect doesn't come first.
    pub failure: Option<String>,
}

impl Single {
    /// # Errors
    /// The case can't be reconstructed at all.
    pub fn of(case: &Case) -> Result<Single> {
        let answer = Answer::of(&case.scene)?;
        let with = Fit::of(case, &case.effects)?;
        let is_first = answer.is_first(case);
        let missed = with.missed(case)?;
        let failure = match is_first {
            true => None,
            false => Some(failure(case, &answer, &with, missed)?),
        };
        Ok(Single {
            kind: case.kind(),
            is_first,
            is_in_set: answer.is_in_set(case),
            is_of_class: answer.is_of_class(case),
            base: Fit::of(case, &[])?.errors(case),
            with: with.errors(case),
            missed,
            differs: with.differs(case),
            name: format!("{} {}", case.labels().join(" + "), case.name),
            answer,
            failure,
        })
    }
}

/// More than this, in χ², is more than rounding.
const WORSE: f64 = 0.1;

/// A row on a case whose effect doesn't come first. The cause is the `search`, where the fit with
/// the right effect is worse than one with its true parameters, or leaves more than noise; the
/// `data`, where the right model is no better than the one named; else the `rule` that decides
/// between them.
fn failure(case: &Case, answer: &Answer, with: &Fit, missed: Option<f64>) -> Result<String> {
    let behind = with.bic() - answer.fit(case)?.bic();
    let cause = match () {
        () if missed.is_some_and(|chi2| chi2 > WORSE) || with.errors(case).is_stuck() => "search",
        () if behind >= 0.0 => "data",
        () => "rule",
    };
    Ok(format!(
        "| {} | {} | {} | {} | {} | {behind:.1} | {} | {cause} |",
        case.labels().join(" + "),
        case.name,
        answer.in_words(),
        if answer.is_in_set(case) { "yes" } else { "no" },
        if answer.is_of_class(case) { "yes" } else { "no" },
        number(missed),
    ))
}

/// The tables of cases with one effect, in Markdown.
///
/// # Errors
/// A case can't be reconstructed.
pub fn tables(cases: &[Case]) -> Result<String> {
    let singles: Vec<Single> =
        cases.par_iter().map(|case| case.told(Single::of)).collect::<Result<_>>()?;
    let mut kinds: Vec<&str> = singles.iter().map(|single| single.kind.as_str()).collect();
    kinds.sort();
    kinds.dedup();
    let of = |kind: &str| singles.iter().filter(|s| s.kind == kind).collect::<Vec<&Single>>();
    let all: Vec<&Single> = singles.iter().collect();
    let mut text = String::from(
        "## Which effect is missing\n\n\
         | hidden | scenes | detected | first | in the set | or of its class | names in the set | \
         right, but warned | right, or a law outside | answers |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    kinds.iter().for_each(|kind| text += &naming(kind, &of(kind)));
    text += &naming("all", &all);
    text += "\n## Errors without the effect and with it\n\n\
         | hidden | χ² in its 95 % band | position / noise | orientation / noise | \
         error of m without: median / 90 % | with | error of c without: median / 90 % | with | null | m and c in their intervals |\n\
         |---|---|---|---|---|---|---|---|---|---|\n";
    kinds.iter().for_each(|kind| text += &errors(kind, &of(kind)));
    text += &errors("all", &all);
    let stuck = singles
        .iter()
        .filter_map(|single| Some((single, single.missed.filter(|chi2| *chi2 > WORSE)?)));
    let stuck: Vec<String> =
        stuck.map(|(single, missed)| format!("{} by {missed:.1}", single.name)).collect();
    if singles.iter().any(|single| single.missed.is_some()) {
        let stuck = if stuck.is_empty() { "none".to_string() } else { stuck.join(", ") };
        text +=
            "\nFits with the right effect that end worse than with its parameters at the truth: ";
        text += &format!("{stuck}.\n");
    }
    let differs: Vec<f64> = singles.iter().flat_map(|single| single.differs.clone()).collect();
    if !differs.is_empty() {
        text += &format!(
            "\nMass ratio and restitution with the right effect, against another solver's: {} deviations \
             (median / 90 %), at most {:.4}.\n",
            spread(differs.iter().copied()),
            quantile(&differs, 1.0)
        );
    }
    let failures: Vec<&str> = singles.iter().filter_map(|s| s.failure.as_deref()).collect();
    if !failures.is_empty() {
        text += "\n## Not first\n\n\
             | hidden | scene | answer | in the set | of its class | BIC behind | χ² missed | cause |\n\
             |---|---|---|---|---|---|---|---|\n";
        text += &failures.join("\n");
        text.push('\n');
    }
    Ok(text)
}

fn naming(kind: &str, singles: &[&Single]) -> String {
    let share =
        |is: fn(&Single) -> bool| percent(singles.iter().filter(|s| is(s)).count(), singles.len());
    let mut answers: BTreeMap<String, usize> = BTreeMap::new();
    for single in singles {
        let words = single.answer.in_words();
        let name = words.split('@').next().unwrap_or(&words);
        let is_elsewhere = name == single.kind && !single.is_first;
        *answers
            .entry(format!("{name}{}", if is_elsewhere { " elsewhere" } else { "" }))
            .or_default() += 1;
    }
    let mut answers: Vec<(String, usize)> = answers.into_iter().collect();
    answers.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let answers: Vec<String> =
        answers.iter().map(|(name, count)| format!("{name} {count}")).collect();
    format!(
        "| {kind} | {} | {} | {} | {} | {} | {:.1} | {} | {} | {} |\n",
        singles.len(),
        share(|s| s.answer.is_detected()),
        share(|s| s.is_first),
        share(|s| s.is_in_set),
        share(|s| s.is_of_class),
        singles.iter().map(|s| 1.0 + s.answer.alike.len() as f64).sum::<f64>()
            / singles.len() as f64,
        share(|s| s.is_first && s.answer.stays_structured),
        share(|s| s.is_first && s.answer.names_other_laws),
        if kind == "all" { String::new() } else { answers.join(", ") },
    )
}

fn errors(kind: &str, singles: &[&Single]) -> String {
    let bands: Vec<bool> = singles.iter().filter_map(|s| s.with.is_in_band()).collect();
    let masses =
        |pick: fn(&Single) -> &Errors| spread(singles.iter().filter_map(|s| pick(s).mass_ratio));
    let restitutions =
        |pick: fn(&Single) -> &Errors| spread(singles.iter().map(|s| pick(s).restitution));
    let covered: Vec<bool> = singles.iter().flat_map(|s| s.with.covered.clone()).collect();
    // What isn't determined has no error: it is counted.
    let is_null = |s: &&&Single| {
        s.with.restitution.is_infinite() || s.with.mass_ratio.is_some_and(f64::is_infinite)
    };
    format!(
        "| {kind} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
        percent(bands.iter().filter(|is_in_band| **is_in_band).count(), bands.len()),
        pooled(singles.iter().map(|s| s.with.position)),
        pooled(singles.iter().filter_map(|s| s.with.orientation)),
        masses(|s| &s.base),
        masses(|s| &s.with),
        restitutions(|s| &s.base),
        restitutions(|s| &s.with),
        singles.iter().filter(is_null).count(),
        percent(covered.iter().filter(|is_covered| **is_covered).count(), covered.len()),
    )
}
