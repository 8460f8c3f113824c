//! Whether a tracked point goes round or to and fro beside the path: one that isn't the body's centre
//! does, on a body that turns while its orientation isn't seen. It is told only beside a force that
//! changes slowly: what bends is no swing.

use std::f64::consts::TAU;

use nalgebra::Vector3;

use super::FALSE_ALARM;
use super::evidence::by_chance;
use super::forms::{Parameter, free, free_beside};
use super::unexplained::{Form, Kind, Unexplained};
use crate::reconstruct::refined::{Fitted, Gain, Instance, gains, possible};
use crate::words::significant;
use crate::{Result, Scene};

/// Degree in time of the force, on either side of the collision, that a swing must show beside.
const SLOW: usize = 1;
/// Fewer poses in a flight show no swing.
const LEAST_POSES: usize = 12;
/// Half cycles in a flight: fewer are a bend.
const LEAST_HALF_CYCLES: usize = 3;
const MOST_HALF_CYCLES: usize = 24;
/// Rates between two of those are tried once the best is known.
const FINER: i32 = 8;
/// A half cycle shows in so many poses at least.
const POSES_OF_A_HALF_CYCLE: usize = 3;

/// A side of the collision: its law's factor, words, and when poses were seen.
struct Side {
    step: &'static str,
    words: &'static str,
    times_s: Vec<f64>,
}

/// The clearest swing of each body whose orientation isn't seen, beside the model of `fitted`; only
/// what noise alone wouldn't show.
pub(super) fn swings(scene: &Scene, fitted: &Fitted) -> Result<Vec<Unexplained>> {
    let mut found = Vec::new();
    for body in (0..scene.bodies().len()).filter(|body| !fitted.refined.bodies[*body].has_spin) {
        let mut clearest: Option<Unexplained> = None;
        for side in sides(fitted, body) {
            let swing = swing(scene, fitted, body, &side)?;
            let gain = |known: &Option<Unexplained>| known.as_ref().map_or(0.0, |k| k.delta_chi2);
            if gain(&swing) > gain(&clearest) {
                clearest = swing;
            }
        }
        found.extend(clearest);
    }
    Ok(found)
}

fn sides(fitted: &Fitted, body: usize) -> [Side; 2] {
    let times_s = fitted.refined.bodies[body].poses.iter().map(|pose| pose.time_s);
    let collision_time_s = fitted.collision_time_s();
    let (before, after): (Vec<f64>, Vec<f64>) = times_s.partition(|time| *time < collision_time_s);
    [
        Side { step: "step(t_c - t)", words: "before", times_s: before },
        Side { step: "step(t - t_c)", words: "after", times_s: after },
    ]
}

/// The clearest swing on one side: a peak among the rates.
fn swing(scene: &Scene, fitted: &Fitted, body: usize, side: &Side) -> Result<Option<Unexplained>> {
    let poses = side.times_s.len();
    let most = MOST_HALF_CYCLES.min(poses / POSES_OF_A_HALF_CYCLE);
    if poses < LEAST_POSES || most < LEAST_HALF_CYCLES {
        return Ok(None);
    }
    let law = law(side);
    let effect = free_beside(SLOW, ("position", &law), &unknowns());
    let Some(instance) = possible(scene, &effect).into_iter().find(|one| one.body == Some(body))
    else {
        return Ok(None);
    };
    let duration_s = side.times_s[poses - 1] - side.times_s[0];
    let rate = |half_cycles: f64| 0.5 * TAU * half_cycles / duration_s;
    let tried: Vec<f64> = (LEAST_HALF_CYCLES..=most).map(|n| rate(n as f64)).collect();
    let coarse = gains_at(fitted, &instance, &tried)?;
    let place = best(&coarse);
    // What gains most at the slowest is no swing but a bend.
    if place == 0 {
        return Ok(None);
    }
    let slow = slow(scene, fitted, body)?;
    let beside = |gain: &Gain| Gain {
        chi2: gain.chi2 - slow.chi2,
        directions: gain.directions.saturating_sub(slow.directions).max(1),
        step: gain.step[slow.step.len()..].to_vec(),
    };
    let swing = beside(&coarse[place]);
    let chance = (2 * scene.bodies().len() * tried.len()) as f64 * by_chance(fitted, &swing);
    if chance >= FALSE_ALARM {
        return Ok(None);
    }
    let near: Vec<f64> =
        (-FINER..=FINER).map(|n| tried[place] + rate(n as f64 / FINER as f64)).collect();
    let fine = gains_at(fitted, &instance, &near)?;
    let place = best(&fine);
    let swing = described(scene, fitted, body, side, &law, near[place], &beside(&fine[place]));
    // A point of the body is within it.
    let reach_m = 0.5 * Vector3::from(scene.bodies()[body].shape.edges_m()).norm();
    Ok(Some(swing).filter(|swing| swing.rms < reach_m))
}

