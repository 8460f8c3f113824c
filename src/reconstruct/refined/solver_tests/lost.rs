//! Fits that miss the poses by far: of little interest, and so of little work.

use super::super::optimum::HOPELESS;
use super::super::{Fitted, fit, instances};
use super::{options, read};
use crate::Result;
use crate::effect::EffectRequest;
use crate::reconstruct::RefinedOptions;

/// Two starts with friction leave the poses by hundreds of deviations, with the collision at the end of
/// its segment; the others find the optimum.
#[test]
fn what_has_lost_is_not_followed_to_its_end() {
    let scene = read("tests/data/stuck/gravity_scale+spin_drag_seed_70016.json");
    let [fitted, other_way]: [Fitted; 2] = [["spin_drag", "friction"], ["friction", "spin_drag"]]
        .map(|effects| fit(&scene, &options(&effects)).unwrap());
    assert!((fitted.chi2() / other_way.chi2() - 1.0).abs() < 1e-6);
    let least = fitted.best().solution.cost;
    let lost = fitted.optima.iter().filter(|optimum| optimum.solution.cost > least + HOPELESS);
    let converged: Vec<bool> = lost.map(|optimum| optimum.solution.converged).collect();
    assert!(!converged.is_empty());
    assert!(!converged.contains(&true), "{converged:?}");
}

/// The integration is as exact as what the fit misses asks for: beside the noise alone, that of a spin
/// which grows backwards without bounds never is.
#[test]
fn a_known_value_that_the_poses_contradict_has_a_fit() -> Result<()> {
    let scene = read("scenes/boxes.json");
    let base = fit(&scene, &RefinedOptions::default())?;
    let instance = &instances(&scene, &EffectRequest::parse("spin_drag@a:kappa=6.25")?)?[0];
    let fitted = base.with_from(instance, &base, &instance.null())?;
    assert!(fitted.chi2() > 100.0 * base.chi2());
    Ok(())
}
