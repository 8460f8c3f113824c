//! Two hidden effects: does `improve` find them?

use rayon::prelude::*;
use smash::reconstruct::RefinedOptions;
use smash::{Result, improve};

use crate::case::Case;
use crate::fit::Fit;
use crate::table::{number, percent};

/// Models whose criteria differ by less can't be told apart: odds of twenty to one.
const TELLS_APART: f64 = 6.0;

/// What `improve` finds.
struct Pair {
    row: String,
    is_exact: bool,
    /// How far the model with the true pair is behind the one found.
    behind: f64,
}

impl Pair {
    fn of(case: &Case) -> Result<Pair> {
        let improvement = improve(&case.scene, &RefinedOptions::default(), &[])?;
        let mut truth = case.labels();
        truth.sort();
        let mut found: Vec<String> =
            improvement.result.effects.iter().map(|effect| effect.label()).collect();
        found.sort();
        let with = Fit::of(case, &case.effects)?;
        let behind = with.bic() - Fit::from(case, improvement.result).bic();
        let missed = number(with.missed(case)?);
        let (truth, found) = (truth.join(" + "), found.join(" + "));
        let row = format!("| {truth} | {} | {found} | {behind:.1} | {missed} |", case.name);
        Ok(Pair { row, is_exact: truth == found, behind })
    }
}

/// The table of cases with two effects, in Markdown.
///
/// # Errors
/// A case can't be reconstructed.
pub fn table(cases: &[Case]) -> Result<String> {
    let pairs: Vec<Pair> =
        cases.par_iter().map(|case| case.told(Pair::of)).collect::<Result<_>>()?;
    let share =
        |is: fn(&Pair) -> bool| percent(pairs.iter().filter(|pair| is(pair)).count(), pairs.len());
    let mut text = format!(
        "## Two effects\n\n\
         | scenes | the true pair | or one that can't be told from it | better than the truth | worse |\n\
         |---|---|---|---|---|\n| {} | {} | {} | {} | {} |\n",
        pairs.len(),
        share(|pair| pair.is_exact),
        share(|pair| pair.is_exact || pair.behind.abs() < TELLS_APART),
        share(|pair| !pair.is_exact && pair.behind >= TELLS_APART),
        share(|pair| !pair.is_exact && pair.behind <= -TELLS_APART),
    );
    text += "\n| hidden | scene | found instead | BIC of the truth behind | χ² missed |\n|---|---|---|---|---|\n";
    for pair in pairs.iter().filter(|pair| !pair.is_exact) {
        text += &pair.row;
        text.push('\n');
    }
    Ok(text)
}
