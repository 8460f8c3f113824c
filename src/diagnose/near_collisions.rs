//! As [`super::near_collision`], of several throws: each has poses of its own that are on no smooth path.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::near_collision::NearCollision;
use super::otherwise::{Cause, Otherwise, shows};
use super::pooled::Throw;
use crate::{Result, Scene};

/// Times around the collisions in which the poses of throws are rougher than before and after them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearCollisions {
    /// Of each throw that has such poses.
    pub throws: Vec<RoughThrow>,
    /// Whether even without them something is left that no effect explains.
    pub leaves_more: bool,
}

/// A throw whose poses are rough around its collision.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoughThrow {
    /// The scene's name.
    pub scene: String,
    /// Time of the first of these poses, s.
    pub from_time: f64,
    /// Time of the last one, s.
    pub to_time: f64,
    /// How many, of all bodies.
    pub poses: usize,
}

/// Throws as their best model explains them together.
pub(crate) struct ExplainedThrows {
    /// The effects that their model lacked, by label.
    pub(crate) missing: Vec<String>,
    /// Their sizes, in sentences.
    pub(crate) words: String,
    /// Whether that leaves something that no effect explains.
    pub(crate) leaves_more: bool,
}

impl NearCollisions {
    /// Of `throws`, whose best model leaves more than noise; `None` where all flights are smooth to their
    /// ends, or where nothing has an answer without them. `explained`: other scenes of the same throws.
    pub(crate) fn told(
        throws: &[Throw],
        explained: impl FnOnce(&[Scene]) -> Result<ExplainedThrows>,
    ) -> Result<Option<Otherwise>> {
        let near: Vec<Option<NearCollision>> =
            throws.iter().map(|throw| NearCollision::of(throw.scene, &throw.fitted)).collect();
        let both = || throws.iter().map(|throw| throw.scene).zip(&near);
        let rest: Vec<Scene> = both()
            .map(|(scene, near)| near.as_ref().map_or(scene.clone(), |near| near.rest(scene)))
            .collect();
        let rough: Vec<(usize, &Scene, &NearCollision)> = both()
            .enumerate()
            .filter_map(|(index, (scene, near))| Some((index + 1, scene, near.as_ref()?)))
            .collect();
        if rough.is_empty() {
            return Ok(None);
        }
        let explained = explained(&rest)?;
        if explained.leaves_more && throws.iter().any(|throw| throw.fitted.is_far_off()) {
            return Ok(None);
        }
        let poses = rough.iter().map(|(_, scene, near)| format!("the {near} of {}", scene.name()));
        let cut = |(number, _, near): &(usize, &Scene, &NearCollision)| {
            near.cut(&format!("SCENE_{number}"), &format!("cut_{number}.json"))
        };
        let cuts: Vec<String> = rough.iter().map(cut).collect();
        let of_each = |(_, scene, near): &(usize, &Scene, &NearCollision)| RoughThrow {
            scene: scene.name().to_string(),
            from_time: near.from_time,
            to_time: near.to_time,
            poses: near.poses,
        };
        Ok(Some(Otherwise {
            words: format!(
                "Or it is the contact: {} are on no smooth path with the others, as where a contact \
                 lasts or a tracker slips. Without them {}{}",
                poses.collect::<Vec<_>>().join(" and "),
                shows(&explained.missing, explained.leaves_more),
                match explained.words.as_str() {
                    "" => ".".to_string(),
                    words => format!(": {words}"),
                }
            ),
            mend: format!(
                "take these poses out, since to the model a contact is over in a moment, and ask again \
                 of what is left: {}",
                cuts.join(" && ")
            ),
            missing: explained.missing,
            cause: Cause::NearCollisions(NearCollisions {
                throws: rough.iter().map(of_each).collect(),
                leaves_more: explained.leaves_more,
            }),
        }))
    }
}
