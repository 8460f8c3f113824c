//! The answer in plain words.

use std::collections::BTreeMap;

use super::FALSE_ALARM;
use super::diagnosis::{CandidateReport, Diagnosis, Verdict};
use super::otherwise::Otherwise;
use super::ranking::TELLS_APART;
use super::rivals::OtherLaw;
use super::unexplained::{Kind, Unexplained};
use crate::effect::catalogue;
use crate::reconstruct::ParameterEstimate;
use crate::words::{counted, measured, significant, with_std};

/// What `diagnosis` says. `pair`: two effects that explain together what one doesn't.
pub(super) fn explanation(diagnosis: &Diagnosis, pair: Option<&str>) -> String {
    let model = if diagnosis.model.is_empty() { "The base model" } else { "The model" };
    let left: String = diagnosis.unexplained.iter().map(leftover).collect();
    let told = |otherwise: &Otherwise| format!(" {}", otherwise.words);
    let errors = diagnosis.otherwise.as_ref().map_or(String::new(), told);
    match (diagnosis.verdict, diagnosis.candidates.first()) {
        (Verdict::NothingMissing, best) => nothing(model, diagnosis, best) + &errors,
        (Verdict::UnknownEffect, best) => {
            let best = best.filter(|best| best.stands_out);
            // Before laws to try: of noise that is misstated each is made up.
            format!("{model} misses the poses by more than their noise.")
                + &errors
                + &helping(best, diagnosis.other_laws.first())
                + &left
        }
        (Verdict::Missing, Some(best)) => {
            missing(best, pair, diagnosis.stays_structured)
                + &errors
                + &left
                + &or_another(best, &diagnosis.other_laws)
        }
        (Verdict::Missing, None) => String::new(),
    }
}

fn nothing(model: &str, diagnosis: &Diagnosis, best: Option<&CandidateReport>) -> String {
    let fit = match diagnosis.reduced_chi2 {
        Some(reduced) => format!(" (χ² per degree of freedom {reduced:.2})"),
        None => String::new(),
    };
    let closest = best.map_or(String::new(), |best| format!(" {}", closest(best)));
    format!(
        "{model} explains the poses to their noise{fit}: nothing is missing that these poses could \
         show.{closest} An effect weaker than the noise can still be there."
    )
}

/// How near the best candidate comes that doesn't stand out.
fn closest(best: &CandidateReport) -> String {
    let label = best.label();
    if best.p_value >= 0.5 {
        return format!("The best candidate, {label}, does no more than noise alone would.");
    }
    let percent = significant(100.0 * best.p_value, 2);
    if best.p_value >= FALSE_ALARM {
        return format!(
            "The best candidate is {label}; by noise alone one would look as good in {percent} of \
             100 such scenes."
        );
    }
    format!(
        "The best candidate, {label}, fits better than noise alone would in {percent} of 100 such \
         scenes, but doesn't predict unseen poses better, or isn't worth its parameters."
    )
}

/// What helps, and doesn't explain it.
fn helping(best: Option<&CandidateReport>, law: Option<&OtherLaw>) -> String {
    match (best, law) {
        (Some(best), Some(law)) => format!(
            " The best candidate, {}, helps (χ² falls by {}), but a law that the catalogue hasn't \
             got explains more (χ² falls by {}): {}. {}.",
            best.label(),
            significant(best.delta_chi2, 3),
            significant(law.delta_chi2, 3),
            law.in_words(),
            match law.leaves_more {
                true => "Something is left even with it",
                false => "With it nothing is left but noise",
            }
        ),
        (Some(best), None) => format!(
            " The best candidate, {}, helps (χ² falls by {}), but leaves too much: don't take it for \
             the cause.",
            best.label(),
            significant(best.delta_chi2, 3)
        ),
        (None, _) => " No effect of the catalogue explains it.".to_string(),
    }
}

impl OtherLaw {
    /// What it is, with its line and values.
    pub fn in_words(&self) -> String {
        let body = self.effect.body.as_deref().unwrap_or("all bodies");
        let values = in_words(&self.effect.parameters);
        format!("on {body}, one that goes with {}: {} with {values}", self.goes_with, self.law)
    }
}

/// What is as good as `best`, which is named.
fn or_another(best: &CandidateReport, laws: &[OtherLaw]) -> String {
    let law = laws.iter().find(|law| !law.is_a_push()).map_or(String::new(), |law| {
        format!(
            " These poses can't tell it from a law that the catalogue hasn't got: {}.",
            law.in_words()
        )
    });
    let push = laws.iter().find(|law| law.is_a_push()).map(|push| or_a_push(best, push));
    law + &push.unwrap_or_default()
}

