//! Residuals over time, along each axis: what plots draw.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::channels::{Point, points};
use super::residuals::{Side, sides};
use super::yardstick::{Yardstick, Yardsticks};
use super::{Axis, Channel, Segment, identity};
use crate::{Reconstruction, Result, Scene};

/// The residuals (pose minus model) of a body along an axis, over time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResidualSeries {
    /// The body's name.
    pub body: String,
    /// The axis.
    pub axis: Axis,
    /// The axis in words.
    pub label: String,
    /// What is looked at.
    pub channel: Channel,
    /// One σ of the noise, m or rad; null where nothing tells it.
    pub sigma: Option<f64>,
    /// In order of time.
    pub points: Vec<ResidualPoint>,
}

/// A pose's residual along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ResidualPoint {
    /// The pose's number among the body's, from 0, in order of time.
    pub observation: usize,
    /// s.
    pub time: f64,
    /// m or rad.
    pub value: f64,
    /// The side of the collision.
    pub segment: Segment,
    /// The pose's own σ over `sigma`; 1 unless the scene states another.
    #[serde(default = "as_noisy", skip_serializing_if = "is_as_noisy")]
    pub noise_scale: f64,
}

fn as_noisy() -> f64 {
    1.0
}

/// By reference, as serde asks.
fn is_as_noisy(scale: &f64) -> bool {
    *scale == 1.0
}

/// The residuals of `result` over time, by body and axis; axes that a body hasn't got are left out.
/// Empty where the result has no collision time.
///
/// # Errors
/// As [`super::channels`].
pub fn series(scene: &Scene, result: &Reconstruction) -> Result<Vec<ResidualSeries>> {
    identity::check(scene, result)?;
    let (Some(sides), Some(time_s)) = (sides(scene, result)?, result.collision_time.value) else {
        return Ok(Vec::new());
    };
    let yardsticks = Yardsticks::new(scene, result, &sides);
    let mut all = Vec::new();
    for (index, body) in scene.bodies().iter().enumerate() {
        let of_body: Vec<&Side> = sides.iter().filter(|side| side.body_index == index).collect();
        for axis in Axis::ALL {
            let points: Vec<_> =
                of_body.iter().flat_map(|side| along(scene, side, axis, time_s)).collect();
            if points.is_empty() {
                continue;
            }
            all.push(ResidualSeries {
                body: body.name.clone(),
                axis,
                label: axis.label().to_string(),
                channel: axis.channel(),
                sigma: yardsticks.of(axis.channel()).map(|Yardstick { sigma, .. }| sigma),
                points,
            });
        }
    }
    Ok(all)
}

fn along(scene: &Scene, side: &Side, axis: Axis, collision_time_s: f64) -> Vec<ResidualPoint> {
    let told = |point: Point| ResidualPoint {
        observation: side.first + point.pose,
        time: point.time_s,
        value: point.value,
        segment: side.segment,
        noise_scale: point.noise_scale,
    };
    points(scene, side, axis, collision_time_s).into_iter().map(told).collect()
}