/// What a force that changes slowly gains by itself.
fn slow(scene: &Scene, fitted: &Fitted, body: usize) -> Result<Gain> {
    let force = possible(scene, &free(Kind::Acceleration, SLOW)).into_iter();
    let tests: Vec<(Instance, Vec<f64>)> =
        force.filter(|one| one.body == Some(body)).map(|one| (one.clone(), one.null())).collect();
    Ok(gains(fitted, &tests)?.remove(0))
}

fn unknowns() -> Vec<Parameter> {
    [("cosine", "m", 3), ("rate", "rad/s", 1), ("sine", "m", 3)]
        .map(|(name, unit, count)| (name.to_string(), unit.to_string(), count))
        .into()
}

fn best(gains: &[Gain]) -> usize {
    let places = 0..gains.len();
    places.max_by(|a, b| gains[*a].chi2.total_cmp(&gains[*b].chi2)).unwrap_or(0)
}

/// The gains by `instance` at each of these rates.
fn gains_at(fitted: &Fitted, instance: &Instance, rates_rad_s: &[f64]) -> Result<Vec<Gain>> {
    let at = |rate_rad_s: &f64| {
        let mut instance = instance.clone();
        instance.fixed.insert("rate".into(), vec![*rate_rad_s]);
        let null = instance.null();
        (instance, null)
    };
    gains(fitted, &rates_rad_s.iter().map(at).collect::<Vec<_>>())
}

/// Where the point is seen, on one side; it doesn't jump at the collision.
fn law(side: &Side) -> String {
    let swing = "(cosine * (cos(rate * (t - t_c)) - 1) + sine * sin(rate * (t - t_c)))";
    format!("p + {} * {swing}", side.step)
}

fn described(
    scene: &Scene,
    fitted: &Fitted,
    body: usize,
    side: &Side,
    law: &str,
    rate_rad_s: f64,
    gain: &Gain,
) -> Unexplained {
    let [cosine, sine] = [0, 3].map(|first| Vector3::from_row_slice(&gain.step[first..first + 3]));
    let swing = |time_s: &f64| {
        let angle = rate_rad_s * (time_s - fitted.collision_time_s());
        cosine * (angle.cos() - 1.0) + sine * angle.sin()
    };
    let swings: Vec<Vector3<f64>> = side.times_s.iter().map(swing).collect();
    let count = swings.len() as f64;
    let mean = swings.iter().sum::<Vector3<f64>>() / count;
    let squares: f64 = swings.iter().map(|swing| (swing - mean).norm_squared()).sum();
    let times = significant(rate_rad_s / TAU, 2);
    Unexplained {
        body: scene.bodies()[body].name.clone(),
        kind: Kind::Position,
        delta_chi2: gain.chi2,
        rms: (squares / count).sqrt(),
        mean: mean.into(),
        forms: vec![Form {
            goes_with: format!("a swing, {times} times a second {} the collision", side.words),
            law: format!("position = \"{law}\""),
            share: 1.0,
            factor: rate_rad_s,
        }],
    }
}
