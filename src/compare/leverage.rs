//! How far the fit has bent to the poses: residuals of a fit are smaller than the noise, and hang
//! together.
//!
//! Of a least-squares fit cov(r) = σ² − J C Jᵀ, where J is how the model's poses go with the state at
//! the collision, and C that state's covariance (Seber & Wild, *Nonlinear Regression*, 1989, ch. 4).
//! C stands in the result; J comes from flying the bodies from states a little beside.

use nalgebra::{DMatrix, SymmetricEigen, UnitQuaternion, Vector3};

use super::Channel;
use super::flight::{Prediction, first_after, predictions};
use crate::reconstruct::active_effect::scalar_names;
use crate::reconstruct::{Number, Uncertainty};
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};
use crate::scene::Gap;
use crate::{Reconstruction, Result, Scene};

/// A part of each deviation to step by: small against any bend, large against rounding.
const STEP: f64 = 1e-2;
const SMALLEST_STEP: f64 = 1e-8;
const LARGEST_STEP: f64 = 1e-2;
/// A collision time so many deviations from its segment's ends is as good as free; nearer, it is held
/// by them, and the fit has bent less than its covariance says.
const FREE: f64 = 3.0;

/// What the fit has taken from the residuals of each body: cov(r) = σ² − A Aᵀ.
pub(super) struct Leverage {
    bodies: Vec<[DMatrix<f64>; 2]>,
}

/// What is stepped at once: a number of the body's state, or one before and one after, since either
/// moves its own side of the collision alone; or a scalar of an effect's parameter.
#[derive(Clone)]
enum Step {
    CollisionTime,
    Gravity(usize),
    Position(usize),
    Orientation(usize),
    Velocities(usize),
    Omegas(usize),
    Parameter { effect: usize, name: String, scalar: usize, count: usize },
}

impl Leverage {
    /// `None` where the result doesn't tell its covariance.
    ///
    /// # Errors
    /// As [`predictions`].
    pub(super) fn new(scene: &Scene, result: &Reconstruction) -> Result<Option<Leverage>> {
        let (Some(table), Some(base)) = (&result.uncertainty, predictions(scene, result)?) else {
            return Ok(None);
        };
        let steps = steps(result);
        let std = |step: &Step, body: &str| {
            let names = step.names(body);
            let stds = names.iter().filter_map(|name| table.std[place(table, name)?]);
            stds.max_by(f64::total_cmp)
        };
        let mut slopes: Vec<[DMatrix<f64>; 2]> = base
            .iter()
            .map(|poses| [(); 2].map(|()| DMatrix::zeros(3 * poses.len(), 2 * steps.len())))
            .collect();
        for (index, step) in steps.iter().enumerate() {
            let stds = scene.bodies().iter().filter_map(|body| std(step, &body.name));
            let Some(std) = stds.max_by(f64::total_cmp) else { continue };
            let length = (STEP * std).clamp(SMALLEST_STEP, LARGEST_STEP);
            // All bodies at once: none's flight goes with another's state.
            let beside = predictions(scene, &step.taken(result, length))?.unwrap_or_default();
            for (body, (base, beside)) in base.iter().zip(&beside).enumerate() {
                let split = first_after(base);
                let column =
                    |pose: usize| 2 * index + usize::from(step.has_sides() && pose >= split);
                put_slopes(&mut slopes[body], column, base, beside, length);
            }
        }
        let is_free = is_free(scene, result);
        let bodies = scene.bodies().iter().zip(slopes).map(|(body, slopes)| {
            let root = root(covariance(table, &steps, &body.name, is_free));
            // What is known to no finite deviation takes nothing that could be told.
            let known = |number: f64| if number.is_finite() { number } else { 0.0 };
            slopes.map(|slopes| (slopes * &root).map(known))
        });
        Ok(Some(Leverage { bodies: bodies.collect() }))
    }

    /// A's three rows for the pose `pose` of body `body`.
    pub(super) fn rows(&self, body: usize, channel: Channel, pose: usize) -> DMatrix<f64> {
        let channel = match channel {
            Channel::Position => 0,
            Channel::Orientation => 1,
        };
        self.bodies[body][channel].rows(3 * pose, 3).into_owned()
    }
}

fn place(table: &Uncertainty, name: &str) -> Option<usize> {
    table.quantities.iter().position(|known| known == name)
}

/// Whether the collision time is well within its segment.
fn is_free(scene: &Scene, result: &Reconstruction) -> bool {
    let (Some(time_s), Some(std_s)) = (result.collision_time.value, result.collision_time.std)
    else {
        return false;
    };
    let within = |gap: &Gap| (time_s - gap.start_s).min(gap.end_s - time_s) >= FREE * std_s;
    scene.gaps().iter().any(within)
}

fn steps(result: &Reconstruction) -> Vec<Step> {
    let vectors =
        [Step::Gravity, Step::Position, Step::Orientation, Step::Velocities, Step::Omegas];
    let axes = vectors.into_iter().flat_map(|vector| (0..3).map(vector));
    std::iter::once(Step::CollisionTime).chain(axes).chain(parameters(result)).collect()
}

fn parameters(result: &Reconstruction) -> Vec<Step> {
    let mut steps = Vec::new();
    for (effect, active) in result.effects.iter().enumerate() {
        for (name, estimate) in &active.parameters {
            let count = estimate.value.as_ref().map_or(0, |value| value.components().len());
            steps.extend((0..count).map(|scalar| Step::Parameter {
                effect,
                name: name.clone(),
                scalar,
                count,
            }));
        }
    }
    steps
}

