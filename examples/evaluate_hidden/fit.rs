//! Models of one scene, to be held against each other and against the truth.

use smash::effect::EffectRequest;
use smash::reconstruct::RefinedOptions;
use smash::{Options, Reconstruction, Result};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use crate::case::Case;

/// A model fitted to a case.
pub struct Fit {
    pub result: Reconstruction,
    /// −2 ln L but for a constant: χ² where the noise is stated.
    pub deviance: f64,
    numbers: f64,
    poses: f64,
}

impl Fit {
    /// The base model with `effects`.
    ///
    /// # Errors
    /// As of [`smash::reconstruct`].
    pub fn of(case: &Case, effects: &[EffectRequest]) -> Result<Fit> {
        let options = RefinedOptions { effects: effects.to_vec(), ..RefinedOptions::default() };
        let result = smash::reconstruct(&case.scene, &Options::Refined(options))?;
        Ok(Fit::from(case, result))
    }

    /// What a result says of a case.
    pub fn from(case: &Case, result: Reconstruction) -> Fit {
        let seen = || case.scene.bodies().iter().flat_map(|body| &body.observations);
        let positions = 3.0 * seen().count() as f64;
        let turns = 3.0 * seen().filter(|pose| pose.world_from_body.is_some()).count() as f64;
        let likelihood = || {
            positions * result.fit.position_rmse.powi(2).ln()
                + result.fit.orientation_rmse.map_or(0.0, |rmse| turns * rmse.powi(2).ln())
        };
        let deviance = result.fit.chi2.unwrap_or_else(likelihood);
        Fit { result, deviance, numbers: positions + turns, poses: positions / 3.0 }
    }

    /// Schwarz's criterion but for a constant; the choice of a wrong pose counts too.
    pub fn bic(&self) -> f64 {
        let outliers = self.result.effects.iter().filter(|effect| effect.name == "outlier").count();
        self.deviance - self.result.fit.dof as f64 * self.numbers.ln()
            + 2.0 * outliers as f64 * self.poses.ln()
    }

    /// By how much χ² is worse than with the effects' numbers at the truth; `None` where those aren't known.
    ///
    /// # Errors
    /// As of [`Fit::of`].
    pub fn missed(&self, case: &Case) -> Result<Option<f64>> {
        let known = case.true_effects.as_ref().map(|known| Fit::of(case, known)).transpose()?;
        Ok(known.map(|known| self.deviance - known.deviance))
    }

    /// How far mass ratio and restitution are from those that another solver finds, in their deviations.
    pub fn differs(&self, case: &Case) -> Vec<f64> {
        let own = [self.result.mass_ratio.as_ref(), Some(&self.result.restitution)];
        let pairs = own.into_iter().zip(case.found_elsewhere);
        let differs = pairs.filter_map(|(own, other)| {
            let (own, other) = (own?, other?);
            Some((own.value? - other).abs() / own.std?)
        });
        differs.collect()
    }

    /// The errors against the truth.
    pub fn errors(&self, case: &Case) -> Errors {
        let result = &self.result;
        let mass_ratio = result.mass_ratio.as_ref().and_then(|estimate| estimate.value);
        // So much of the noise a right model leaves.
        let left = (result.fit.dof as f64 / self.numbers).max(0.0).sqrt();
        Errors {
            chi2: result.fit.chi2.zip(ChiSquared::new(result.fit.dof as f64).ok()),
            position: result.fit.position_rmse / (case.noise.position * left),
            orientation: result
                .fit
                .orientation_rmse
                .map(|rad| rad / (case.noise.orientation * left)),
            mass_ratio: case
                .mass_ratio
                .map(|truth| mass_ratio.map_or(f64::INFINITY, |found| (found / truth - 1.0).abs())),
            restitution: match result.restitution.value {
                Some(found) => (found - case.restitution).abs(),
                None => f64::INFINITY,
            },
            covered: [
                result.mass_ratio.as_ref().zip(case.mass_ratio),
                Some((&result.restitution, case.restitution)),
            ]
            .into_iter()
            .flatten()
            .filter_map(|(estimate, truth)| {
                let [low, high] = estimate.interval_95?;
                Some((low..=high).contains(&truth))
            })
            .collect(),
        }
    }
}

/// How far a fit is from the truth; infinite where it tells nothing.
pub struct Errors {
    chi2: Option<(f64, ChiSquared)>,
    /// Root mean square over the noise, as much as a fit of so many parameters leaves.
    pub position: f64,
    pub orientation: Option<f64>,
    /// |m / m_true − 1|; `None` against a static body.
    pub mass_ratio: Option<f64>,
    pub restitution: f64,
    /// Whether the truth is in the 95 % intervals of the mass ratio and of the restitution, as far as
    /// there are some.
    pub covered: Vec<bool>,
}

impl Errors {
    /// Whether χ² is where it is in 95 of 100 fits by the right model; `None` without a stated noise.
    pub fn is_in_band(&self) -> Option<bool> {
        let (chi2, distribution) = self.chi2.as_ref()?;
        Some((0.025..=0.975).contains(&distribution.cdf(*chi2)))
    }

    /// Whether noise alone leaves so much in less than one fit of ten thousand.
    pub fn is_stuck(&self) -> bool {
        self.chi2.as_ref().is_some_and(|(chi2, distribution)| distribution.sf(*chi2) < 1e-4)
    }
}
