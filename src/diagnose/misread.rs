//! A scene that is written otherwise than it is read: another `up`, another `fps`, another order of the
//! quaternions' components, or quaternions that map the world to the body. What is wrong there looks like physics.

use nalgebra::{Quaternion, UnitQuaternion, UnitVector3};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::all_candidates;
use super::otherwise::{Cause, Explained, Otherwise};
use crate::effect::EffectRequest;
use crate::reconstruct::refined::{Fitted, Instance};
use crate::scene::{direction_in_words, seen_fps, seen_up};
use crate::{Result, Scene};

/// Read rightly, a scene is missed by less than this share of the squares.
const MUCH_LESS: f64 = 0.1;
/// Of readings that leave no more than so many times what the best one leaves, the simplest is told: a cube's
/// flights hardly tell some apart.
const AS_GOOD: f64 = 1.5;

/// How the scene's fields would have to be read; null where they are as they are read.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Misread {
    /// The direction against gravity.
    pub up: Option<[f64; 3]>,
    /// Frames per second.
    pub fps: Option<f64>,
    /// What the quaternions are.
    pub orientations: Option<Orientations>,
}

/// What quaternions may be that aren't `[w, x, y, z]` and map the body to the world.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Orientations {
    /// `[x, y, z, w]`.
    ScalarLast,
    /// They map the world to the body.
    Inverse,
    /// `[x, y, z, w]` that map the world to the body.
    ScalarLastInverse,
}

impl Orientations {
    const ALL: [Orientations; 3] =
        [Orientations::ScalarLast, Orientations::Inverse, Orientations::ScalarLastInverse];

    /// What was read as `orientation` is this.
    fn read(self, orientation: UnitQuaternion<f64>) -> UnitQuaternion<f64> {
        let scalar_last = || {
            let Quaternion { coords: read } = orientation.into_inner();
            // nalgebra keeps [x, y, z, w]; the file's four were read as w, x, y, z.
            UnitQuaternion::new_unchecked(Quaternion::new(read.z, read.w, read.x, read.y))
        };
        match self {
            Orientations::ScalarLast => scalar_last(),
            Orientations::Inverse => orientation.inverse(),
            Orientations::ScalarLastInverse => scalar_last().inverse(),
        }
    }

    fn in_words(self) -> &'static str {
        match self {
            Orientations::ScalarLast => "quaternions as [x, y, z, w]",
            Orientations::Inverse => "quaternions as maps from the world to the body",
            Orientations::ScalarLastInverse => {
                "quaternions as [x, y, z, w] that map the world to the body"
            }
        }
    }

    fn mend(self) -> &'static str {
        match self {
            Orientations::ScalarLast => "write the quaternions as [w, x, y, z]",
            Orientations::Inverse => {
                "write quaternions that map the body to the world: turn the sign of x, y and z"
            }
            Orientations::ScalarLastInverse => {
                "write the quaternions as [w, -x, -y, -z]: scalar first, from the body to the world"
            }
        }
    }
}

impl Misread {
    /// Of `scene`, whose model leaves `fitted`, with what is missing once it is read rightly, and whether an
    /// effect (`further`: beyond the catalogue) explains as much of it as it is; `None` where it isn't far
    /// off, or no other reading does much better. `explained`: another scene of the same collision.
    ///
    /// # Errors
    /// An effect doesn't fit the scene.
    pub(crate) fn told(
        scene: &Scene,
        fitted: &Fitted,
        further: &[EffectRequest],
        explained: impl FnOnce(&Scene) -> Result<Explained>,
    ) -> Result<Option<(Otherwise, bool)>> {
        let found = Misread::found(scene, fitted);
        let Some((reading, Ok(explained), is_lost)) =
            found.map(|(reading, read, is_lost)| (reading, explained(&read), is_lost))
        else {
            return Ok(None);
        };
        // Lost in one way, a fit may be less lost in another.
        if is_lost && explained.leaves_more {
            return Ok(None);
        }
        let instances = all_candidates(scene, fitted, further)?;
        let does_as_well = |instance: &Instance| {
            let with = fitted.with_at_once(scene, instance);
            let share = |with| explained.fitted.share_of(&with);
            with.is_ok_and(|with| share(with).is_none_or(|share| share * AS_GOOD > 1.0))
        };
        let is_an_effect = instances.par_iter().any(does_as_well);
        Ok(Some((reading.otherwise(explained), is_an_effect)))
    }

    /// The simplest reading of those that do best, if they do much better, with the scene as it is then, and
    /// whether the model's fit is lost even so.
    fn found(scene: &Scene, fitted: &Fitted) -> Option<(Misread, Scene, bool)> {
        let up = seen_up(scene).map(|up| [up.x, up.y, up.z]);
        let falls = Misread { up, fps: seen_fps(scene), orientations: None };
        if !(fitted.is_lost() || falls.is_other()) {
            return None;
        }
        let left = |reading: Misread| {
            let scene = reading.read(scene);
            let read = fitted.of(&scene).ok()?;
            let share = read.share_of(fitted)?;
            (share < MUCH_LESS).then_some((share, reading, scene, read.is_lost()))
        };
        let good: Vec<_> = falls.all(scene).filter_map(left).collect();
        let least = good.iter().map(|(share, ..)| *share).fold(f64::INFINITY, f64::min);
        let (_, reading, scene, is_lost) =
            good.into_iter().find(|(share, ..)| *share < AS_GOOD * least)?;
        Some((reading, scene, is_lost))
    }

    /// Whether anything is read otherwise.
    fn is_other(self) -> bool {
        self.up.is_some() || self.fps.is_some() || self.orientations.is_some()
    }

    /// All other readings with the falls as this says, the simplest first.
    fn all(self, scene: &Scene) -> impl Iterator<Item = Misread> {
        let others = Orientations::ALL.into_iter().filter(|_| scene.has_orientations());
        let turns = std::iter::once(None).chain(others.map(Some));
        let all = turns.map(move |orientations| Misread { orientations, ..self });
        all.filter(|reading| reading.is_other())
    }

    fn read(self, scene: &Scene) -> Scene {
        let mut read = scene.clone();
        if let Some(up) = self.up {
            read = read.with_up(UnitVector3::new_normalize(up.into()));
        }
        if let Some(fps) = self.fps {
            read = read.with_fps(fps);
        }
        if let Some(orientations) = self.orientations {
            read = read.turning(|orientation| orientations.read(orientation));
        }
        read
    }

    fn otherwise(self, explained: Explained) -> Otherwise {
        let up = self.up.map(|up| format!("`up` as {}", direction_in_words(up)));
        let fps = self.fps.map(|fps| format!("`fps` as {fps}"));
        let falls: Vec<String> = up.into_iter().chain(fps).collect();
        let turns = self.orientations;
        let read = falls.iter().cloned().chain(turns.map(|one| one.in_words().to_string()));
        let write = falls.iter().map(|one| format!("give {one}"));
        let write = write.chain(turns.map(|one| one.mend().to_string()));
        let and = |parts: Vec<String>| parts.join(", and ");
        Otherwise {
            words: format!(
                "The scene may be written otherwise than it is read: with {}, {}.",
                and(read.collect()),
                explained.shows()
            ),
            mend: format!("{}, and ask again", and(write.collect())),
            missing: explained.missing,
            cause: Cause::Misread(self),
        }
    }
}