impl Step {
    /// Of the numbers that are stepped, as [`Reconstruction::uncertainty`] has them.
    fn names(&self, body: &str) -> Vec<String> {
        let of = |vector: &str, at: usize| format!("{body}.{vector}.{}", ["x", "y", "z"][at]);
        match *self {
            Step::CollisionTime => vec!["collision_time".into()],
            Step::Gravity(at) => vec![format!("gravity.{}", ["x", "y", "z"][at])],
            Step::Position(at) => vec![of("position", at)],
            Step::Orientation(at) => vec![of("orientation", at)],
            Step::Velocities(at) => vec![of("velocity_before", at), of("velocity_after", at)],
            Step::Omegas(at) => {
                vec![of("angular_velocity_before", at), of("angular_velocity_after", at)]
            }
            Step::Parameter { effect, ref name, scalar, count } => {
                vec![scalar_names(effect, name, count).swap_remove(scalar)]
            }
        }
    }

    /// Whether there is a number for each side.
    fn has_sides(&self) -> bool {
        matches!(self, Step::Velocities(_) | Step::Omegas(_))
    }

    /// `result` with these numbers of each body a `length` further.
    fn taken(&self, result: &Reconstruction, length: f64) -> Reconstruction {
        let mut beside = result.clone();
        match self {
            Step::CollisionTime => {
                beside.collision_time.value = beside.collision_time.value.map(|time| time + length);
            }
            Step::Parameter { effect, name, scalar, .. } => {
                let estimate = beside.effects[*effect].parameters.get_mut(name);
                match estimate.and_then(|estimate| estimate.value.as_mut()) {
                    Some(Number::Scalar(value)) => *value += length,
                    Some(Number::Vector(values)) => values[*scalar] += length,
                    None => {}
                }
            }
            _ => {}
        }
        if let (&Step::Gravity(at), Some(gravity)) = (self, &mut beside.gravity) {
            gravity[at] += length;
        }
        for body in &mut beside.bodies {
            match *self {
                Step::CollisionTime | Step::Gravity(_) | Step::Parameter { .. } => {}
                Step::Position(at) => body.position[at] += length,
                Step::Orientation(at) => {
                    let turn = UnitQuaternion::new(Vector3::ith(at, length));
                    body.orientation = body.orientation.map(|q| to_wxyz(&(turn * from_wxyz(q))));
                }
                Step::Velocities(at) => {
                    body.velocity_before[at] += length;
                    body.velocity_after[at] += length;
                }
                Step::Omegas(at) => {
                    let spins =
                        [&mut body.angular_velocity_before, &mut body.angular_velocity_after];
                    spins.into_iter().flatten().for_each(|spin| spin[at] += length);
                }
            }
        }
        beside
    }
}

fn put_slopes(
    [positions, turns]: &mut [DMatrix<f64>; 2],
    column: impl Fn(usize) -> usize,
    base: &[Prediction],
    beside: &[Prediction],
    length: f64,
) {
    for (pose, (base, beside)) in base.iter().zip(beside).enumerate() {
        let moved = (beside.position_in_world - base.position_in_world) / length;
        positions.fixed_view_mut::<3, 1>(3 * pose, column(pose)).copy_from(&moved);
        if let Some((base, beside)) = base.rotation.zip(beside.rotation) {
            let turn = (beside.world_from_body * base.world_from_body.inverse()).scaled_axis();
            turns.fixed_view_mut::<3, 1>(3 * pose, column(pose)).copy_from(&(turn / length));
        }
    }
}

/// Of the numbers of `steps`, two columns a step; given the collision time unless it `is_free`.
fn covariance(table: &Uncertainty, steps: &[Step], body: &str, is_free: bool) -> DMatrix<f64> {
    let places: Vec<Option<usize>> = steps
        .iter()
        .flat_map(|step| {
            let mut names = step.names(body).into_iter();
            [names.next(), names.next()]
        })
        .map(|name| place(table, &name?).filter(|&at| table.std[at].is_some()))
        .collect();
    let all = DMatrix::from_fn(places.len(), places.len(), |row, column| {
        let covariance = || {
            let (one, other) = (places[row]?, places[column]?);
            let correlation = table.correlation.get(one.max(other))?.get(one.min(other))?;
            Some((*correlation)? * table.std[one]? * table.std[other]?)
        };
        covariance().unwrap_or(0.0)
    });
    let variance = all[(0, 0)];
    if is_free || variance <= 0.0 {
        return all;
    }
    // The collision time comes first.
    &all - all.column(0) * all.row(0) / variance
}

/// B with B Bᵀ = `covariance`; what rounding makes negative is zero.
fn root(covariance: DMatrix<f64>) -> DMatrix<f64> {
    let size = covariance.nrows();
    let scale: Vec<f64> = (0..size).map(|at| covariance[(at, at)].max(0.0).sqrt()).collect();
    // By deviations, so that metres and radians a second weigh alike.
    let correlation = DMatrix::from_fn(size, size, |row, column| {
        let product = scale[row] * scale[column];
        if product > 0.0 { covariance[(row, column)] / product } else { 0.0 }
    });
    let SymmetricEigen { eigenvalues, eigenvectors } = SymmetricEigen::new(correlation);
    DMatrix::from_fn(size, size, |row, column| {
        scale[row] * eigenvectors[(row, column)] * eigenvalues[column].max(0.0).sqrt()
    })
}
