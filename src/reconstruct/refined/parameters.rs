//! The effects' parameters as they are reported.

use super::acting::Acting;
use super::fitted::Fitted;
use super::uncertainty::Deviations;
use crate::Scene;
use crate::bridge::refined::ffi::ParameterRule;
use crate::effect::{Parameter, catalogue};
use crate::reconstruct::active_effect::{GIVEN, NO_DATA, scalar_names};
use crate::reconstruct::{ActiveEffect, Number, ParameterEstimate};

const SCANNED: &str = "it is one of the annotated poses";
const AT_BOUND: &str = "it ends at its bound";

/// All effects of a fitted model.
pub(super) fn effects(
    scene: &Scene,
    fitted: &Fitted,
    deviations: &Deviations,
) -> Vec<ActiveEffect> {
    fitted.acting.iter().map(|acting| effect(scene, fitted, acting, deviations)).collect()
}

/// The names of all effects' scalars, as [`Reconstruction::uncertainty`] has them.
///
/// [`Reconstruction::uncertainty`]: crate::Reconstruction::uncertainty
pub(super) fn parameter_names(fitted: &Fitted) -> Vec<String> {
    let effects = fitted.acting.iter().map(|acting| &acting.instance.effect).enumerate();
    let parameters = effects.flat_map(|(index, effect)| {
        effect.parameters.iter().map(move |parameter| (index, parameter))
    });
    parameters
        .flat_map(|(index, parameter)| scalar_names(index, &parameter.name, parameter.null.len()))
        .collect()
}

fn effect(
    scene: &Scene,
    fitted: &Fitted,
    acting: &Acting,
    deviations: &Deviations,
) -> ActiveEffect {
    let instance = &acting.instance;
    let mut place = acting.first;
    let mut column = fitted.columns(acting).start;
    let mut parameters = std::collections::BTreeMap::new();
    for parameter in &instance.effect.parameters {
        let rules = &fitted.refined.parameters[place..place + parameter.null.len()];
        let values = &fitted.best().solution.unknowns.parameters[place..place + rules.len()];
        let is_given = instance.fixed.contains_key(&parameter.name);
        let estimate = estimate(parameter, rules, values, is_given, column, deviations);
        parameters.insert(parameter.name.clone(), estimate);
        place += rules.len();
        column += rules.iter().filter(|rule| !rule.held).count();
    }
    ActiveEffect {
        name: instance.effect.name.clone(),
        body: instance.body.map(|body| scene.bodies()[body].name.clone()),
        parameters,
        definition: (!catalogue().contains(&instance.effect)).then(|| instance.effect.clone()),
    }
}

fn estimate(
    parameter: &Parameter,
    rules: &[ParameterRule],
    values: &[f64],
    is_given: bool,
    column: usize,
    deviations: &Deviations,
) -> ParameterEstimate {
    let at_bound = |(rule, value): (&ParameterRule, &f64)| {
        let margin = 1e-9 * (rule.high - rule.low).min(parameter.scale);
        value - rule.low <= margin || rule.high - value <= margin
    };
    let stds = || -> Option<Vec<f64>> {
        (0..rules.len()).map(|index| deviations.of_unknown(column + index)).collect()
    };
    let (std, reason) = match () {
        () if is_given => (None, Some(GIVEN)),
        () if rules[0].held => (None, Some(SCANNED)),
        () if rules.iter().zip(values).any(at_bound) => (None, Some(AT_BOUND)),
        () => match stds() {
            None => (None, Some(NO_DATA)),
            Some(stds) => (Some(Number::from(stds)), None),
        },
    };
    ParameterEstimate {
        value: Some(Number::from(values.to_vec())),
        std,
        unit: parameter.unit.to_string(),
        reason: reason.map(String::from),
    }
}
