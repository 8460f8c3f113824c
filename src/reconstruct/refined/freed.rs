//! A start for an effect at the contact, where the model without it is bent so far that rotations
//! wrap: a fit whose jump is free, and then the contact, the impulse and the parameters that make the
//! same jump.

use nalgebra::{DMatrix, DVector, Vector3};

use super::acting::{Acting, possible};
use super::fitted::Fitted;
use super::layout::Layout;
use super::parabolas::{Parabolas, Paths};
use super::start::{Leaving, freed_candidates};
use super::starts::{Start, away, touch};
use crate::bridge::refined::ffi::{RefinedLaunch, RefinedScene, RefinedUnknowns, launch};
use crate::effect::Effect;
use crate::reconstruct::solver_error;
use crate::{Result, Scene};

/// Any jump in the spins; that of the velocities is free already where two bodies push each other.
const FREE_SPIN: &str = r#"
name = "free_spin"
title = "Any angular impulse at the collision"
scope = "body"
[parameters.S]
unit = "m^2/s"
null = [0.0, 0.0, 0.0]
[law]
angular_impulse = "S"
"#;
/// Any jump at all: a plane pushes along its normal only.
const FREE_JUMP: &str = r#"
name = "free_jump"
title = "Any impulse at the collision"
scope = "body"
[parameters.P]
unit = "m/s"
null = [0.0, 0.0, 0.0]
[parameters.S]
unit = "m^2/s"
null = [0.0, 0.0, 0.0]
[law]
impulse = "P"
angular_impulse = "S"
"#;
/// Typical sizes that the search for the same jump starts from.
const SIZES: [f64; 2] = [0.0, 1.0];
/// Pairs of flights that are tried.
const MOST_TURNS: usize = 2;
const MOST_STEPS: usize = 30;
/// Of a coordinate's scale.
const STEP: f64 = 1e-6;

/// The starts of `nested` with `acting` added, which `refined` holds already: from its own optimum, and
/// from the flights alone, since a bent fit may have settled on other turns of a spin.
pub(super) fn freed(
    nested: &Fitted,
    scene: &Scene,
    refined: &RefinedScene,
    acting: &Acting,
) -> Result<Vec<Start>> {
    // A spin that has wrapped may be too fast to start from.
    let mut free: Vec<_> = freed_optimum(nested, scene).into_iter().collect();
    let parabolas = Parabolas::new(scene);
    for segment in parabolas.best_segments(1) {
        let candidates = freed_candidates(&nested.refined, &parabolas, &segment)?;
        free.extend(
            candidates
                .into_iter()
                .take(MOST_TURNS)
                .map(|(candidate, leaving)| ((candidate.unknowns, candidate.gap), leaving)),
        );
    }
    let known = &nested.best().solution.unknowns.parameters;
    let mut starts = Vec::new();
    for ((mut start, gap), wanted) in free {
        start.parameters = [known.as_slice(), &acting.instance.null()].concat();
        if let Some(plane) = scene.plane() {
            let normal = plane.normal_in_world.into_inner();
            let jump = wanted[0].velocity - Vector3::from(start.bodies[0].velocity_before);
            start.impulse = (normal * normal.dot(&jump)).into();
            touch(&mut start, plane);
        }
        starts.extend(SIZES.iter().filter_map(|size| {
            let start = away(refined, acting, &start, *size);
            Some((same_jump(refined, acting, start, &wanted)?, gap))
        }));
    }
    Ok(starts)
}

/// The optimum of `nested` where any jump is possible, and how the bodies leave it.
fn freed_optimum(nested: &Fitted, scene: &Scene) -> Result<(Start, Vec<Leaving>)> {
    let mut free = nested.clone();
    for instance in possible(scene, &free_jump(scene)?) {
        free = free.with_quickly(scene, &instance)?;
    }
    let best = free.best();
    let launched = launch(&free.refined, &best.solution.unknowns).map_err(solver_error)?;
    Ok(((best.solution.unknowns.clone(), best.gap), launched.iter().map(leaving).collect()))
}

/// The effect of any jump that the contact itself can't make.
pub(super) fn free_jump(scene: &Scene) -> Result<Effect> {
    let text = if scene.plane().is_some() { FREE_JUMP } else { FREE_SPIN };
    Effect::parse(text, "free_jump")
}

pub(super) fn leaving(launched: &RefinedLaunch) -> Leaving {
    Leaving { velocity: launched.velocity_after.into(), spin: launched.spin_after.into() }
}

/// Contact, impulse and parameters for which the bodies leave as `wanted`, as nearly as may be, by
/// damped Gauss-Newton steps.
pub(super) fn same_jump(
    refined: &RefinedScene,
    acting: &Acting,
    mut unknowns: RefinedUnknowns,
    wanted: &[Leaving],
) -> Option<RefinedUnknowns> {
    let layout = Layout::new(refined);
    let impulse = layout.impulse..layout.impulse + layout.impulse_size();
    let contact = layout.contact.map_or(0..0, |first| first..first + 2);
    let own = layout.parameters[acting.first..acting.first + acting.count].iter().flatten();
    let moved: Vec<usize> = impulse.chain(contact).chain(own.copied()).collect();
    let mut miss = miss(refined, &unknowns, wanted)?;
    let mut damping = 1e-6;
    for _ in 0..MOST_STEPS {
        let slopes: Option<Vec<DVector<f64>>> = moved
            .iter()
            .map(|&index| {
                let beside = self::miss(refined, &layout.stepped(&unknowns, index, STEP), wanted)?;
                Some((beside - &miss) / STEP)
            })
            .collect();
        let slopes = DMatrix::from_columns(&slopes?);
        let mut normal = slopes.tr_mul(&slopes);
        for i in 0..moved.len() {
            normal[(i, i)] += damping * (normal[(i, i)] + f64::MIN_POSITIVE.sqrt());
        }
        let step = normal.lu().solve(&-slopes.tr_mul(&miss))?;
        let mut next = unknowns.clone();
        for (&index, length) in moved.iter().zip(&step) {
            next = layout.stepped(&next, index, *length);
        }
        for (value, rule) in next.parameters.iter_mut().zip(&refined.parameters) {
            *value = value.clamp(rule.low, rule.high);
        }
        match self::miss(refined, &next, wanted) {
            Some(less) if less.norm() < miss.norm() => {
                (unknowns, miss, damping) = (next, less, 0.1 * damping);
            }
            _ if damping > 1e6 => break,
            _ => damping *= 10.0,
        }
    }
    unknowns.contact_point.iter().all(|x| x.is_finite()).then_some(unknowns)
}

/// What bodies leave with but for `wanted`: velocities in m/s, and L over the body's size.
fn miss(
    refined: &RefinedScene,
    unknowns: &RefinedUnknowns,
    wanted: &[Leaving],
) -> Option<DVector<f64>> {
    let own: Vec<Leaving> = launch(refined, unknowns).ok()?.iter().map(leaving).collect();
    let bodies = refined.bodies.iter().zip(own.iter().zip(wanted));
    let numbers = bodies.flat_map(|(body, (own, wanted))| {
        let size_m = Vector3::from(body.size).norm();
        let velocity = own.velocity - wanted.velocity;
        let spin = own.spin - wanted.spin;
        [velocity, spin / size_m].map(<[f64; 3]>::from).concat()
    });
    let miss = DVector::from_vec(numbers.collect());
    miss.iter().all(|number| number.is_finite()).then_some(miss)
}
