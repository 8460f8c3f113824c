//! What several throws of the same objects say of their restitution and mass ratio together: the mean,
//! weighted by the inverse variances, and whether they agree on it by χ². Where they scatter more than
//! their own deviations say, that of the mean grows by Birge's ratio.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::pooled::Throw;
use super::{FALSE_ALARM, reported};
use crate::Result;
use crate::reconstruct::{Estimate, Reconstruction};
use crate::words::significant;

/// A quantity that all throws have, put together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Together {
    /// `restitution` or `mass_ratio`.
    pub quantity: String,
    /// Of all throws that tell it.
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
    type Pick = fn(&Reconstruction) -> Option<&Estimate>;
    let quantities: [(&str, Pick); 2] = [
        ("restitution", |result| Some(&result.restitution)),
        ("mass_ratio", |result| result.mass_ratio.as_ref()),
    ];
    let results: Vec<Reconstruction> =
        throws.iter().map(|throw| reported(throw.scene, &throw.fitted)).collect::<Result<_>>()?;
    let of = |(quantity, pick): (&str, Pick)| {
        let each = throws.iter().zip(&results).filter_map(|(throw, result)| {
            let estimate = pick(result)?;
            let (value, std) = (estimate.value?, estimate.std.filter(|std| *std > 0.0)?);
            Some(ThrowValue { scene: throw.scene.name().to_string(), value, std })
        });
        mean(quantity, each.collect())
    };
    Ok(quantities.into_iter().filter_map(of).collect())
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

impl Together {
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

    #[test]
    fn throws_that_differ_are_told_of() {
        let all = mean("mass_ratio", each(&[1.0, 2.0], 0.01)).unwrap();
        assert!(all.p_value < 1e-9 && all.scatter > 50.0, "{all:?}");
        assert!(all.in_words().contains("scatter"));
        assert!(mean("restitution", each(&[0.7], 0.01)).is_none());
    }
}
