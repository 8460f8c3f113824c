//! Several throws with the same effect hidden in each: do they tell it together?

use std::collections::BTreeMap;

use rayon::prelude::*;
use smash::{Result, Scene};

use crate::answer::Answer;
use crate::case::Case;
use crate::table::percent;

/// Throws, and what their diagnoses say.
struct Told {
    kind: String,
    together: Answer,
    is_first: bool,
    is_in_set: bool,
    /// How many of the throws show alone that something is missing.
    alone: usize,
    throws: usize,
}

/// The table of sets of throws, in Markdown.
///
/// # Errors
/// A throw can't be reconstructed.
pub fn table(sets: &[Vec<Case>]) -> Result<String> {
    let told: Vec<Told> = sets.par_iter().map(|set| told(set)).collect::<Result<_>>()?;
    let mut kinds: BTreeMap<&str, Vec<&Told>> = BTreeMap::new();
    told.iter().for_each(|told| kinds.entry(&told.kind).or_default().push(told));
    let mut text = String::from(
        "## Throws together\n\n\
         | hidden | sets | detected | first | in the set | single throws that show something | answers |\n\
         |---|---|---|---|---|---|---|\n",
    );
    kinds.iter().for_each(|(kind, told)| text += &row(kind, told));
    text += &row("all", &told.iter().collect::<Vec<_>>());
    Ok(text)
}

fn told(set: &[Case]) -> Result<Told> {
    let scenes: Vec<Scene> = set.iter().map(|case| case.scene.clone()).collect();
    let together = Answer::of_throws(&scenes)?;
    let alone: Vec<Answer> = scenes.iter().map(Answer::of).collect::<Result<_>>()?;
    Ok(Told {
        kind: set[0].kind(),
        is_first: together.is_first(&set[0]),
        is_in_set: together.is_in_set(&set[0]),
        together,
        alone: alone.iter().filter(|answer| answer.is_detected()).count(),
        throws: set.len(),
    })
}

fn row(kind: &str, told: &[&Told]) -> String {
    let share =
        |is: fn(&Told) -> bool| percent(told.iter().filter(|told| is(told)).count(), told.len());
    let sum = |of: fn(&Told) -> usize| told.iter().map(|told| of(told)).sum();
    let mut answers: BTreeMap<String, usize> = BTreeMap::new();
    told.iter().for_each(|told| *answers.entry(told.together.in_words()).or_default() += 1);
    let answers: Vec<String> =
        answers.iter().map(|(name, count)| format!("{name} {count}")).collect();
    format!(
        "| {kind} | {} | {} | {} | {} | {} | {} |\n",
        told.len(),
        share(|told| told.together.is_detected()),
        share(|told| told.is_first),
        share(|told| told.is_in_set),
        percent(sum(|told| told.alone), sum(|told| told.throws)),
        if kind == "all" { String::new() } else { answers.join(", ") },
    )
}
