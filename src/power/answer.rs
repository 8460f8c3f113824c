//! The questions that are asked about one direction of an effect, and their answers.

use rayon::prelude::*;

use super::axis::Axis;
use super::chance::{Chance, candidates, sought};
use super::film::{Film, Shown};
use super::least::least_size;
use super::report::{Alike, AxisPower, Bias, Changed};
use super::tail::noncentrality;
use crate::Result;
use crate::diagnose::{look_alikes, reported, tried};
use crate::reconstruct::Estimate;

/// Of the intervals between frames.
const FRAMES: [f64; 3] = [0.5, 2.0, 4.0];
/// Of the noise.
const NOISE: [f64; 3] = [2.0, 0.5, 0.25];
/// Films in which an effect is to be found.
const EVERY_SECOND: f64 = 0.5;
const NINE_OF_TEN: f64 = 0.9;
/// The least sizes, what is alike, and each film that differs.
pub(super) const QUESTIONS: usize = 2 + FRAMES.len() + NOISE.len();

/// All about `axis`, along which the effect has this `chance` at its size; `done` is told of each
/// question.
pub(super) fn answer(
    film: &Film,
    axis: &Axis,
    chance: &Chance,
    done: &(impl Fn() + Sync),
) -> Result<AxisPower> {
    let ask = |(factor, film): (f64, Result<Film>)| {
        let changed = changed(factor, film, axis);
        done();
        changed
    };
    let frames = FRAMES.par_iter().map(|&factor| (factor, film.with_frames(factor)));
    let noise = NOISE.par_iter().map(|&factor| (factor, Ok(film.with_noise(factor))));
    let (frames, noise) = (frames.map(ask).collect(), noise.map(ask).collect());
    let [least_size_50, least_size_90] = least_sizes(film, axis, chance);
    done();
    let alike = alike(film, axis, least_size_90.map_or(axis.size, |least| least.max(axis.size)))?;
    done();
    Ok(AxisPower {
        parameter: axis.parameter.name.clone(),
        unit: axis.parameter.unit.to_string(),
        null: axis.parameter.null.clone().into(),
        direction: axis.direction.clone().into(),
        least_size_50,
        least_size_90,
        size: axis.size,
        power: chance.power(),
        chi2: chance.lambda,
        critical_chi2: chance.critical,
        parameters: chance.parameters,
        frames,
        noise,
        bias: bias(&film.shown(&axis.effect(axis.size))?)?,
        alike,
    })
}

/// The least sizes that are found in every second film, and in nine of ten.
fn least_sizes(film: &Film, axis: &Axis, chance: &Chance) -> [Option<f64>; 2] {
    let lambda = |size: f64| Ok(film.shown(&axis.effect(size))?.fitted.chi2());
    let mut near = axis.size;
    [EVERY_SECOND, NINE_OF_TEN].map(|power| {
        let target = noncentrality(chance.critical, chance.parameters, power);
        let least = least_size(target, near, axis.longest, lambda);
        near = least.unwrap_or(near);
        least
    })
}

fn changed(factor: f64, film: Result<Film>, axis: &Axis) -> Changed {
    match film.and_then(|film| Chance::of(&film, &axis.effect(axis.size))) {
        Ok(chance) => Changed {
            factor,
            poses: Some(chance.poses),
            chi2: Some(chance.lambda),
            power: Some(chance.power()),
            reason: None,
        },
        Err(error) => Changed {
            factor,
            poses: None,
            chi2: None,
            power: None,
            reason: Some(error.problem().to_string()),
        },
    }
}

/// What the model that lacks the effect makes of the collision.
fn bias(shown: &Shown) -> Result<Vec<Bias>> {
    let result = reported(&shown.scene, &shown.fitted)?;
    let bias = |quantity: &str, truth: Option<f64>, found: Option<&Estimate>| {
        let (truth, estimate) = (truth?, found?);
        let found = estimate.value?;
        let in_sigma = estimate.std.filter(|std| *std > 0.0).map(|std| (found - truth) / std);
        Some(Bias { quantity: quantity.to_string(), truth, found, in_sigma })
    };
    let all = [
        bias("mass_ratio", shown.truth.mass_ratio, result.mass_ratio.as_ref()),
        bias("restitution", Some(shown.truth.restitution), Some(&result.restitution)),
    ];
    Ok(all.into_iter().flatten().collect())
}

/// What a diagnosis couldn't tell from the effect at `size`.
fn alike(film: &Film, axis: &Axis, size: f64) -> Result<Option<Alike>> {
    let effect = axis.effect(size);
    let shown = film.shown(&effect)?;
    let instance = sought(&shown.scene, &effect)?;
    let found = tried(&shown.scene, &shown.fitted, &candidates(&shown, &effect)?).candidates;
    let is_own = |place: &usize| {
        let other = found[*place].instance();
        other.effect.name == instance.effect.name && other.body == instance.body
    };
    let own = (0..found.len()).find(is_own).filter(|place| found[*place].stands_out());
    Ok(own.map(|own| Alike {
        size,
        effects: look_alikes(&found, own, 1.0)
            .into_iter()
            .map(|other| found[other].instance().label(&shown.scene))
            .collect(),
    }))
}
