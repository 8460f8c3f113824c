//! The way to known values of parameters that are far from the null: where flights of the model without
//! them run off with them, as drag does when it is flown backwards from too fast a contact.

use super::acting::Acting;
use super::optimum::{Optimum, optima_from};
use super::starts::Start;
use crate::Result;
use crate::bridge::refined::ffi::{RefinedScene, RefinedUnknowns};

/// Of the way; shorter steps lead nowhere.
const SHORTEST: f64 = 1.0 / 64.0;

/// The optima with the values that `acting` is held at, from `start` step by step.
///
/// # Errors
/// Not even short steps lead there.
pub(super) fn approached(
    refined: &RefinedScene,
    acting: &Acting,
    (unknowns, gap): &Start,
) -> Result<Vec<Optimum>> {
    let held = acting.instance.null();
    let null = acting.instance.effect.parameters.iter().flat_map(|parameter| &parameter.null);
    let ways: Vec<(f64, f64)> = null.copied().zip(held).collect();
    let at = |unknowns: &RefinedUnknowns, share: f64| {
        let mut start = unknowns.clone();
        let place = acting.first..acting.first + acting.count;
        let own = start.parameters[place.clone()].iter_mut().zip(&refined.parameters[place]);
        for ((value, rule), (from, to)) in own.zip(&ways) {
            if rule.held {
                *value = from + share * (to - from);
            }
        }
        start
    };
    let (mut unknowns, mut gap) = (unknowns.clone(), *gap);
    let (mut reached, mut step) = (0.0, 0.5);
    loop {
        let next = f64::min(reached + step, 1.0);
        match optima_from(refined, &[(at(&unknowns, next), gap)]) {
            Ok(optima) if next == 1.0 => return Ok(optima),
            Ok(optima) => {
                (unknowns, gap) = (optima[0].solution.unknowns.clone(), optima[0].gap);
                reached = next;
                step *= 2.0;
            }
            Err(error) if step < SHORTEST => return Err(error),
            Err(_) => step *= 0.5,
        }
    }
}
