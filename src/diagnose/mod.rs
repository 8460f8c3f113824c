//! Which physics the model lacks: all effects of the catalogue against what a fit leaves over.
//!
//! ```text
//! scene ─► fit ─► every candidate ─► evidence ─────────► ranking ──────► verdict ─► words, advice
//!                 (refitted warm)    p-value, BIC,       probabilities,   missing,
//!                                    held-out error      look-alikes      nothing, unknown
//! ```

mod advice;
mod best_of_throws;
mod candidates;
mod dependence;
mod diagnosis;
mod evidence;
mod forms;
mod goodness;
mod held_out;
mod leftover;
mod misread;
mod misses;
mod near_collision;
mod near_collisions;
mod other_noise;
mod otherwise;
mod own;
mod pooled;
mod ranking;
mod rivals;
mod shared_errors;
mod swing;
mod throws;
mod throws_in_words;
mod throws_told;
mod together;
mod told;
mod tried;
mod unexplained;
mod verdict;
mod words;

pub use advice::MISREAD;
pub use diagnosis::{
    Agreement, CandidateReport, DIAGNOSIS_SCHEMA, Diagnosis, Shift, ThrowEstimate, Verdict,
};
pub use misread::{Misread, Orientations};
pub use near_collision::NearCollision;
pub use near_collisions::{NearCollisions, RoughThrow};
pub use other_noise::OtherNoise;
pub use otherwise::{Cause, Otherwise};
pub use rivals::OtherLaw;
pub use shared_errors::SharedErrors;
pub use throws::diagnose_throws;
pub use together::{ThrowValue, Together};
pub use unexplained::{Form, Kind, Unexplained};

pub(crate) use advice::telling_apart;
pub(crate) use best_of_throws::{alike, put_best_first, with_effect, with_own};
pub(crate) use candidates::{Candidate, all_candidates, candidate, of_a_body};
pub(crate) use dependence::{inflation_of, quasi_bic};
pub(crate) use diagnosis::yes;
pub(crate) use evidence::{Evidence, critical_chi2, evidence};
pub(crate) use goodness::Goodness;
pub(crate) use held_out::{HeldOut, held_out_rmse_m};
pub(crate) use leftover::Leftover;
pub(crate) use near_collisions::ExplainedThrows;
pub(crate) use otherwise::Explained;
pub(crate) use pooled::{PooledCandidate, Throw, pooled};
pub(crate) use ranking::{TELLS_APART, look_alikes, quasi};
pub(crate) use rivals::rivals;
pub(crate) use throws::{instances, looks, reduced_chi2, throws};
pub(crate) use together::together;
pub(crate) use tried::{Tried, tried};
pub(crate) use words::{in_words, listed};

use crate::effect::EffectRequest;
use crate::reconstruct::refined::{self, Fitted};
use crate::reconstruct::{Intervals, RefinedOptions};
use crate::{Result, Scene};

/// How often noise alone may seem an effect, whichever of all candidates.
pub(crate) const FALSE_ALARM: f64 = 0.01;

/// Finds which effect is missing from the model of `scene`: that of `options`, with the effects in
/// it. `further`: candidates beyond the catalogue.
///
/// # Errors
/// The scene can't be reconstructed, or an effect doesn't fit it.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let diagnosis = smash::diagnose(&scene, &smash::reconstruct::RefinedOptions::default(), &[])?;
/// println!("{}", diagnosis.explanation);
/// # Ok::<(), smash::Error>(())
/// ```
pub fn diagnose(
    scene: &Scene,
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<Diagnosis> {
    let explained = |scene: &Scene| {
        let mut best = None;
        let fitted = refined::fit(scene, options)?;
        let diagnosis = diagnosed(scene, &fitted, further, |fitted, _| {
            best = Some(fitted.clone());
            None
        })?;
        Ok(Explained {
            missing: diagnosis.missing().map(CandidateReport::label).into_iter().collect(),
            fitted: best.expect("each diagnosis asks what else it may be"),
            leaves_more: diagnosis.verdict == Verdict::UnknownEffect || diagnosis.stays_structured,
        })
    };
    let fitted = refined::fit(scene, options)?;
    match Misread::told(scene, &fitted, further, explained)? {
        Some((misread, true)) => diagnosed(scene, &fitted, further, |_, _| Some(misread)),
        Some((misread, false)) => verdict::of_misread(scene, &fitted, misread),
        None => diagnosed(scene, &fitted, further, |fitted, is_structured| {
            Otherwise::of(scene, fitted, is_structured, explained)
        }),
    }
}

/// `otherwise`: what else may leave what the best model leaves, more than noise if the second is so.
fn diagnosed(
    scene: &Scene,
    fitted: &Fitted,
    further: &[EffectRequest],
    otherwise: impl FnOnce(&Fitted, bool) -> Option<Otherwise>,
) -> Result<Diagnosis> {
    let instances = all_candidates(scene, fitted, further)?;
    let tried = tried(scene, fitted, &instances);
    verdict::diagnosis(scene, fitted, instances, tried, otherwise)
}

/// The reconstruction of a fitted model, with covariance intervals.
pub(crate) fn reported(scene: &Scene, fitted: &Fitted) -> Result<crate::Reconstruction> {
    refined::report(scene, fitted, Intervals::Covariance)
}
