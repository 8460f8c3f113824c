//! The noise that one result's residuals are tested against, and the single poses that exceed it.

use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::Channel;
use super::residuals::Side;
use crate::Reconstruction;
use crate::reconstruct::Outlier;
use crate::scene::Scene;

/// A pose is called wrong in one of so many scenes that have none.
const FALSE_ALARM: f64 = 0.01;

/// One σ of a channel, and how well it is known.
#[derive(Debug, Clone, Copy)]
pub(super) struct Yardstick {
    pub(super) sigma: f64,
    /// Degrees of freedom that it is estimated from; infinite where it is stated.
    pub(super) dof: f64,
}

/// Of positions and orientations; `None` where nothing tells the noise.
pub(super) struct Yardsticks {
    position: Option<Yardstick>,
    orientation: Option<Yardstick>,
}

impl Yardsticks {
    /// The noise that the scene states, else what the result's fit found, else what its residuals
    /// leave: √(RSS/(n − used)).
    pub(super) fn new(scene: &Scene, result: &Reconstruction, sides: &[Side]) -> Yardsticks {
        let of = |channel| {
            let poses = sides.iter().flat_map(|side| &side.poses);
            let squares: Vec<f64> = poses
                .filter_map(|pose| Some(pose.in_channel(channel)? / pose.noise_scale))
                .map(|vector| vector.norm_squared())
                .collect();
            (3.0 * squares.len() as f64, squares.iter().sum::<f64>())
        };
        let (positions, turns) = (of(Channel::Position), of(Channel::Orientation));
        // The share of the spare numbers that is this channel's.
        let spare = |count: f64| result.fit.dof as f64 * count / (positions.0 + turns.0);
        let stick = |stated: Option<f64>, fitted: Option<f64>, (count, squares): (f64, f64)| {
            let (sigma, dof) = match (stated, fitted) {
                (Some(sigma), _) => (sigma, f64::INFINITY),
                (None, Some(sigma)) => (sigma, spare(count).max(1.0)),
                (None, None) => ((squares / spare(count)).sqrt(), spare(count)),
            };
            (sigma.is_finite() && dof >= 1.0).then_some(Yardstick { sigma, dof })
        };
        let least = scene.least_noise();
        let (stated, fitted) = (scene.noise(), result.noise.as_ref());
        Yardsticks {
            position: stick(stated.map(|n| n.position), fitted.map(|n| n.position), positions)
                .map(|stick| stick.at_least(least.position)),
            orientation: stick(
                stated.map(|n| n.orientation),
                fitted.and_then(|n| n.orientation),
                turns,
            )
            .map(|stick| stick.at_least(least.orientation)),
        }
    }

    pub(super) fn of(&self, channel: Channel) -> Option<Yardstick> {
        match channel {
            Channel::Position => self.position,
            Channel::Orientation => self.orientation,
        }
    }
}

impl Yardstick {
    fn at_least(self, least: f64) -> Self {
        Yardstick { sigma: self.sigma.max(least), ..self }
    }
}

/// The poses that lie too far off to be noise, the worst first. Bonferroni's bound over all poses.
pub(super) fn outliers(sides: &[Side], yardsticks: &Yardsticks) -> Vec<Outlier> {
    let mut all = Vec::new();
    for side in sides {
        for pose in &side.poses {
            for (channel, name) in
                [(Channel::Position, "position"), (Channel::Orientation, "orientation")]
            {
                let size = pose.in_channel(channel).map(|vector| vector.norm());
                let Some((size, stick)) = size.zip(yardsticks.of(channel)) else { continue };
                all.push(Outlier {
                    body: side.body.name.clone(),
                    time: pose.time_s,
                    channel: name.to_string(),
                    deviations: size / (stick.sigma * pose.noise_scale),
                });
            }
        }
    }
    let limit = ChiSquared::new(3.0)
        .map_or(f64::INFINITY, |chi2| chi2.inverse_cdf(1.0 - FALSE_ALARM / all.len() as f64));
    let mut far: Vec<Outlier> =
        all.into_iter().filter(|one| one.deviations.powi(2) > limit).collect();
    far.sort_by(|a, b| b.deviations.total_cmp(&a.deviations));
    far
}
