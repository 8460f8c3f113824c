//! The answer of several throws in plain words.

use super::FALSE_ALARM;
use super::diagnosis::{Agreement, Diagnosis, Verdict};
use super::together::Together;
use super::words::{in_words, missing};
use crate::reconstruct::Number;
use crate::words::significant;

/// What the `diagnosis` of `count` throws together says.
pub(super) fn explanation_of_throws(diagnosis: &Diagnosis, count: usize) -> String {
    let together = diagnosis.together.iter().map(|one| one.in_words());
    let otherwise = diagnosis.otherwise.iter().map(|otherwise| otherwise.words.clone());
    let sentences =
        std::iter::once(verdict_of_throws(diagnosis, count)).chain(otherwise).chain(together);
    let text = sentences.collect::<Vec<_>>().join(" ");
    let misses = diagnosis.stays_structured || diagnosis.verdict == Verdict::UnknownEffect;
    match misses && !diagnosis.together.is_empty() {
        true => text + " " + Together::OF_A_POOR_MODEL,
        false => text,
    }
}

fn verdict_of_throws(diagnosis: &Diagnosis, count: usize) -> String {
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::Missing, Some(best)) => {
            let mut text = format!(
                "In {count} throws together: {}",
                missing(best, None, diagnosis.stays_structured)
            );
            text += &best.throws.as_ref().map_or(String::new(), agreement);
            text
        }
        (Verdict::UnknownEffect, _) => format!(
            "Many of the {count} throws are missed by more than their noise, and no effect that they \
             could share explains it alone.{} A body that rolls, slides or lies on another is in no flight: \
             leave such poses out.{}",
            nearest_of_throws(diagnosis),
            diagnosis.reduced_chi2.map_or("", |_| {
                " Or the noise is larger than the scenes state (`noise`): left out, it is estimated."
            })
        ),
        _ => format!(
            "{count} throws together show nothing that is missing.{} An effect weaker than the noise \
             can still be there.",
            nearest_of_throws(diagnosis)
        ),
    }
}

/// How throws agree, in a sentence.
fn agreement(throws: &Agreement) -> String {
    let Some(p_value) = throws.p_value else { return String::new() };
    if p_value >= FALSE_ALARM {
        return " The throws agree on it.".to_string();
    }
    let scatter = significant(throws.scatter, 2);
    match throws.is_shared {
        true => format!(
            " The throws scatter {scatter} times more than their own errors say: the errors stated \
             here are larger by as much."
        ),
        false => format!(
            " But it isn't the same in all: the throws scatter {scatter} times more than their own \
             errors say, and each has its own{}; stated here is the mean.",
            spread(throws)
        ),
    }
}

/// From where to where the throws' own numbers go.
fn spread(throws: &Agreement) -> String {
    let Some(first) = throws.each.first() else { return String::new() };
    let of = |name: &String| {
        let own = throws.each.iter().filter_map(|throw| match throw.parameters[name].value {
            Some(Number::Scalar(value)) => Some(value),
            _ => None,
        });
        let own: Vec<f64> = own.collect();
        let (least, most) =
            (own.iter().copied().reduce(f64::min)?, own.into_iter().reduce(f64::max)?);
        Some(format!("{name} from {} to {}", significant(least, 3), significant(most, 3)))
    };
    let all: Vec<String> = first.parameters.keys().filter_map(of).collect();
    if all.is_empty() { String::new() } else { format!(" ({})", all.join(", ")) }
}

/// A candidate that is more probable than none, but isn't named: it leaves too much, or the throws
/// scatter too much about it.
fn nearest_of_throws(diagnosis: &Diagnosis) -> String {
    let best = diagnosis.candidates.first();
    let Some(best) = best.filter(|best| best.probability > diagnosis.probability_of_nothing) else {
        return String::new();
    };
    let agreement = best.throws.as_ref();
    let scatters = agreement.filter(|a| a.p_value.is_some_and(|p| p < FALSE_ALARM));
    let but = match scatters {
        Some(agreement) if !agreement.is_shared => format!(
            "it isn't the same in all{}, and leaves too much to be the only cause",
            spread(agreement)
        ),
        Some(agreement) => format!(
            "the throws scatter {} times more about it than their own errors say, and so few prove \
             nothing: film more of them",
            significant(agreement.scatter, 2)
        ),
        None if best.stands_out => "it leaves too much to be the only cause".to_string(),
        None => return String::new(),
    };
    let is_told = agreement.is_none_or(|agreement| agreement.is_shared);
    let values = match best.parameters.is_empty() || !is_told {
        true => String::new(),
        false => format!(" ({})", in_words(&best.parameters)),
    };
    format!(
        " The nearest is {}{values}: χ² falls by {} with it, but {but}.",
        best.label(),
        significant(best.delta_chi2, 3)
    )
}
