//! The ladder in plain words.

use super::Improvement;
use crate::diagnose::{OtherLaw, Verdict};

/// What `improvement` says of what is missing.
pub(super) fn explanation(improvement: &Improvement) -> String {
    let law = improvement.other_laws.first().map(|law| of_a_law(improvement, law));
    let otherwise = improvement.otherwise.as_ref().map(|otherwise| otherwise.words.clone());
    let all = [Some(verdict(improvement)), otherwise, law];
    all.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

fn verdict(improvement: &Improvement) -> String {
    let added = improvement.ladder.iter().filter_map(|rung| rung.added.as_deref());
    match improvement.verdict {
        Verdict::NothingMissing => "Nothing is missing that these poses could show.".to_string(),
        // By name: values that several throws share stand, with all digits, in the commands.
        Verdict::Missing => format!(
            "With {} nothing more is missing that these poses could show.",
            each_once(added).join(" and ")
        ),
        Verdict::UnknownEffect if improvement.is_misread() => {
            "The poses are missed by far more than their noise.".to_string()
        }
        Verdict::UnknownEffect if improvement.law_alone().is_some() => {
            "No effect of the catalogue explains the poses.".to_string()
        }
        Verdict::UnknownEffect => {
            "Something is left that no effect explains; --try takes a law of \
                                   your own."
                .to_string()
        }
    }
}

fn of_a_law(improvement: &Improvement, law: &OtherLaw) -> String {
    let does = match improvement.ladder.len() {
        1 if law.leaves_more => "explains nearly all that is missing, though not all",
        1 => "explains the poses to their noise",
        2 => "does as well",
        _ => "does as well or nearly so, and may be what these effects imitate together",
    };
    format!("A law alone that the catalogue hasn't got {does}: {}.", law.in_words())
}

/// Each label once, with how often it comes.
fn each_once<'a>(labels: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for label in labels {
        match counts.iter_mut().find(|(known, _)| *known == label) {
            Some((_, count)) => *count += 1,
            None => counts.push((label, 1)),
        }
    }
    let in_words = |(label, count): (&str, usize)| match count {
        1 => label.to_string(),
        count => format!("{count} × {label}"),
    };
    counts.into_iter().map(in_words).collect()
}
