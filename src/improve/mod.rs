//! The ladder: fit, diagnose, add the missing effect, and again, until nothing significant is missing.

mod alike;
mod ladder;
mod search;
mod throws;
mod words;

pub use ladder::{EffectEstimate, IMPROVEMENT_SCHEMA, Improvement, Rung};
pub use throws::improve_throws;

use crate::diagnose::{Explained, Misread, Otherwise, Verdict, held_out_rmse_m, reported};
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::{self, Fitted};
use crate::{Reconstruction, Result, Scene};

/// Improves the model of `scene`, that of `options`, effect by effect. `further`: candidates beyond
/// the catalogue. Effects of `options` are kept whatever the data say of them.
///
/// # Errors
/// The scene can't be reconstructed, or an effect doesn't fit it.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let options = smash::reconstruct::RefinedOptions::default();
/// let improvement = smash::improve(&scene, &options, &[])?;
/// for rung in &improvement.ladder {
///     println!("{:?}: {:.2} mm", rung.added, 1e3 * rung.position_rmse);
/// }
/// # Ok::<(), smash::Error>(())
/// ```
pub fn improve(
    scene: &Scene,
    options: &RefinedOptions,
    further: &[EffectRequest],
) -> Result<Improvement> {
    let base = refined::fit(scene, options)?;
    let asked_again = |scene: &Scene| {
        let found = search::best_model(scene, &refined::fit(scene, options)?, further)?;
        let missing = found.steps.iter().map(|step| step.instance.label(scene)).collect();
        Ok(Explained { missing, fitted: found.fitted, leaves_more: found.is_structured })
    };
    let misread = Misread::told(scene, &base, further, asked_again)?;
    if let Some((misread, false)) = misread {
        let result = reported(scene, &base)?;
        let ladder = vec![rung(&base, &result)];
        let improvement = Improvement::new(scene, ladder, result);
        return Ok(Improvement { otherwise: Some(misread), ..improvement }.told());
    }
    let found = search::best_model(scene, &base, further)?;
    let mut fits = vec![base];
    for step in &found.steps {
        fits.push(fits[fits.len() - 1].with(scene, &step.instance)?);
    }
    let results: Vec<Reconstruction> =
        fits.iter().map(|fitted| reported(scene, fitted)).collect::<Result<_>>()?;
    let [.., result] = results.as_slice() else { unreachable!("there is a base") };
    let with: Vec<String> = found.steps.iter().map(|step| step.instance.label(scene)).collect();
    let mut rungs = Vec::new();
    for (index, (fitted, own)) in fits.iter().zip(&results).enumerate() {
        let mut rung = rung(fitted, own);
        rung.with = with[..index].to_vec();
        if let Some(step) = index.checked_sub(1) {
            let effect = &result.effects[fits[0].acting.len() + step];
            let added = EffectEstimate {
                effect: with[step].clone(),
                parameters: effect.parameters.clone(),
            };
            rung = rung.adding(added, alike::alike(scene, &fits[0], &found.steps, step)?);
            rung.p_value = Some(found.steps[step].p_value);
        }
        rungs.push(rung);
    }
    let verdict = match (found.is_structured, found.steps.is_empty()) {
        (true, _) => Verdict::UnknownEffect,
        (false, true) => Verdict::NothingMissing,
        (false, false) => Verdict::Missing,
    };
    let otherwise = match found.other_laws.first() {
        _ if misread.is_some() => misread.map(|(misread, _)| misread),
        // Poses that a law explains to their noise need no other explanation.
        Some(law) if found.steps.is_empty() && !law.leaves_more => None,
        _ => Otherwise::of(scene, &fits[fits.len() - 1], found.is_structured, asked_again),
    };
    let improvement = Improvement {
        dropped: found.dropped,
        verdict,
        other_laws: found.other_laws,
        otherwise,
        ..Improvement::new(scene, rungs, result.clone())
    };
    Ok(improvement.told())
}

/// A rung of the ladder that adds nothing yet.
fn rung(fitted: &Fitted, result: &Reconstruction) -> Rung {
    Rung {
        orientation_rmse: result.fit.orientation_rmse,
        reduced_chi2: result.fit.reduced_chi2,
        heldout_position_rmse: held_out_rmse_m(fitted),
        mass_ratio: result.mass_ratio.as_ref().and_then(|estimate| estimate.value),
        restitution: result.restitution.value,
        ..Rung::of(result.fit.position_rmse)
    }
}
