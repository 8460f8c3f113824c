//! Pose minus model, by body, segment and channel.

use nalgebra::{UnitQuaternion, Vector3};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::channels::channels_of;
use super::findings::findings;
use super::flight::{PredictedRotation, Prediction, first_after, predictions};
use super::ledger::ledger;
use super::yardstick::{Yardsticks, outliers};
use super::{Channel, ChannelResidual, ComparedNoise, LargestMiss, ResultResiduals, Segment};
use crate::scene::{DynamicBody, Observation, Scene};
use crate::{Reconstruction, Result};

const NO_TIME: &str = "the result has no collision time to fly from";
const NO_SPIN: &str = "the result doesn't tell all spins, so some orientations can't be compared";

/// By noise alone a channel stands out as often.
const FALSE_ALARMS: f64 = 1e-3;

/// The annotated pose minus the model's, and how the model moves there.
pub(super) struct PoseResidual {
    pub(super) time_s: f64,
    pub(super) position_m: Vector3<f64>,
    /// The rotation vector from the model to the pose, in the world; `None` where it isn't annotated
    /// or the model has none.
    pub(super) turn_rad: Option<Vector3<f64>>,
    pub(super) velocity_in_world: Vector3<f64>,
    /// `None` where the result doesn't tell it.
    pub(super) omega_in_world: Option<Vector3<f64>>,
    pub(super) seen_in_world: Vector3<f64>,
    /// Its σ over that of the noise.
    pub(super) noise_scale: f64,
}

/// The residuals of one body on one side of the collision.
pub(super) struct Side<'a> {
    pub(super) body: &'a DynamicBody,
    pub(super) body_index: usize,
    pub(super) segment: Segment,
    /// The first pose's number among the body's.
    pub(super) first: usize,
    pub(super) poses: Vec<PoseResidual>,
}

/// The residuals of `result` by body, before the collision and after it; `None` where the result has
/// no collision time.
///
/// # Errors
/// As [`predictions`].
pub(super) fn sides<'a>(
    scene: &'a Scene,
    result: &Reconstruction,
) -> Result<Option<Vec<Side<'a>>>> {
    let Some(predictions) = predictions(scene, result)? else { return Ok(None) };
    let mut sides = Vec::new();
    for (body_index, (body, predictions)) in scene.bodies().iter().zip(&predictions).enumerate() {
        let split = first_after(predictions);
        let all = body
            .observations
            .iter()
            .zip(predictions)
            .map(|(seen, model)| pose_residual(seen, model));
        let mut before: Vec<PoseResidual> = all.collect();
        let after = before.split_off(split);
        for (segment, first, poses) in
            [(Segment::Before, 0, before), (Segment::After, split, after)]
        {
            sides.push(Side { body, body_index, segment, first, poses });
        }
    }
    Ok(Some(sides))
}

fn pose_residual(seen: &Observation, model: &Prediction) -> PoseResidual {
    let orientations = seen.world_from_body.zip(model.rotation);
    let turn = |(seen, model): (UnitQuaternion<f64>, PredictedRotation)| {
        (seen * model.world_from_body.inverse()).scaled_axis()
    };
    PoseResidual {
        time_s: seen.time_s,
        position_m: seen.position_in_world - model.position_in_world,
        turn_rad: orientations.map(turn),
        velocity_in_world: model.velocity_in_world,
        omega_in_world: model.rotation.map(|rotation| rotation.omega_in_world),
        seen_in_world: seen.position_in_world,
        noise_scale: seen.noise_scale,
    }
}

impl PoseResidual {
    /// In m or rad.
    pub(super) fn in_channel(&self, channel: Channel) -> Option<Vector3<f64>> {
        match channel {
            Channel::Position => Some(self.position_m),
            Channel::Orientation => self.turn_rad,
        }
    }
}

