//! Poses next to the collision that are on no smooth path with the others of their flight: of a contact
//! that lasts, of a body that gives way, or of a tracker that slips where a body turns round. To the model
//! a collision is over in a moment, so what they miss looks like an effect.

use std::fmt;
use std::ops::Range;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::dependence::{CURVE, beside_a_curve, flights};
use super::otherwise::{Cause, Explained, Otherwise};
use crate::reconstruct::refined::Fitted;
use crate::words::{counted, rounded};
use crate::{Result, Scene};

/// Shorter flights don't tell their ends from the rest.
const SHORTEST: usize = 16;
/// One in so many of a flight's poses is next to the collision, and no more.
const NEAREST: usize = 4;
/// How much more the whole flight scatters about a smooth curve than without its end.
const ROUGH: f64 = 2.0;
/// The share of that which the nearer half of an end has.
const NEARER: f64 = 1.0 / 3.0;

/// A time around the collision in which the poses are rougher than before and after it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearCollision {
    /// Time of the first of these poses, s.
    pub from_time: f64,
    /// Time of the last one, s.
    pub to_time: f64,
    /// How many, of all bodies.
    pub poses: usize,
    /// Whether even without them something is left that no effect explains.
    pub leaves_more: bool,
}

impl NearCollision {
    /// Of `scene`, whose best model leaves `fitted`; `None` where all flights are smooth to their ends.
    pub(super) fn of(scene: &Scene, fitted: &Fitted) -> Option<NearCollision> {
        let residuals = &fitted.best().solution.residuals;
        let path = |flight: &Range<usize>| -> Vec<[f64; 3]> {
            residuals[flight.clone()].iter().map(|pose| pose.position_m).collect()
        };
        let mut times_s: Vec<f64> = Vec::new();
        // Two flights a body, the first before the collision.
        for (body, both) in scene.bodies().iter().zip(flights(fitted).chunks(2)) {
            let split = both[0].len();
            let (mut before, after) = (path(&both[0]), path(&both[1]));
            before.reverse();
            let rough = split - rough_end(&before)..split + rough_end(&after);
            times_s.extend(body.observations[rough].iter().map(|pose| pose.time_s));
        }
        let from_time = times_s.iter().copied().reduce(f64::min)?;
        let to_time = times_s.iter().copied().reduce(f64::max)?;
        let found = NearCollision { from_time, to_time, poses: 0, leaves_more: false };
        let seen = scene.bodies().iter().flat_map(|body| &body.observations);
        Some(NearCollision { poses: seen.filter(|pose| found.holds(pose.time_s)).count(), ..found })
    }

    fn holds(&self, time_s: f64) -> bool {
        (self.from_time..=self.to_time).contains(&time_s)
    }

    /// `scene` without these poses.
    pub(super) fn rest(&self, scene: &Scene) -> Scene {
        scene.keeping(|pose| !self.holds(pose.time_s))
    }

    /// What leaves them out of `scene`.
    pub(super) fn cut(&self, scene: &str, output: &str) -> String {
        let (from, to) = (outwards(self.from_time, f64::floor), outwards(self.to_time, f64::ceil));
        format!("smash cut {scene} --from {from} --to {to} -o {output}")
    }

    /// With what `scene` shows without them; `None` where that is as far from an answer: a model that is
    /// bent far has the collision at another time, and ends its flights there.
    pub(super) fn told(
        self,
        scene: &Scene,
        fitted: &Fitted,
        explained: impl FnOnce(&Scene) -> Result<Explained>,
    ) -> Result<Option<Otherwise>> {
        let rest = self.rest(scene);
        // What has no answer isn't asked: it takes long.
        if fitted.is_far_off() && fitted.of(&rest)?.is_far_off() {
            return Ok(None);
        }
        let explained = explained(&rest)?;
        if explained.leaves_more && fitted.is_far_off() {
            return Ok(None);
        }
        let shows = explained.shows();
        Ok(Some(Otherwise {
            words: format!(
                "Or it is the contact: the {self} are on no smooth path with the others, as where a \
                 contact lasts or a tracker slips. Without them {shows}."
            ),
            mend: format!(
                "take the {} out, since to the model a contact is over in a moment, and ask again: {}",
                counted(self.poses, "pose"),
                self.cut("SCENE", "cut.json")
            ),
            missing: explained.missing,
            cause: Cause::NearCollision(NearCollision {
                leaves_more: explained.leaves_more,
                ..self
            }),
        }))
    }
}

impl fmt::Display for NearCollision {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (from, to) = (rounded(self.from_time), rounded(self.to_time));
        write!(out, "{} from {from} to {to} s", counted(self.poses, "pose"))
    }
}

/// A time to be typed, to 10 µs, that holds the pose still.
fn outwards(time_s: f64, rounding: fn(f64) -> f64) -> f64 {
    const PER_S: f64 = 1e5;
    rounding(time_s * PER_S) / PER_S
}

/// How many poses, from the first on, are rougher than the rest.
fn rough_end(path: &[[f64; 3]]) -> usize {
    if path.len() < SHORTEST {
        return 0;
    }
    let most = path.len() / NEAREST;
    let scatters_m: Vec<f64> = (0..=most).map(|count| scatter_m(&path[count..])).collect();
    let least = (0..=most).min_by(|a, b| scatters_m[*a].total_cmp(&scatters_m[*b])).unwrap_or(0);
    let (all, rest) = (scatters_m[0], scatters_m[least]);
    // What isn't quite a smooth curve gains as much at either end.
    let without_the_other = scatter_m(&path[..path.len() - most]);
    // Else a pose is off, or a push comes, farther from the end.
    let is_at_the_end = all - scatters_m[least / 2] > NEARER * (all - rest);
    // A single pose that is off is no contact.
    let is_rough = least > 1 && all.min(without_the_other) > ROUGH * rest;
    if is_rough && is_at_the_end { least } else { 0 }
}

/// About a smooth curve, m.
fn scatter_m(path: &[[f64; 3]]) -> f64 {
    let squares = (0..3).map(|axis| {
        let rest = beside_a_curve(path.iter().map(|position| position[axis]).collect());
        rest.iter().map(|off| off * off).sum::<f64>()
    });
    (squares.sum::<f64>() / (3 * (path.len() - CURVE)) as f64).sqrt()
}
