//! Model minus pose, by body, segment and channel.

use nalgebra::Vector3;
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::flight::Flight;
use super::{Channel, ChannelResidual, ComparedNoise, LargestMiss, ResultResiduals, Segment};
use crate::scene::{DynamicBody, Observation, Scene};
use crate::{Reconstruction, Result};

const NO_TIME: &str = "the result has no collision time to fly from";
const NO_SPIN: &str = "the result doesn't tell all spins, so some orientations can't be compared";

/// By noise alone a channel stands out as often.
const FALSE_ALARMS: f64 = 1e-3;

/// The model's pose minus the annotated one.
struct PoseResidual {
    time_s: f64,
    position_m: Vector3<f64>,
    /// The rotation vector of q_obs⁻¹ q; `None` where it isn't annotated or the model has none.
    turn_rad: Option<Vector3<f64>>,
}

/// The residuals of `result`, called `name`, in `scene`.
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
        reason: None,
    };
    let Some(collision_time_s) = result.collision_time.value else {
        told.reason = Some(NO_TIME.to_string());
        return Ok(told);
    };
    let scenes_own = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
    let gravity_in_world = result.gravity.map_or(scenes_own, Vector3::from);
    for (index, (body, at_collision)) in scene.bodies().iter().zip(&result.bodies).enumerate() {
        for (segment, poses) in sides(body, collision_time_s) {
            let flight =
                Flight::new(at_collision, &body.shape, segment, collision_time_s, gravity_in_world);
            let residuals = pose_residuals(&flight, poses)
                .map_err(|error| error.at(format!("bodies[{index}]")))?;
            let annotated = poses.iter().filter(|pose| pose.world_from_body.is_some()).count();
            if residuals.iter().filter(|one| one.turn_rad.is_some()).count() < annotated {
                told.reason = Some(NO_SPIN.to_string());
            }
            for channel in [Channel::Position, Channel::Orientation] {
                told.channels.extend(summary(body, segment, channel, &residuals, noise));
            }
        }
    }
    told.position_rmse = total(&told.channels, Channel::Position);
    told.orientation_rmse = total(&told.channels, Channel::Orientation);
    Ok(told)
}

fn sides(body: &DynamicBody, collision_time_s: f64) -> [(Segment, &[Observation]); 2] {
    let split = body.observations.partition_point(|pose| pose.time_s < collision_time_s);
    let (before, after) = body.observations.split_at(split);
    [(Segment::Before, before), (Segment::After, after)]
}

fn pose_residuals(flight: &Flight, poses: &[Observation]) -> Result<Vec<PoseResidual>> {
    let residuals = poses.iter().zip(flight.predictions(poses)?).map(|(seen, model)| {
        let orientations = seen.world_from_body.zip(model.world_from_body);
        PoseResidual {
            time_s: seen.time_s,
            position_m: model.position_in_world - seen.position_in_world,
            turn_rad: orientations.map(|(seen, model)| seen.rotation_to(&model).scaled_axis()),
        }
    });
    Ok(residuals.collect())
}

/// `None` where the channel has no residual.
fn summary(
    body: &DynamicBody,
    segment: Segment,
    channel: Channel,
    residuals: &[PoseResidual],
    noise: Option<&ComparedNoise>,
) -> Option<ChannelResidual> {
    let sizes: Vec<(f64, f64)> = residuals
        .iter()
        .filter_map(|one| {
            let vector = match channel {
                Channel::Position => Some(one.position_m),
                Channel::Orientation => one.turn_rad,
            };
            vector.map(|vector| (one.time_s, vector.norm()))
        })
        .collect();
    let &(time, size) = sizes.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let sigma = noise.and_then(|noise| match channel {
        Channel::Position => Some(noise.position),
        Channel::Orientation => noise.orientation,
    });
    let squares: f64 = sizes.iter().map(|(_, size)| size * size).sum();
    let coordinates = 3.0 * sizes.len() as f64;
    let rmse = (squares / coordinates).sqrt();
    let rmse_in_sigma = sigma.map(|sigma| rmse / sigma);
    Some(ChannelResidual {
        body: body.name.clone(),
        segment,
        channel,
        poses: sizes.len(),
        rmse,
        rmse_in_sigma,
        stands_out: rmse_in_sigma.map(|rmse| stands_out(rmse, coordinates)),
        largest: LargestMiss { time, size, in_sigma: sigma.map(|sigma| size / sigma) },
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
