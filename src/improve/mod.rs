//! The ladder: fit, diagnose, add the missing effect, and again, until nothing significant is missing.

mod ladder;
mod search;
mod throws;

pub use ladder::{EffectEstimate, IMPROVEMENT_SCHEMA, Improvement, Rung};
pub use throws::improve_throws;

use std::collections::BTreeMap;

use crate::diagnose::{Verdict, held_out_rmse_m, reported};
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::{self, Fitted, Instance};
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
    let found = search::best_model(scene, &base, further)?;
    let mut rungs = vec![rung(&base, &reported(scene, &base)?)];
    let mut fitted = base;
    for step in &found.steps {
        let look_alikes = step.look_alikes.iter().map(|other| {
            let result = reported(scene, &fitted.with(scene, other)?)?;
            Ok(last_effect(scene, other, &result))
        });
        let look_alikes = look_alikes.collect::<Result<_>>()?;
        fitted = fitted.with(scene, &step.instance)?;
        let result = reported(scene, &fitted)?;
        let added = last_effect(scene, &step.instance, &result);
        let next = rung(&fitted, &result).adding(added, look_alikes);
        rungs.push(Rung { p_value: Some(step.p_value), ..next });
    }
    let with: Vec<String> = found.steps.iter().map(|step| step.instance.label(scene)).collect();
    for (index, rung) in rungs.iter_mut().enumerate() {
        rung.with = with[..index].to_vec();
    }
    let verdict = match (found.is_structured, found.steps.is_empty()) {
        (true, _) => Verdict::UnknownEffect,
        (false, true) => Verdict::NothingMissing,
        (false, false) => Verdict::Missing,
    };
    let result = reported(scene, &fitted)?;
    Ok(Improvement::new(scene, verdict, rungs, found.dropped, result))
}

/// How large `instance` is, which is the last effect of `result`.
fn last_effect(scene: &Scene, instance: &Instance, result: &Reconstruction) -> EffectEstimate {
    let parameters = result.effects.last().map(|effect| effect.parameters.clone());
    EffectEstimate { effect: instance.label(scene), parameters: parameters.unwrap_or_default() }
}

/// A rung of the ladder that adds nothing yet.
fn rung(fitted: &Fitted, result: &Reconstruction) -> Rung {
    Rung {
        added: None,
        with: Vec::new(),
        p_value: None,
        parameters: BTreeMap::new(),
        indistinguishable_from: Vec::new(),
        look_alikes: Vec::new(),
        position_rmse: result.fit.position_rmse,
        orientation_rmse: result.fit.orientation_rmse,
        reduced_chi2: result.fit.reduced_chi2,
        heldout_position_rmse: held_out_rmse_m(fitted),
        mass_ratio: result.mass_ratio.as_ref().and_then(|estimate| estimate.value),
        restitution: result.restitution.value,
    }
}
