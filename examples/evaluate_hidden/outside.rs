//! Laws that the catalogue hasn't got: is a wrong name given, and what does the right law do?

use rayon::prelude::*;
use smash::Result;
use smash::diagnose::Verdict;

use crate::answer::Answer;
use crate::case::Case;
use crate::fit::{Errors, Fit};
use crate::table::{number, percent, pooled};

/// A fit that is behind by less can't be told from a better one: odds of twenty to one.
const TELLS_APART: f64 = 6.0;

struct Outside {
    law: String,
    row: String,
    answer: Answer,
    /// How far the right law is ahead of what is named.
    ahead: f64,
    with: Errors,
}

impl Outside {
    fn of(case: &Case) -> Result<Outside> {
        let answer = Answer::of(&case.scene)?;
        let with = Fit::of(case, &case.effects)?;
        let ahead = answer.fit(case)?.bic() - with.bic();
        let row = format!(
            "| {} | {} | {} | {ahead:.1} | {} |",
            case.labels().join(" + "),
            case.name,
            answer.in_words(),
            number(with.missed(case)?)
        );
        Ok(Outside { law: case.kind(), row, ahead, with: with.errors(case), answer })
    }

    fn is_named(&self) -> bool {
        self.answer.verdict == Verdict::Missing
    }

    fn is_warned(&self) -> bool {
        self.is_named() && self.answer.stays_structured
    }

    /// Named, with the word that a law outside can't be told from it.
    fn is_doubted(&self) -> bool {
        self.is_named() && !self.answer.stays_structured && self.answer.names_other_laws
    }

    fn is_confident(&self) -> bool {
        self.is_named() && !self.is_warned() && !self.is_doubted()
    }

    /// A name without a warning, though the poses tell the right law from it.
    fn is_wrong(&self) -> bool {
        self.is_confident() && self.ahead >= TELLS_APART
    }
}

/// The table of laws from outside the catalogue, in Markdown.
///
/// # Errors
/// A case can't be reconstructed.
pub fn table(cases: &[Case]) -> Result<String> {
    let all: Vec<Outside> =
        cases.par_iter().map(|case| case.told(Outside::of)).collect::<Result<_>>()?;
    let mut laws: Vec<&str> = all.iter().map(|outside| outside.law.as_str()).collect();
    laws.sort();
    laws.dedup();
    let mut text = String::from(
        "## Laws that the catalogue hasn't got\n\n\
         | hidden | scenes | unknown_effect | named, structure is left | named, or a law outside | \
         named alone, as good as the right law | named wrongly | nothing_missing | χ² in its 95 % band with the law | position / noise |\n\
         |---|---|---|---|---|---|---|---|---|---|\n",
    );
    for law in laws {
        text += &row(law, &all.iter().filter(|outside| outside.law == law).collect::<Vec<_>>());
    }
    text += &row("all", &all.iter().collect::<Vec<_>>());
    let wrong: Vec<&str> = all
        .iter()
        .filter(|outside| outside.is_wrong())
        .map(|outside| outside.row.as_str())
        .collect();
    if !wrong.is_empty() {
        text += "\n| hidden | scene | named wrongly | BIC of the law ahead | χ² missed |\n|---|---|---|---|---|\n";
        text += &wrong.join("\n");
        text.push('\n');
    }
    Ok(text)
}

fn row(law: &str, all: &[&Outside]) -> String {
    let share = |is: fn(&Outside) -> bool| percent(all.iter().filter(|o| is(o)).count(), all.len());
    let bands: Vec<bool> = all.iter().filter_map(|outside| outside.with.is_in_band()).collect();
    format!(
        "| {law} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
        all.len(),
        share(|o| o.answer.verdict == Verdict::UnknownEffect),
        share(|o| o.is_warned()),
        share(|o| o.is_doubted()),
        share(|o| o.is_confident() && !o.is_wrong()),
        share(|o| o.is_wrong()),
        share(|o| !o.answer.is_detected()),
        percent(bands.iter().filter(|is_in_band| **is_in_band).count(), bands.len()),
        pooled(all.iter().map(|outside| outside.with.position)),
    )
}
