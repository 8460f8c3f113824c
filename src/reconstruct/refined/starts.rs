//! Where a model with one effect more starts: at the optimum without it, and at what a scan of
//! those parameters finds that the null hides.

use nalgebra::Vector3;

use super::acting::{Acting, Instance};
use super::fitted::Fitted;
use super::freed::freed;
use super::gain::{gains, gains_without, linearised};
use super::model::has_plane;
use super::optimum::{HOPELESS, Optimum, optima_from};
use super::solved_anew::{delayed, without_a_pose};
use crate::bridge::refined::ffi::{RefinedScene, RefinedUnknowns};
use crate::effect::{Scan, Scope};
use crate::scene::{Gap, StaticPlane};
use crate::{Result, Scene};

/// Optima of the nested model that are tried.
const MOST_OPTIMA: usize = 3;
/// Costs that differ by less, of their size, are of one optimum.
const SAME: f64 = 1e-5;
/// Points of a scan that are tried.
pub(super) const MOST_POINTS: usize = 3;
/// Points of a scan that are held for a while, and then the best of them tried.
const MOST_HELD: usize = 8;
/// Gaps that a scan looks into.
const MOST_GAPS: usize = 16;
/// Delays of a time scan, in frames.
const FRAMES: [f64; 10] = [-3.0, -2.0, -1.5, -1.0, -0.5, 0.5, 1.0, 1.5, 2.0, 3.0];

/// Unknowns, and the segment that the collision time starts in.
pub(super) type Start = (RefinedUnknowns, Gap);

/// The starts of `nested` with `acting` added, which `refined` holds already.
pub(super) fn starts(
    nested: &Fitted,
    scene: &Scene,
    refined: &RefinedScene,
    acting: &Acting,
) -> Result<Vec<Start>> {
    let null = acting.instance.null();
    let least = nested.best().solution.cost;
    let mut optima: Vec<&Optimum> = nested.optima.iter().collect();
    optima.retain(|optimum| optimum.solution.cost <= least + HOPELESS);
    // Starts that led to the same.
    optima.dedup_by(|a, b| a.solution.cost - b.solution.cost < SAME * (1.0 + least));
    let mut starts: Vec<Start> = optima
        .into_iter()
        .take(MOST_OPTIMA)
        .map(|optimum| (extended(&optimum.solution.unknowns, &null), optimum.gap))
        .collect();
    if let Some(plane) = scene.plane() {
        starts.iter_mut().for_each(|(unknowns, _)| touch(unknowns, plane));
    }
    match acting.instance.scan() {
        None => {
            starts.extend(beside_the_null(refined, acting, &starts[0])?);
            if acting.instance.effect.scope == Scope::Contact && is_bent(nested, scene) {
                starts.extend(freed(nested, scene, refined, acting).unwrap_or_default());
            }
        }
        Some((Scan::Frames, place)) => starts.extend(delayed(nested, scene, acting, place)),
        Some((scan, place)) => {
            let mut scanned = scanned(nested, scene, &acting.instance)?;
            scanned.sort_by(|a, b| b.gain.total_cmp(&a.gain));
            let (unknowns, gap) = starts[0].clone();
            starts.truncate(1);
            let at = |scanned: &Scanned| {
                let mut start = unknowns.clone();
                start.parameters[acting.first + place] = scanned.point;
                (start, gap)
            };
            if scan == Scan::ObservationTimes {
                starts.extend(scanned.iter().take(MOST_POINTS).map(at));
                starts.extend(without_a_pose(nested, scene, acting, place));
            } else {
                let likely: Vec<Start> = scanned.iter().take(MOST_HELD).map(at).collect();
                starts.extend(held(refined, acting.first + place, &likely));
            }
        }
    }
    Ok(starts)
}

/// The optima with parameter `index` held where each of `likely` has it, the best first: free from the
/// beginning, a moment runs off to another gap before the event there has grown.
fn held(refined: &RefinedScene, index: usize, likely: &[Start]) -> Vec<Start> {
    let mut still = refined.clone();
    still.parameters[index].held = true;
    let optima =
        likely.iter().filter_map(|start| optima_from(&still, std::slice::from_ref(start)).ok());
    let mut optima: Vec<Optimum> = optima.filter_map(|optima| optima.into_iter().next()).collect();
    optima.sort_by(|a, b| a.solution.cost.total_cmp(&b.solution.cost));
    let best = optima.into_iter().take(MOST_POINTS);
    best.map(|optimum| (optimum.solution.unknowns, optimum.gap)).collect()
}

/// Whether a fit may be bent so far that it is stuck: on a plane, where a body that rubs turns; between
/// two bodies, where it misses the poses by more than noise would in one scene of two hundred.
fn is_bent(nested: &Fitted, scene: &Scene) -> bool {
    const IMPROBABLE: f64 = 3.0;
    let spare = (nested.numbers() - nested.used()).max(1.0);
    let misses = nested.chi2() > spare + IMPROBABLE * (2.0 * spare).sqrt();
    scene.plane().is_some() || !nested.has_stated_noise() || misses
}

/// A value of a scanned parameter.
pub(crate) struct Scanned {
    pub(crate) point: f64,
    /// By how much χ² would fall with it.
    pub(crate) gain: f64,
}

