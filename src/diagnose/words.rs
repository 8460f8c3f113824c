//! The answer in plain words.

use super::diagnosis::{CandidateReport, Diagnosis, Verdict};
use crate::effect::catalogue;
use crate::words::significant;

/// What `diagnosis` says. `pair`: two effects that explain together what one doesn't;
/// `stays_structured`: whether even the best leaves more than noise.
pub(super) fn explanation(
    diagnosis: &Diagnosis,
    pair: Option<&str>,
    stays_structured: bool,
) -> String {
    let model = match diagnosis.model.is_empty() {
        true => "The base model".to_string(),
        false => "The model".to_string(),
    };
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::NothingMissing, best) => nothing(&model, diagnosis, best),
        (Verdict::UnknownEffect, best) => unknown(&model, best.filter(|best| best.stands_out)),
        (Verdict::Missing, Some(best)) => missing(best, pair, stays_structured),
        (Verdict::Missing, None) => String::new(),
    }
}

/// What the `diagnosis` of `count` throws together says.
pub(super) fn explanation_of_throws(diagnosis: &Diagnosis, count: usize) -> String {
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::Missing, Some(best)) => {
            let mut text = format!("In {count} throws together: {}", missing(best, None, false));
            let agreement = best.throws.as_ref();
            if let Some((p, scatter)) = agreement.and_then(|a| Some((a.p_value?, a.scatter))) {
                text += &match p < 0.01 {
                    false => " The throws agree on it.".to_string(),
                    true => format!(
                        " The throws scatter {} times more than their own errors say: the errors \
                         stated here are larger by as much.",
                        significant(scatter, 2)
                    ),
                };
            }
            text
        }
        (Verdict::UnknownEffect, _) => format!(
            "Most of the {count} throws are missed by more than their noise, and no effect that they \
             could share explains it."
        ),
        _ => format!(
            "{count} throws together show nothing that is missing. An effect weaker than the noise \
             can still be there."
        ),
    }
}

fn nothing(model: &str, diagnosis: &Diagnosis, best: Option<&CandidateReport>) -> String {
    let fit = match diagnosis.reduced_chi2 {
        Some(reduced) => format!(" (χ² per degree of freedom {reduced:.2})"),
        None => String::new(),
    };
    let closest = best.map_or(String::new(), |best| {
        format!(
            " The closest candidate is {}: noise alone would seem as much of one in {} of 100 such \
             scenes.",
            best.label(),
            significant(100.0 * best.p_value, 2)
        )
    });
    format!(
        "{model} explains the poses to their noise{fit}: nothing is missing that these poses could \
         show.{closest} An effect weaker than the noise can still be there."
    )
}

fn unknown(model: &str, best: Option<&CandidateReport>) -> String {
    let tried = match best {
        Some(best) => format!(
            " The best of the catalogue, {}, helps (χ² falls by {}), but leaves most of it: don't \
             take it for the cause.",
            best.label(),
            significant(best.delta_chi2, 3)
        ),
        None => " No effect of the catalogue explains it.".to_string(),
    };
    format!("{model} misses the poses by more than their noise.{tried}")
}

fn missing(best: &CandidateReport, pair: Option<&str>, stays_structured: bool) -> String {
    let looks = catalogue().iter().find(|effect| effect.name == best.effect);
    let title = looks.map_or(best.effect.as_str(), |effect| effect.title.as_str());
    let mut text = format!("{} is missing: {}", best.label(), lower_first(title));
    if !best.parameters.is_empty() {
        text += &format!(" ({})", parameters(best));
    }
    text += &format!(
        ". With it χ² falls by {} for {} {}",
        significant(best.delta_chi2, 3),
        best.parameters_added,
        if best.parameters_added == 1 { "number" } else { "numbers" }
    );
    if let (Some(before), Some(after)) = (best.heldout_rmse_before, best.heldout_rmse_after) {
        text += &format!(
            ", and poses that it hasn't seen are missed by {} mm instead of {} mm",
            significant(1e3 * after, 3),
            significant(1e3 * before, 3)
        );
    }
    text += ".";
    for shift in best.shifts.iter().filter(|shift| shift.in_sigma.is_some_and(|s| s.abs() > 1.0)) {
        text += &format!(
            " The {} moves from {} to {}.",
            shift.quantity.replace('_', " "),
            significant(shift.before, 4),
            significant(shift.after, 4)
        );
    }
    if !best.indistinguishable_from.is_empty() {
        text +=
            &format!(" These poses can't tell it from {}.", listed(&best.indistinguishable_from));
    }
    match (pair, stays_structured) {
        (Some(pair), _) => {
            text += &format!(" It isn't alone: {pair} together explain the poses to their noise.");
        }
        (None, true) => {
            text += " But the residuals stay structured: it may be only the nearest that the \
                     catalogue has, or one of several.";
        }
        (None, false) => {}
    }
    text
}

/// `k = 0.150 ± 0.012 1/m`, and so on.
pub(super) fn parameters(candidate: &CandidateReport) -> String {
    let one = |(name, estimate): (&String, &crate::reconstruct::ParameterEstimate)| {
        let shown = |number: &crate::reconstruct::Number| {
            let parts: Vec<String> =
                number.components().iter().map(|value| significant(*value, 3)).collect();
            if parts.len() == 1 { parts[0].clone() } else { format!("[{}]", parts.join(", ")) }
        };
        let value = estimate.value.as_ref().map_or("unknown".to_string(), shown);
        let std = estimate.std.as_ref().map(|std| format!(" ± {}", shown(std)));
        let unit = if estimate.unit == "1" { String::new() } else { format!(" {}", estimate.unit) };
        format!("{name} = {value}{}{unit}", std.unwrap_or_default())
    };
    candidate.parameters.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// `a, b or c`.
pub(super) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => first.to_lowercase().chain(letters).collect(),
        None => String::new(),
    }
}
