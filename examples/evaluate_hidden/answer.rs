//! What `diagnose` answers, and whether that is right.

use smash::diagnose::{Diagnosis, Verdict};
use smash::effect::EffectRequest;
use smash::reconstruct::RefinedOptions;
use smash::{Result, Scene};

use crate::case::Case;
use crate::fit::Fit;

/// A diagnosis, in short.
pub struct Answer {
    pub verdict: Verdict,
    /// `NAME@BODY` of what comes first, where something is named.
    pub first: Option<String>,
    /// What can't be told from it.
    pub alike: Vec<String>,
    /// Whether it says that the effect leaves more than noise.
    pub stays_structured: bool,
    /// Whether it says that a law outside the catalogue can't be told from the effect.
    pub names_other_laws: bool,
}

impl Answer {
    /// # Errors
    /// As of [`smash::diagnose`].
    pub fn of(scene: &Scene) -> Result<Answer> {
        Ok(Answer::by(&smash::diagnose(scene, &RefinedOptions::default(), &[])?))
    }

    /// That of throws together.
    ///
    /// # Errors
    /// As of [`smash::diagnose_throws`].
    pub fn of_throws(scenes: &[Scene]) -> Result<Answer> {
        Ok(Answer::by(&smash::diagnose_throws(scenes, &RefinedOptions::default(), &[])?))
    }

    fn by(diagnosis: &Diagnosis) -> Answer {
        let is_named = diagnosis.verdict == Verdict::Missing;
        let first = diagnosis.candidates.first().filter(|_| is_named);
        Answer {
            verdict: diagnosis.verdict,
            first: first.map(|first| first.label()),
            alike: first.map_or(Vec::new(), |first| first.indistinguishable_from.clone()),
            stays_structured: diagnosis.stays_structured,
            names_other_laws: !diagnosis.other_laws.is_empty(),
        }
    }

    /// In a word.
    pub fn in_words(&self) -> String {
        match (&self.first, self.verdict) {
            (Some(first), _) => first.clone(),
            (None, Verdict::NothingMissing) => "nothing_missing".into(),
            (None, _) => "unknown_effect".into(),
        }
    }

    pub fn is_detected(&self) -> bool {
        self.verdict != Verdict::NothingMissing
    }

    /// Whether an effect of the case comes first, on its body.
    pub fn is_first(&self, case: &Case) -> bool {
        self.first.as_ref().is_some_and(|first| case.labels().contains(first))
    }

    /// Whether it comes first, or among those that can't be told from the first.
    pub fn is_in_set(&self, case: &Case) -> bool {
        let labels = case.labels();
        self.is_first(case) || self.alike.iter().any(|label| labels.contains(label))
    }

    /// Whether what comes first has the same consequences by the laws of physics, in such scenes.
    pub fn is_of_class(&self, case: &Case) -> bool {
        let bodies = case.scene.bodies().len();
        let name = |label: &String| label.split('@').next().unwrap_or(label).to_owned();
        let is_class = |first: &String| {
            case.labels().iter().any(|label| alike(&name(label), &name(first), bodies))
        };
        self.is_in_set(case) || self.first.as_ref().is_some_and(is_class)
    }

    /// The model that it asks for.
    ///
    /// # Errors
    /// It can't be fitted.
    pub fn fit(&self, case: &Case) -> Result<Fit> {
        let named = self.first.iter().map(|label| EffectRequest::parse(label));
        Fit::of(case, &named.collect::<Result<Vec<_>>>()?)
    }
}

/// Effects that no data, or hardly any, tell apart.
fn alike(one: &str, other: &str, bodies: usize) -> bool {
    let classes: [(&[&str], bool); 5] = [
        // The fall of one body has only one direction.
        (&["constant_force", "gravity_tilt", "gravity_scale"], bodies == 1),
        // At speeds that hardly change.
        (&["linear_drag", "quadratic_drag"], true),
        // Weak, on the way to a floor and back.
        (&["linear_drag", "quadratic_drag", "gravity_tilt", "friction"], bodies == 1),
        // At the moment of the collision.
        (
            &["second_impact", "friction", "external_impulse", "torsional_impulse", "time_offset"],
            true,
        ),
        // At the first or the last pose.
        (&["outlier", "second_impact"], true),
    ];
    let both = |names: &[&str]| names.contains(&one) && names.contains(&other);
    classes.iter().any(|(names, holds)| *holds && both(names))
}
