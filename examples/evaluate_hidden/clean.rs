//! Nothing hidden: does the diagnosis keep quiet?

use rayon::prelude::*;
use smash::Result;
use smash::diagnose::Verdict;

use crate::answer::Answer;
use crate::case::Case;
use crate::table::percent;

/// The table of clean cases, in Markdown.
///
/// # Errors
/// A case can't be reconstructed.
pub fn table(cases: &[Case]) -> Result<String> {
    let unstated = cases.iter().cloned().map(Case::unstated).collect::<Result<Vec<_>>>()?;
    let mut text = String::from(
        "## Nothing is missing\n\n\
         | noise | scenes | nothing_missing | missing | unknown_effect | false alarms |\n\
         |---|---|---|---|---|---|\n",
    );
    text += &row("stated", cases)?;
    text += &row("estimated", &unstated)?;
    Ok(text)
}

fn row(noise: &str, cases: &[Case]) -> Result<String> {
    let answers: Vec<Answer> =
        cases.par_iter().map(|case| Answer::of(&case.scene)).collect::<Result<_>>()?;
    let count = |verdict| answers.iter().filter(|answer| answer.verdict == verdict).count();
    let share = |verdict| percent(count(verdict), answers.len());
    let alarms = cases.iter().zip(&answers).filter(|(_, answer)| answer.is_detected());
    let alarms: Vec<String> =
        alarms.map(|(case, answer)| format!("{} {}", case.name, answer.in_words())).collect();
    Ok(format!(
        "| {noise} | {} | {} | {} | {} | {} |\n",
        cases.len(),
        share(Verdict::NothingMissing),
        share(Verdict::Missing),
        share(Verdict::UnknownEffect),
        alarms.join(", "),
    ))
}