/// The residuals of `result`, called `name`, in `scene`, and what they tell.
pub(super) fn of(
    scene: &Scene,
    name: &str,
    result: &Reconstruction,
    noise: Option<&ComparedNoise>,
) -> Result<ResultResiduals> {
    let mut told = ResultResiduals {
        name: name.to_string(),
        preset: result.preset,
        position_rmse: None,
        orientation_rmse: None,
        reported_position_rmse: result.fit.position_rmse,
        reported_orientation_rmse: result.fit.orientation_rmse,
        channels: Vec::new(),
        structure: Vec::new(),
        findings: Vec::new(),
        outliers: Vec::new(),
        ledger: ledger(scene, result),
        reason: None,
    };
    let Some(sides) = sides(scene, result)? else {
        told.reason = Some(NO_TIME.to_string());
        return Ok(told);
    };
    for side in &sides {
        let annotated = side.body.observations[side.first..][..side.poses.len()].iter();
        let unknown = annotated
            .zip(&side.poses)
            .any(|(seen, one)| seen.world_from_body.is_some() && one.turn_rad.is_none());
        if unknown {
            told.reason = Some(NO_SPIN.to_string());
        }
        for channel in [Channel::Position, Channel::Orientation] {
            told.channels.extend(summary(side, channel, noise));
        }
    }
    told.position_rmse = total(&told.channels, Channel::Position);
    told.orientation_rmse = total(&told.channels, Channel::Orientation);
    let yardsticks = Yardsticks::new(scene, result, &sides);
    told.structure = channels_of(scene, result, &sides, &yardsticks)?;
    told.findings = findings(&told.structure);
    told.outliers = outliers(&sides, &yardsticks);
    Ok(told)
}

/// `None` where the channel has no residual.
fn summary(
    side: &Side,
    channel: Channel,
    noise: Option<&ComparedNoise>,
) -> Option<ChannelResidual> {
    let sizes: Vec<(&PoseResidual, f64)> =
        side.poses.iter().filter_map(|one| Some((one, one.in_channel(channel)?.norm()))).collect();
    let &(largest, size) = sizes.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let sigma = noise.and_then(|noise| match channel {
        Channel::Position => Some(noise.position),
        Channel::Orientation => noise.orientation,
    });
    let squares: f64 = sizes.iter().map(|(_, size)| size * size).sum();
    let coordinates = 3.0 * sizes.len() as f64;
    let rmse = (squares / coordinates).sqrt();
    let scaled: f64 = sizes.iter().map(|(one, size)| (size / one.noise_scale).powi(2)).sum();
    let rmse_in_sigma = sigma.map(|sigma| (scaled / coordinates).sqrt() / sigma);
    Some(ChannelResidual {
        body: side.body.name.clone(),
        segment: side.segment,
        channel,
        poses: sizes.len(),
        rmse,
        rmse_in_sigma,
        stands_out: rmse_in_sigma.map(|rmse| stands_out(rmse, coordinates)),
        largest: LargestMiss {
            time: largest.time_s,
            size,
            in_sigma: sigma.map(|sigma| size / (sigma * largest.noise_scale)),
        },
    })
}

/// Whether χ² of so many coordinates is improbable. The fit has bent to them, so that their χ² is
/// rather smaller: it errs towards silence.
fn stands_out(rmse_in_sigma: f64, coordinates: f64) -> bool {
    ChiSquared::new(coordinates).is_ok_and(|chi2| {
        rmse_in_sigma.powi(2) * coordinates > chi2.inverse_cdf(1.0 - FALSE_ALARMS)
    })
}

/// The root mean square over all coordinates of `channel`.
fn total(channels: &[ChannelResidual], channel: Channel) -> Option<f64> {
    let of_channel = || channels.iter().filter(|one| one.channel == channel);
    let poses: usize = of_channel().map(|one| one.poses).sum();
    let squares: f64 = of_channel().map(|one| one.rmse * one.rmse * one.poses as f64).sum();
    (poses > 0).then(|| (squares / poses as f64).sqrt())
}
