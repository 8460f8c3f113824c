//! Whether the residuals look random, along the axes where causes show.

use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::draws::Draws;
use super::leverage::Leverage;
use super::randomness::{Pattern, RandomnessTest, Series, deviate};
use super::residuals::{Side, sides};
use super::yardstick::{Yardstick, Yardsticks};
use super::{Axis, Segment, identity};
use crate::{Reconstruction, Result, Scene};

/// A result in which nothing is wrong has a failing channel in one of so many cases.
const FALSE_ALARM: f64 = 0.01;

/// The residuals (pose minus model) of one body, on one side of the collision, along one axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ChannelTest {
    /// The body's name.
    pub body: String,
    /// The side of the collision.
    pub segment: Segment,
    /// The axis; it tells whether positions or orientations are meant.
    pub channel: Axis,
    /// How many poses there are.
    pub poses: usize,
    /// Root mean square, in m or rad.
    pub rmse: f64,
    /// `rmse` over the noise.
    pub rmse_in_sigma: f64,
    /// The residual that is farthest from zero.
    pub largest: SignedMiss,
    /// The pose that is farthest from the collision in time, s from it.
    pub farthest: f64,
    /// A normal deviate that is as improbable as `p_value`, at least 0.
    pub z: f64,
    /// How often noise alone looks as structured or as large: that of the clearest of `tests`, times
    /// their number.
    pub p_value: f64,
    /// What it looks like.
    pub pattern: Pattern,
    /// Whether it stands out even from all the channels that were looked at: by noise alone any does in
    /// one of a hundred scenes (Holm's method).
    pub fails: bool,
    /// The tests of randomness.
    pub tests: Vec<RandomnessTest>,
}

/// A residual along an axis, with its sign.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SignedMiss {
    /// The pose's time, s.
    pub time: f64,
    /// From the collision, in s; negative before.
    pub since_collision: f64,
    /// In m or rad.
    pub value: f64,
    /// Over the noise.
    pub in_sigma: f64,
}

/// Tests whether the residuals of `result` in `scene` look random: for each body, side of the collision
/// and axis that the scene has. Empty where the result has no collision time; without the channels
/// whose noise nothing tells.
///
/// The noise is the scene's, else that of the result, else what its residuals leave. That a fit bends
/// to the poses is reckoned with where the result has its `uncertainty`; without it p-values are rather
/// too large.
///
/// # Errors
/// The result is of another scene, or spins too fast to be followed.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let result = smash::reconstruct(&scene, &smash::Options::default())?;
/// for channel in smash::compare::channels(&scene, &result)? {
///     println!("{} {:?}: p = {:.2}", channel.body, channel.channel, channel.p_value);
/// }
/// # Ok::<(), smash::Error>(())
/// ```
pub fn channels(scene: &Scene, result: &Reconstruction) -> Result<Vec<ChannelTest>> {
    identity::check(scene, result)?;
    let Some(sides) = sides(scene, result)? else { return Ok(Vec::new()) };
    channels_of(scene, result, &sides, &Yardsticks::new(scene, result, &sides))
}

/// The same, of residuals that are known.
pub(super) fn channels_of(
    scene: &Scene,
    result: &Reconstruction,
    sides: &[Side],
    yardsticks: &Yardsticks,
) -> Result<Vec<ChannelTest>> {
    let leverage = Leverage::new(scene, result)?;
    let mut draws = Draws::new();
    let mut all = Vec::new();
    for side in sides {
        for axis in Axis::ALL {
            let Some(stick) = yardsticks.of(axis.channel()) else { continue };
            let points = points(scene, side, axis, result.collision_time.value.unwrap_or(0.0));
            if !points.is_empty() {
                all.push(tested(side, axis, &points, stick, leverage.as_ref(), &mut draws));
            }
        }
    }
    mark_failures(&mut all);
    Ok(all)
}

/// A residual along an axis.
pub(super) struct Point {
    pub(super) time_s: f64,
    pub(super) since_s: f64,
    /// In m or rad.
    pub(super) value: f64,
    /// The pose's number among those of its side, and the axis there.
    pub(super) pose: usize,
    /// Its σ over that of the noise.
    pub(super) noise_scale: f64,
    along: nalgebra::Vector3<f64>,
}

/// The residuals of `side` along `axis`, where there is one.
pub(super) fn points(scene: &Scene, side: &Side, axis: Axis, collision_time_s: f64) -> Vec<Point> {
    let poses = side.poses.iter().enumerate().filter_map(|(pose, residual)| {
        let along = axis.at(residual, scene)?.into_inner();
        Some(Point {
            time_s: residual.time_s,
            since_s: residual.time_s - collision_time_s,
            value: residual.in_channel(axis.channel())?.dot(&along),
            pose,
            noise_scale: residual.noise_scale,
            along,
        })
    });
    poses.collect()
}

fn tested(
    side: &Side,
    axis: Axis,
    points: &[Point],
    stick: Yardstick,
    leverage: Option<&Leverage>,
    draws: &mut Draws,
) -> ChannelTest {
    let rows: Vec<_> = points
        .iter()
        .filter_map(|point| {
            let rows = leverage?.rows(side.body_index, axis.channel(), side.first + point.pose);
            Some(point.along.transpose() * rows / (stick.sigma * point.noise_scale))
        })
        .collect();
    let columns = rows.first().map_or(0, |row| row.ncols());
    let in_sigma = |point: &Point| point.value / (stick.sigma * point.noise_scale);
    let mean = |squares: f64| squares / points.len() as f64;
    let series = Series {
        since_s: points.iter().map(|point| point.since_s).collect(),
        values: DVector::from_iterator(points.len(), points.iter().map(in_sigma)),
        taken: DMatrix::from_fn(points.len(), columns, |row, column| rows[row][column]),
        dof: stick.dof,
    };
    let verdict = series.verdict(draws);
    let largest = points.iter().fold(&points[0], |most, point| {
        if point.value.abs() > most.value.abs() { point } else { most }
    });
    ChannelTest {
        body: side.body.name.clone(),
        segment: side.segment,
        channel: axis,
        poses: points.len(),
        rmse: mean(points.iter().map(|point| point.value.powi(2)).sum()).sqrt(),
        rmse_in_sigma: mean(points.iter().map(|point| in_sigma(point).powi(2)).sum()).sqrt(),
        largest: SignedMiss {
            time: largest.time_s,
            since_collision: largest.since_s,
            value: largest.value,
            in_sigma: in_sigma(largest),
        },
        farthest: points.iter().map(|point| point.since_s.abs()).fold(0.0, f64::max),
        z: deviate(verdict.p_value),
        p_value: verdict.p_value,
        pattern: verdict.pattern,
        fails: false,
        tests: verdict.tests,
    }
}

/// Holm, *A simple sequentially rejective multiple test procedure*, 1979.
fn mark_failures(channels: &mut [ChannelTest]) {
    let mut order: Vec<usize> = (0..channels.len()).collect();
    order.sort_by(|&a, &b| channels[a].p_value.total_cmp(&channels[b].p_value));
    for (rank, &index) in order.iter().enumerate() {
        let left = (channels.len() - rank) as f64;
        if left * channels[index].p_value >= FALSE_ALARM {
            break;
        }
        channels[index].fails = true;
    }
}
