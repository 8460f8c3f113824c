//! What several throws of the same objects say of their restitution and mass ratio together: the mean,
//! weighted by the inverse variances (of the mass ratio's logarithm), and whether they agree on it by χ². Where they scatter more than
//! their own deviations say, that of the mean grows by Birge's ratio.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::pooled::Throw;
use super::{FALSE_ALARM, reported};
use crate::Result;
use crate::reconstruct::Estimate;
use crate::words::significant;

/// A quantity that all throws have, put together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Together {
    /// `restitution` or `mass_ratio`.
    pub quantity: String,
    /// Of all throws that tell it; a mass ratio in the order of the first scene's bodies.
    pub value: f64,
    /// One standard deviation, with the scatter.
    pub std: f64,
    /// How often throws that have the same scatter as much.
    pub p_value: f64,
    /// By how much they scatter more than their own deviations say, at least 1.
    pub scatter: f64,
    /// Each throw's own.
    pub each: Vec<ThrowValue>,
}

/// What one throw says.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ThrowValue {
    /// The scene's name.
    pub scene: String,
    /// The estimate.
    pub value: f64,
    /// One standard deviation.
    pub std: f64,
}

/// The restitution and the mass ratio of `throws`, as far as two of them tell it.
pub(crate) fn together(throws: &[Throw]) -> Result<Vec<Together>> {
    let (mut restitutions, mut mass_ratios) = (Vec::new(), Vec::new());
    for throw in throws {
        let result = reported(throw.scene, &throw.fitted)?;
        restitutions.extend(known(throw, &result.restitution));
        let ratio = result.mass_ratio.as_ref().and_then(|ratio| known(throw, ratio));
        // In the order of the first scene's bodies.
        let is_turned = throw.scene.bodies()[0].name != throws[0].scene.bodies()[0].name;
        mass_ratios.extend(ratio.filter(|ratio| ratio.value > 0.0).map(|ratio| match is_turned {
            true => ThrowValue {
                value: ratio.value.recip(),
                std: ratio.std * ratio.value.powi(-2),
                ..ratio
            },
            false => ratio,
        }));
    }
    let all = [mean("restitution", restitutions), geometric_mean("mass_ratio", mass_ratios)];
    Ok(all.into_iter().flatten().collect())
}

fn known(throw: &Throw, estimate: &Estimate) -> Option<ThrowValue> {
    let std = estimate.std.filter(|std| *std > 0.0)?;
    Some(ThrowValue { scene: throw.scene.name().to_string(), value: estimate.value?, std })
}

fn mean(quantity: &str, each: Vec<ThrowValue>) -> Option<Together> {
    let weight = |one: &ThrowValue| one.std.powi(-2);
    let weights: f64 = each.iter().map(weight).sum();
    let value = each.iter().map(|one| weight(one) * one.value).sum::<f64>() / weights;
    let squares: f64 = each.iter().map(|one| weight(one) * (one.value - value).powi(2)).sum();
    let spread = each.len().checked_sub(1).filter(|spread| *spread > 0)? as f64;
    let scatter = (squares / spread).max(1.0).sqrt();
    Some(Together {
        quantity: quantity.to_string(),
        value,
        std: scatter / weights.sqrt(),
        p_value: ChiSquared::new(spread).map_or(1.0, |chi| chi.sf(squares)),
        scatter,
        each,
    })
}

/// Of what is as sure as it is large: of the logarithms.
fn geometric_mean(quantity: &str, each: Vec<ThrowValue>) -> Option<Together> {
    let logarithm = |one: &ThrowValue| ThrowValue {
        scene: one.scene.clone(),
        value: one.value.ln(),
        std: one.std / one.value,
    };
    let of_logarithms = mean(quantity, each.iter().map(logarithm).collect())?;
    let value = of_logarithms.value.exp();
    Some(Together { value, std: value * of_logarithms.std, each, ..of_logarithms })
}

impl Together {
    /// What is to be said where the model leaves more than noise.
    pub const OF_A_POOR_MODEL: &str =
        "The model misses the poses by more than noise, which these errors don't count.";

    /// In a sentence.
    pub fn in_words(&self) -> String {
        let agree = match self.p_value < FALSE_ALARM {
            false => "the throws agree on it.".to_string(),
            true => format!(
                "but they scatter {} times more than their own errors say: it may not be the same \
                 in all.",
                significant(self.scatter, 2)
            ),
        };
        let decimals = (1.0 - self.std.log10().floor()).clamp(0.0, 9.0) as usize;
        format!(
            "The {} of {} throws together is {:.decimals$} ± {}; {agree}",
            self.quantity.replace('_', " "),
            self.each.len(),
            self.value,
            significant(self.std, 2)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn each(values: &[f64], std: f64) -> Vec<ThrowValue> {
        let one = |value: &f64| ThrowValue { scene: "throw".into(), value: *value, std };
        values.iter().map(one).collect()
    }

    #[test]
    fn throws_that_agree_are_surer_together() {
        let all = mean("restitution", each(&[0.69, 0.70, 0.71, 0.70], 0.01)).unwrap();
        assert!((all.value - 0.70).abs() < 1e-12 && (all.std - 0.005).abs() < 1e-12, "{all:?}");
        assert!(all.p_value > 0.01 && all.scatter == 1.0);
        assert!(all.in_words().contains("0.7000 ± 0.0050; the throws agree"));
    }

    /// Half and twice are equally far from 1.
    #[test]
    fn ratios_are_averaged_by_their_logarithms() {
        let throw = |value: f64| ThrowValue { scene: "throw".into(), value, std: 0.1 * value };
        let all = geometric_mean("mass_ratio", vec![throw(1.0), throw(2.0)]).unwrap();
        assert!((all.value - f64::sqrt(2.0)).abs() < 1e-12, "{all:?}");
    }

    #[test]
    fn throws_that_differ_are_told_of() {
        let all = mean("mass_ratio", each(&[1.0, 2.0], 0.01)).unwrap();
        assert!(all.p_value < 1e-9 && all.scatter > 50.0, "{all:?}");
        assert!(all.in_words().contains("scatter"));
        assert!(mean("restitution", each(&[0.7], 0.01)).is_none());
    }
}
