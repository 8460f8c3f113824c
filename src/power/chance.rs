//! How probable it is that an effect is found.

use super::film::{Film, Shown};
use super::tail::exceeds;
use crate::diagnose::{all_candidates, critical_chi2, evidence};
use crate::effect::EffectRequest;
use crate::reconstruct::refined::{Instance, instances, points};
use crate::scene::Scene;
use crate::simulate::EffectSpec;
use crate::{Error, Result};

/// What decides whether a diagnosis finds an effect in a film.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chance {
    /// χ² of the model without the effect, fitted to poses without noise: the noncentrality of the
    /// test.
    pub lambda: f64,
    /// Independent numbers that the effect adds.
    pub parameters: usize,
    /// What χ² must fall by.
    pub critical: f64,
    /// Candidates that a diagnosis tries.
    pub tried: usize,
    /// Annotated poses of all bodies.
    pub poses: usize,
}

impl Chance {
    /// That of `effect` in `film`.
    ///
    /// # Errors
    /// The film can't be made or fitted, or its poses don't depend on the effect.
    pub fn of(film: &Film, effect: &EffectSpec) -> Result<Chance> {
        let shown = film.shown(effect)?;
        let Shown { scene, fitted, .. } = &shown;
        let instance = sought(scene, effect)?;
        let tried = candidates(&shown, effect)?.len();
        let scanned = points(scene, &instance).len().max(1);
        let with = fitted.with(scene, &instance)?;
        let Some(evidence) = evidence(fitted, &with, scanned, tried) else {
            let problem = "changes no pose in a way that the model without it couldn't explain";
            return Err(Error::invalid(instance.label(scene), problem)
                .mend("plan another film: more of the flight, other speeds and spins"));
        };
        let parameters = evidence.parameters;
        let poses = instance.is_of_a_pose().then_some(scanned);
        Ok(Chance {
            lambda: fitted.chi2(),
            parameters,
            critical: critical_chi2(parameters, (scanned, tried), fitted.numbers(), poses),
            tried,
            poses: scene.bodies().iter().map(|body| body.observations.len()).sum(),
        })
    }

    /// The probability that it is found.
    pub fn power(&self) -> f64 {
        exceeds(self.critical, self.parameters, self.lambda)
    }
}

/// The one that `effect` is in `scene`.
///
/// # Errors
/// There is no such effect or body, the scene can't show it, or there are several.
pub(super) fn sought(scene: &Scene, effect: &EffectSpec) -> Result<Instance> {
    let mut all = instances(scene, &effect.unknown()?)?;
    if all.len() > 1 {
        let labels: Vec<String> = all.iter().map(|one| one.label(scene)).collect();
        return Err(Error::invalid(&effect.name, "acts on each body for itself")
            .mend(format!("name the body: {}", labels.join(" or "))));
    }
    all.pop().ok_or_else(|| Error::invalid(&effect.name, "acts on no body of the scene"))
}

/// All that a diagnosis would try; also `effect` itself, if it is a user's.
pub(super) fn candidates(shown: &Shown, effect: &EffectSpec) -> Result<Vec<Instance>> {
    let request = effect.unknown()?;
    let is_built_in =
        crate::effect::catalogue().iter().any(|known| known.name == request.effect.name);
    let further: Vec<EffectRequest> = if is_built_in { Vec::new() } else { vec![request] };
    all_candidates(&shown.scene, &shown.fitted, &further)
}