/// What an impulse may have been instead.
fn or_a_push(best: &CandidateReport, push: &OtherLaw) -> String {
    let mut sizes = push.effect.parameters.clone();
    sizes.retain(|name, _| name != "from" && name != "rate");
    let push_of = format!("{}, with {}", push.goes_with.replace("time: ", ""), in_words(&sizes));
    // Each has as many numbers as the other.
    match push.delta_chi2 > best.delta_chi2 + TELLS_APART {
        true => format!(
            " But it was hardly a blow: {push_of}, as of a hand or a string, explains more (χ² falls by \
             {}).",
            significant(push.delta_chi2, 3)
        ),
        false => format!(
            " It need not be a blow: these poses can't tell it from {push_of}, as of a hand or a string. \
             More frames a second about that time would tell."
        ),
    }
}

/// A law that goes with less of what is left than this share is no hint.
const WORTH_A_LAW: f64 = 0.25;

/// What is left over, in a sentence.
fn leftover(one: &Unexplained) -> String {
    let (what, unit) = match one.kind {
        Kind::Acceleration => ("a further acceleration", "m/s²"),
        Kind::Torque => ("a further torque per unit of its mass", "m²/s²"),
        Kind::Position => return swing(one),
    };
    let best = one.forms.first().filter(|form| form.share > WORTH_A_LAW);
    let best = best.map_or(String::new(), |form| {
        format!(
            "; {} % of it goes with {}: try {}",
            significant(100.0 * form.share, 2),
            form.goes_with,
            form.law
        )
    });
    format!(" {} feels {what} of {} {unit} (rms){best}.", one.body, significant(one.rms, 2))
}

/// A tracked point that goes round.
fn swing(one: &Unexplained) -> String {
    let how = one.forms.first().map_or(String::new(), |form| {
        format!(
            " in {}; it may be a point that isn't the centre of a body that turns unseen: try {} with \
             rate = {} rad/s",
            form.goes_with,
            form.law,
            significant(form.factor, 3)
        )
    });
    format!(
        " {}'s tracked point is off by {} mm (rms){how}.",
        one.body,
        significant(1e3 * one.rms, 2)
    )
}

pub(super) fn missing(
    best: &CandidateReport,
    pair: Option<&str>,
    stays_structured: bool,
) -> String {
    let looks = catalogue().iter().find(|effect| effect.name == best.effect);
    let title = looks.map_or(best.effect.as_str(), |effect| effect.title.as_str());
    let is = if stays_structured && pair.is_none() { "seems to be" } else { "is" };
    let mut text = format!("{} {is} missing: {title}", best.label());
    if !best.parameters.is_empty() {
        text += &format!(" ({})", in_words(&best.parameters));
    }
    text += &format!(
        ". With it χ² falls by {}, for {}",
        significant(best.delta_chi2, 3),
        counted(best.parameters_added, "parameter")
    );
    if let (Some(before), Some(after)) = (best.heldout_rmse_before, best.heldout_rmse_after)
        && after < before
    {
        text += &format!(
            ", and positions that the fit hasn't seen are missed by {} mm instead of {} mm",
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
    text += &match (pair, stays_structured) {
        (Some(pair), true) => format!(
            " It isn't alone: the residuals stay structured with it, while {pair} together explain the \
             poses to their noise; or a law does that the catalogue hasn't got."
        ),
        (None, true) => " But the residuals stay structured: it may be only the nearest that the \
                         catalogue has, or one of several that are missing."
            .to_string(),
        (_, false) => String::new(),
    };
    text
}

/// `k = 0.150 ± 0.012 1/m`, and so on.
pub(crate) fn in_words(parameters: &BTreeMap<String, ParameterEstimate>) -> String {
    let one = |(name, estimate): (&String, &ParameterEstimate)| {
        let joined = |parts: Vec<String>| match parts.as_slice() {
            [one] => one.clone(),
            all => format!("[{}]", all.join(", ")),
        };
        let number = match (&estimate.value, &estimate.std) {
            (None, _) => "unknown".to_string(),
            (Some(value), None) => {
                joined(value.components().iter().map(|value| significant(*value, 3)).collect())
            }
            (Some(value), Some(std)) => {
                let pairs = value.components().iter().zip(std.components());
                let (values, stds): (Vec<String>, Vec<String>) =
                    pairs.map(|(value, std)| with_std(*value, *std).into()).unzip();
                format!("{} ± {}", joined(values), joined(stds))
            }
        };
        format!("{name} = {}", measured(&number, &estimate.unit))
    };
    parameters.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// `a, b or c`.
pub(crate) fn listed(names: &[String]) -> String {
    match names {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} or {last}", rest.join(", ")),
    }
}
