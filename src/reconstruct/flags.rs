//! What is doubtful about a reconstruction, and what to do about it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Fit;
use crate::Scene;

/// A doubt, as a word in the result file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Flag {
    /// The mass ratio ended at a bound of the paper's method, 10⁻⁵ or 10 (its sign of failure).
    MassRatioAtBound,
    /// The restitution is not within 0 to 1 (the paper's other sign of failure).
    RestitutionOutOfRange,
    /// The limit on iterations ended the last phase.
    NotConverged,
    /// No body's jump in velocity stands out of the noise: perhaps nothing was hit.
    NoVisibleImpulse,
    /// A body's jump in velocity doesn't stand out of the noise: the mass ratio is at best a bound.
    MassRatioUnidentifiable,
    /// The model misses the poses by more than their noise, or visibly where none is stated.
    PoorFit,
    /// Another solution explains the poses nearly as well.
    SeveralOptima,
}

impl Flag {
    /// The doubt in words.
    pub fn meaning(self) -> &'static str {
        match self {
            Flag::MassRatioAtBound => "the mass ratio ended at its bound: this is a failed fit",
            Flag::RestitutionOutOfRange => {
                "the restitution is not between 0 and 1: the bodies would gain energy or pass \
                 through each other"
            }
            Flag::NotConverged => "the last phase ended before it settled",
            Flag::NoVisibleImpulse => {
                "no jump in velocity stands out of the noise: perhaps nothing was hit"
            }
            Flag::MassRatioUnidentifiable => {
                "a body's jump in velocity doesn't stand out of the noise: the mass ratio is at \
                 best a bound"
            }
            Flag::PoorFit => "the model misses the poses by more than annotations scatter",
            Flag::SeveralOptima => "another solution explains the poses nearly as well",
        }
    }

    /// What the user can do about it.
    pub fn advice(self) -> &'static str {
        match self {
            Flag::MassRatioAtBound | Flag::RestitutionOutOfRange => {
                "check the poses nearest the collision, their times and the sizes; more poses on \
                 each side help most; with `--preset paper` try the other `--segment-by`"
            }
            Flag::NotConverged => "check for poses far off their neighbours",
            Flag::NoVisibleImpulse | Flag::MassRatioUnidentifiable => {
                "film a harder hit, or annotate more poses and longer flights"
            }
            Flag::PoorFit => {
                "check the order of the quaternion's components, `up`, `fps` and the units, then \
                 single poses: `smash compare` shows where the model misses; the paper's method is \
                 also misled by fast spins seen in every frame"
            }
            Flag::SeveralOptima => {
                "annotate poses nearer the collision, or nearer each other where a body spins fast"
            }
        }
    }
}

/// Without a stated noise: an annotator sees a pose that is 0.1 rad off.
const VISIBLE_ANGLE_RAD: f64 = 0.1;
/// Without a stated noise: positions may lie three times as far off as they scatter about the
/// smoothest flight's own parabola, and always by a hundredth of the shortest extent.
const POOR_SCATTERS: f64 = 3.0;
const TOLERATED_SHARE_OF_EXTENT: f64 = 0.01;
/// Without a stated noise, whatever the scatter: an annotator sees a tenth of the extent.
const VISIBLE_SHARE_OF_EXTENT: f64 = 0.1;
/// With a stated noise: residuals of twice the noise. The paper's fixed collision time alone makes
/// them larger than the noise.
const POOR_REDUCED_CHI2: f64 = 4.0;

/// Which bodies' jumps stand out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Push {
    /// At least one body was pushed: there was an impulse.
    pub(super) any: bool,
    /// Every body was pushed: their masses can be compared.
    pub(super) all: bool,
}

/// What may be doubtful, besides the fit itself.
pub(super) struct Doubts {
    /// `None` with a single dynamic body.
    pub(super) mass_ratio: Option<f64>,
    /// Whether the method bounds the mass ratio as the paper does.
    pub(super) is_bounded: bool,
    pub(super) restitution: Option<f64>,
    pub(super) converged: bool,
    pub(super) push: Push,
    /// The noise of positions as far as flights show it.
    pub(super) scatter_m: Option<f64>,
    /// Another solution is nearly as good.
    pub(super) ambiguous: bool,
}

/// The flags that a reconstruction deserves.
pub(super) fn flags(scene: &Scene, fit: &Fit, doubts: &Doubts) -> Vec<Flag> {
    let out_of_range = |c: f64| !(0.0..=1.0).contains(&c);
    [
        (doubts.is_bounded && doubts.mass_ratio.is_some_and(at_bound), Flag::MassRatioAtBound),
        (doubts.restitution.is_some_and(out_of_range), Flag::RestitutionOutOfRange),
        (!doubts.converged, Flag::NotConverged),
        (!doubts.push.any, Flag::NoVisibleImpulse),
        (doubts.mass_ratio.is_some() && !doubts.push.all, Flag::MassRatioUnidentifiable),
        (is_poor(scene, fit, doubts.scatter_m), Flag::PoorFit),
        (doubts.ambiguous, Flag::SeveralOptima),
    ]
    .into_iter()
    .filter_map(|(raised, flag)| raised.then_some(flag))
    .collect()
}

/// At a bound of the paper (section 5.1), or as near as makes no difference.
fn at_bound(mass_ratio: f64) -> bool {
    !(1e-4..=9.999).contains(&mass_ratio)
}

/// Whether the model misses the poses.
fn is_poor(scene: &Scene, fit: &Fit, scatter_m: Option<f64>) -> bool {
    if let Some(reduced) = fit.reduced_chi2 {
        return reduced > POOR_REDUCED_CHI2;
    }
    let extent_m =
        scene.bodies().iter().map(|b| b.shape.shortest_extent_m()).fold(f64::MAX, f64::min);
    let visible_m = VISIBLE_SHARE_OF_EXTENT * extent_m;
    let tolerated_m = scatter_m.map_or(visible_m, |scatter| {
        (POOR_SCATTERS * scatter).max(TOLERATED_SHARE_OF_EXTENT * extent_m).min(visible_m)
    });
    fit.position_rmse > tolerated_m
        || fit.orientation_rmse.is_some_and(|angle| angle > VISIBLE_ANGLE_RAD)
}
