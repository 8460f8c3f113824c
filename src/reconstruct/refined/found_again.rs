//! A start for an effect in flight where the fit with it has lost its way: the model without it was bent so
//! far that rotations wrapped. Free of the contact, each flight finds its own spin and all of them the
//! effect; then comes the contact that makes the same jump.

use nalgebra::Vector3;

use super::acting::{Acting, possible};
use super::bends::Bends;
use super::fitted::Fitted;
use super::freed::{free_jump, leaving, same_jump};
use super::optimum::{Optimum, gaps, nearest, optima_from};
use super::parabolas::Paths;
use super::start::{Leaving, freed_candidates};
use super::starts::{Start, away, is_flat};
use crate::bridge::refined::ffi::{RefinedPose, RefinedScene, RefinedUnknowns, launch};
use crate::reconstruct::solver_error;
use crate::{Result, Scene};

/// Segments, and pairs of flights in each, that are tried.
const MOST_SEGMENTS: usize = 2;
const MOST_TURNS: usize = 2;
/// A flight shows roughly how it goes in no more poses than these.
const ENOUGH: usize = 16;
/// So many of a body's poses show where its flights meet.
const MOST_POSES: usize = 128;
/// How many times less sure positions are at first: they are off by metres, and would drag the spins after
/// them.
const LOOSER: f64 = 10.0;

/// A model that is found roughly.
pub(crate) struct Loose {
    free: RefinedScene,
    starts: Vec<Start>,
    /// With fewer poses, looser positions and any jump: the same optimum of the model itself costs no less.
    pub(crate) cost: f64,
}

/// The model of `nested` with `acting` added, which `refined` holds already; `None` where no start leads
/// to it.
pub(super) fn loosely_found(
    nested: &Fitted,
    scene: &Scene,
    refined: &RefinedScene,
    acting: &Acting,
) -> Result<Option<Loose>> {
    let mut free = refined.clone();
    let jumps = possible(scene, &free_jump(scene)?);
    let jumps: Vec<Acting> = jumps.iter().map(|jump| jump.act_on(&mut free)).collect();
    let most = scene.bodies().iter().map(|body| body.observations.len()).max().unwrap_or(0);
    let every = most.div_ceil(MOST_POSES).max(1);
    let paths = Bends::new(&scene.thinned(every, nested.collision_time_s()));
    let mut bare: Vec<(Start, Vec<Leaving>)> = Vec::new();
    for segment in paths.best_segments(MOST_SEGMENTS) {
        let candidates = freed_candidates(&nested.refined, &paths, &segment)?;
        for (candidate, wanted) in candidates.into_iter().take(MOST_TURNS) {
            let mut start = candidate.unknowns;
            let known = &nested.best().solution.unknowns.parameters;
            start.parameters = [known.as_slice(), &acting.instance.null()].concat();
            for jump in &jumps {
                start.parameters.extend(jump.instance.null());
            }
            unbend(&mut start, &wanted);
            let gap = nearest(&scene.gaps(), start.collision_time_s).unwrap_or(candidate.gap);
            bare.push(((start, gap), wanted));
        }
    }
    let Some(((first, gap), _)) = bare.first() else { return Ok(None) };
    let mut first = first.clone();
    first.parameters.truncate(refined.parameters.len());
    // A spring's anchor is nothing to a spring without stiffness: it starts with some, too.
    let sizes: &[f64] = match is_flat(refined, acting, &first, *gap)? {
        true => &[0.0, 1.0],
        false => &[0.0],
    };
    let mut starts: Vec<Start> = Vec::new();
    for ((start, gap), wanted) in &bare {
        for size in sizes {
            let mut start = away(refined, acting, start, *size);
            jump_to(&free, &jumps, &mut start, wanted)?;
            starts.push((start, *gap));
        }
    }
    let loose = optima_from(&loosened(&thinned(&free, &starts[0].0)), &starts)?;
    let cost = loose[0].solution.cost;
    let gaps = gaps(&free, &loose[0].solution.unknowns)?;
    let starts = loose.into_iter().map(|Optimum { solution, gap, .. }| {
        let gap = nearest(&gaps, solution.unknowns.collision_time_s).unwrap_or(gap);
        (solution.unknowns, gap)
    });
    Ok(Some(Loose { starts: starts.collect(), free, cost }))
}

impl Loose {
    /// The start of `refined`, which holds `acting`: with a contact that makes the same jump.
    pub(super) fn start(&self, refined: &RefinedScene, acting: &Acting) -> Result<Option<Start>> {
        let Optimum { solution, gap, .. } = optima_from(&self.free, &self.starts)?.swap_remove(0);
        let launched = launch(&self.free, &solution.unknowns).map_err(solver_error)?;
        let wanted: Vec<Leaving> = launched.iter().map(leaving).collect();
        let mut start = solution.unknowns;
        start.parameters.truncate(refined.parameters.len());
        Ok(same_jump(refined, acting, start, &wanted).map(|start| (start, gap)))
    }
}

/// The scene with [`ENOUGH`] poses a flight, counted outwards from the collision.
fn thinned(scene: &RefinedScene, near: &RefinedUnknowns) -> RefinedScene {
    let mut thinned = scene.clone();
    for body in &mut thinned.bodies {
        let before = body.poses.partition_point(|pose| pose.time_s < near.collision_time_s);
        let after = body.poses.split_off(before);
        let kept = |flight: Vec<RefinedPose>| -> Vec<RefinedPose> {
            let every = flight.len().div_ceil(ENOUGH).max(1);
            flight.into_iter().step_by(every).collect()
        };
        let before = kept(std::mem::take(&mut body.poses).into_iter().rev().collect());
        body.poses = before.into_iter().rev().chain(kept(after)).collect();
    }
    thinned
}

/// The scene with positions [`LOOSER`] times less sure.
fn loosened(scene: &RefinedScene) -> RefinedScene {
    let mut loose = scene.clone();
    let poses = loose.bodies.iter_mut().flat_map(|body| &mut body.poses);
    poses.for_each(|pose| pose.position_std_m *= LOOSER);
    loose
}

/// Puts the contact between bodies as heavy as each other: what a bent path told of it is of no use.
fn unbend(start: &mut RefinedUnknowns, wanted: &[Leaving]) {
    let centres = start.bodies.iter().map(|body| Vector3::from(body.position));
    let middle = centres.sum::<Vector3<f64>>() / start.bodies.len() as f64;
    start.contact_point = middle.into();
    start.impulse = (wanted[0].velocity - Vector3::from(start.bodies[0].velocity_before)).into();
    start.log_mass_ratio = 0.0;
}

/// Gives the free jumps what the bodies lack to leave as `wanted`.
fn jump_to(
    free: &RefinedScene,
    jumps: &[Acting],
    start: &mut RefinedUnknowns,
    wanted: &[Leaving],
) -> Result<()> {
    let launched = launch(free, start).map_err(solver_error)?;
    for jump in jumps {
        let Some(body) = jump.instance.body else { continue };
        let own = leaving(&launched[body]);
        let mut lacking: Vec<Vector3<f64>> = vec![wanted[body].spin - own.spin];
        if jump.count > 3 {
            lacking.insert(0, wanted[body].velocity - own.velocity);
        }
        let values = lacking.iter().flat_map(|vector| vector.iter().copied());
        for (value, lacks) in start.parameters[jump.first..].iter_mut().zip(values) {
            *value = lacks;
        }
    }
    Ok(())
}
