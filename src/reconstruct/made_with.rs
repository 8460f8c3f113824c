//! With which options a result was made.

use super::active_effect::GIVEN;
use super::{Intervals, Number, Options, PaperOptions, Preset, Reconstruction, RefinedOptions};
use crate::Result;
use crate::effect::EffectRequest;

impl Reconstruction {
    /// The options that lead to it again. Results of older versions don't state them: there it is what
    /// the other fields tell, and that is all but the tilt and the loss.
    ///
    /// # Errors
    /// An older result has an effect that the catalogue hasn't.
    pub fn made_with(&self) -> Result<Options> {
        if let Some(options) = &self.options {
            return Ok(options.clone());
        }
        if self.preset == Preset::Paper {
            return Ok(Options::Paper(PaperOptions { segment_by: self.segment_by, seed: 0 }));
        }
        let effects = self.effects.iter().map(|active| {
            let given = active.parameters.iter().filter_map(|(name, parameter)| {
                let is_given = parameter.reason.as_deref() == Some(GIVEN);
                let value =
                    parameter.value.as_ref().filter(|_| is_given).map(Number::components)?;
                Some((name.clone(), value.to_vec()))
            });
            Ok(EffectRequest {
                effect: active.effect()?.clone(),
                body: active.body.clone(),
                fixed: given.collect(),
            })
        });
        Ok(Options::Refined(RefinedOptions {
            intervals: self.intervals.unwrap_or(Intervals::Covariance),
            effects: effects.collect::<Result<_>>()?,
            ..RefinedOptions::default()
        }))
    }
}
