//! Results against the poses that they were made from, and against each other.
//!
//! ```text
//! scene ──┐
//! results ┴─► flights ─► residuals by body, segment, channel ─► random? ─► findings ─┐
//!         ├─► ledger of momentum and energy ─────────────────────────────────────────┤
//!         └─► side by side, with differences in deviations ──────────────────────────┴─► comparison
//! ```

mod axis;
mod channels;
mod comparison;
mod draws;
mod findings;
mod flight;
mod identity;
mod ledger;
mod leverage;
mod plot;
mod randomness;
mod residuals;
mod series;
mod side_by_side;
mod truth;
mod yardstick;

pub use axis::Axis;
pub use channels::{ChannelTest, SignedMiss, channels};
pub use comparison::{
    COMPARISON_SCHEMA, Channel, ChannelResidual, ComparedNoise, Comparison, Difference, Entry,
    LargestMiss, Quantity, ResultResiduals, Segment,
};
pub use findings::findings;
pub(crate) use identity::other_content;
pub use ledger::{Ledger, LedgerEntry, LedgerLine};
pub use plot::{Plot, plots};
pub use randomness::{Pattern, RandomnessTest, TestName};
pub use series::{ResidualPoint, ResidualSeries, series};
pub use truth::{NOT_IN_THE_MODEL, against_truth};

use crate::{Reconstruction, Result, Scene};

/// Compares `results`, each with its name, with the poses of `scene`, and all later ones with the
/// first.
///
/// # Errors
/// A result is of another scene, has effects that the scene can't show, or spins too fast to be
/// followed; the message names it.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let paper = smash::reconstruct(&scene, &smash::Options::paper())?;
/// let refined = smash::reconstruct(&scene, &smash::Options::default())?;
/// let comparison =
///     smash::compare(&scene, &[("paper".to_string(), paper), ("refined".to_string(), refined)])?;
/// println!("{}", comparison.to_json());
/// # Ok::<(), smash::Error>(())
/// ```
pub fn compare(scene: &Scene, results: &[(String, Reconstruction)]) -> Result<Comparison> {
    for (name, result) in results {
        identity::check(scene, result).map_err(|error| error.in_file(name))?;
    }
    let noise = noise(scene, results);
    let told: Vec<ResultResiduals> = results
        .iter()
        .map(|(name, result)| {
            residuals::of(scene, name, result, noise.as_ref()).map_err(|error| error.in_file(name))
        })
        .collect::<Result<_>>()?;
    let doubts = results.iter().zip(&told).filter_map(|((name, result), residuals)| {
        other_content(scene, result, residuals).map(|words| format!("{name} {words}"))
    });
    Ok(Comparison {
        schema: COMPARISON_SCHEMA.to_string(),
        scene: scene.name().to_string(),
        noise,
        warnings: doubts.collect(),
        results: told,
        quantities: side_by_side::quantities(scene, results),
        against_truth: Vec::new(),
    })
}

/// One noise for all results, so that their residuals can be compared: the scene's, or else that of
/// the first result that has one.
fn noise(scene: &Scene, results: &[(String, Reconstruction)]) -> Option<ComparedNoise> {
    let stated = scene.noise().map(|noise| ComparedNoise {
        position: noise.position,
        orientation: Some(noise.orientation),
        from_result: None,
    });
    stated.or_else(|| {
        results.iter().find_map(|(name, result)| {
            result.noise.as_ref().map(|noise| ComparedNoise {
                position: noise.position,
                orientation: noise.orientation,
                from_result: Some(name.clone()),
            })
        })
    })
}