/// How much χ² would fall by an instance at each point of its scan.
pub(crate) fn scanned(nested: &Fitted, scene: &Scene, instance: &Instance) -> Result<Vec<Scanned>> {
    let points = points(scene, instance);
    let gains = match instance.scan() {
        // What changes a single pose at will takes it out of the fit.
        Some((Scan::ObservationTimes, _)) => {
            let left_out = gains_without(nested)?;
            let of = |time_s: &f64| {
                let bodies = instance.bodies(&nested.refined).into_iter();
                let poses = bodies.flat_map(|body| left_out[body].iter());
                poses.filter(|(stamp_s, _)| stamp_s == time_s).map(|(_, gain)| gain).sum()
            };
            points.iter().map(of).collect()
        }
        Some((Scan::GapTimes, place)) => {
            let at = |point: &f64| {
                let mut values = instance.null();
                values[place] = *point;
                (instance.clone(), values)
            };
            let gains = gains(nested, &points.iter().map(at).collect::<Vec<_>>())?;
            gains.into_iter().map(|gain| gain.chi2).collect()
        }
        Some((Scan::Frames, _)) | None => Vec::new(),
    };
    Ok(points.into_iter().zip(gains).map(|(point, gain)| Scanned { point, gain }).collect())
}

/// The values of the scanned parameter that make a difference.
pub(crate) fn points(scene: &Scene, instance: &Instance) -> Vec<f64> {
    let Some((scan, _)) = instance.scan() else { return Vec::new() };
    let bodies = scene.bodies().iter().enumerate();
    let stamps = bodies
        .filter(|(index, _)| instance.body.is_none_or(|body| body == *index))
        .flat_map(|(_, body)| &body.observations)
        .map(|seen| seen.time_s);
    let mut times: Vec<f64> = stamps.collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    match scan {
        Scan::ObservationTimes => times,
        // Before the second pose and after the last but one, the event and the pose are one.
        // The time itself is free: it moves on to the next gap.
        Scan::GapTimes => {
            let step = (times.len() - 1).div_ceil(MOST_GAPS).max(1);
            let gaps = times.windows(2).skip(step / 2).step_by(step);
            gaps.map(|pair| 0.5 * (pair[0] + pair[1])).collect()
        }
        Scan::Frames => FRAMES.iter().map(|frames| frames * frame_s(scene, &times)).collect(),
    }
}

/// Puts the contact point on the plane: along the base model's impulse it makes no difference where
/// it is, but to friction it does.
pub(super) fn touch(unknowns: &mut RefinedUnknowns, plane: &StaticPlane) {
    let normal = plane.normal_in_world.into_inner();
    let point = Vector3::from(unknowns.contact_point);
    unknowns.contact_point = (point + (plane.height_m - normal.dot(&point)) * normal).into();
}

fn frame_s(scene: &Scene, times: &[f64]) -> f64 {
    let shortest = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    scene.fps().map_or(shortest, |fps| 1.0 / fps)
}

pub(super) fn extended(unknowns: &RefinedUnknowns, null: &[f64]) -> RefinedUnknowns {
    let mut extended = unknowns.clone();
    extended.parameters.extend(null);
    extended
}

/// Where nothing depends on a parameter at the null, a start with all of them a typical size away.
/// A further impulse at the contact may be hidden in a wrong contact point: starts with the impulse
/// a typical size away, and with the contact point where the normal through the centre leads.
fn beside_the_null(
    refined: &RefinedScene,
    acting: &Acting,
    (unknowns, gap): &Start,
) -> Result<Vec<Start>> {
    let strikes = acting.instance.acts_at_the_contact();
    // One parameter alone has its slope; a product of two has none where both are zero.
    let is_product = acting.instance.effect.parameters.len() > 1;
    if !(strikes || is_product && is_flat(refined, acting, unknowns, *gap)?) {
        return Ok(Vec::new());
    }
    let away = away(refined, acting, unknowns, 1.0);
    let mut starts = vec![(away.clone(), *gap)];
    if strikes && has_plane(refined) {
        let mut central = away;
        let normal = Vector3::from(refined.plane_normal);
        let aside =
            Vector3::from(central.contact_point) - Vector3::from(central.bodies[0].position);
        let foot = Vector3::from(central.bodies[0].position) + normal * normal.dot(&aside);
        central.contact_point = foot.into();
        starts.push((central, *gap));
    }
    Ok(starts)
}

/// Whether nothing depends on one of the free parameters.
pub(super) fn is_flat(
    refined: &RefinedScene,
    acting: &Acting,
    unknowns: &RefinedUnknowns,
    gap: Gap,
) -> Result<bool> {
    let tangent = linearised(refined, unknowns, gap)?;
    let free = refined.parameters[acting.first..].iter().filter(|rule| !rule.held).count();
    let columns = tangent.jacobian.columns(tangent.jacobian.ncols() - free, free);
    Ok(columns.column_iter().any(|column| column.norm() == 0.0))
}

/// With the free parameters so many typical sizes from where they are.
pub(super) fn away(
    refined: &RefinedScene,
    acting: &Acting,
    unknowns: &RefinedUnknowns,
    size: f64,
) -> RefinedUnknowns {
    let parameters = acting.instance.effect.parameters.iter();
    let scales = parameters.flat_map(|p| p.null.iter().map(move |_| size * p.scale));
    let mut away = unknowns.clone();
    for (index, scale) in scales.enumerate() {
        let rule = &refined.parameters[acting.first + index];
        let value = &mut away.parameters[acting.first + index];
        if !rule.held {
            *value = if *value + scale <= rule.high { *value + scale } else { *value - scale };
            *value = value.clamp(rule.low, rule.high);
        }
    }
    away
}
