//! A collision to look at: a scene, its results, and what they lack, as one page that needs nothing
//! else.
//!
//! ```text
//! scene ──────────┐
//! results ────────┼─► residuals over time, sampled motion ─► report (data) ─┬─► page (html)
//! diagnosis ──────┤                                         the page's ─────┘
//! ladder ─────────┘                                         script and style
//! ```

mod document;
mod page;

pub use document::{
    BodyView, ModelView, ObservationView, REPORT_SCHEMA, Report, SceneView, Versions,
};
pub use page::{has_page, page, require_page};

use crate::compare::{compare, other_content, series};
use crate::diagnose::Diagnosis;
use crate::improve::Improvement;
use crate::motion::motion;
use crate::{Error, ErrorKind, Reconstruction, Result, Scene};

/// Samples a second of motions: smooth to the eye in slow motion.
const MOTION_RATE_HZ: f64 = 120.0;

/// Puts together what is to be seen of `results`, each with its name, the main one first; `diagnosis`
/// and `improvement` are those of the base model.
///
/// # Errors
/// As [`crate::compare()`], or a result was made from other content than that of `scene`.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scenes/boxes.json")?;
/// let result = smash::reconstruct(&scene, &smash::Options::default())?;
/// let report = smash::report::report(&scene, &[("result".into(), result)], None, None)?;
/// std::fs::write("report.html", smash::report::page(&report)?).unwrap();
/// # Ok::<(), smash::Error>(())
/// ```
pub fn report(
    scene: &Scene,
    results: &[(String, Reconstruction)],
    diagnosis: Option<Diagnosis>,
    improvement: Option<Improvement>,
) -> Result<Report> {
    let report = unchecked(scene, results, diagnosis, improvement)?;
    for ((name, result), model) in results.iter().zip(&report.models) {
        // Its own numbers would stand beside others of the same name.
        if let Some(words) = other_content(scene, result, &model.residuals) {
            return Err(Error::new(ErrorKind::Invalid, words).in_file(name).mend(
                "reconstruct this scene again; `smash compare` tells how a result meets the poses of \
                 an edited scene",
            ));
        }
    }
    Ok(report)
}

/// The same, also where results are made from a part of the poses, or from changed ones.
pub(crate) fn unchecked(
    scene: &Scene,
    results: &[(String, Reconstruction)],
    diagnosis: Option<Diagnosis>,
    improvement: Option<Improvement>,
) -> Result<Report> {
    let comparison = compare(scene, results)?;
    let models = results
        .iter()
        .zip(comparison.results)
        .map(|((name, result), residuals)| {
            Ok(ModelView {
                name: name.clone(),
                is_beyond_chance: result.fit.is_beyond_chance(),
                residuals,
                series: series(scene, result)?,
                motion: motion(scene, result, MOTION_RATE_HZ)?,
                result: result.clone(),
            })
        })
        .collect::<Result<_>>()?;
    Ok(Report {
        schema: REPORT_SCHEMA.to_string(),
        made_with: Versions {
            smash: env!("CARGO_PKG_VERSION").to_string(),
            ceres: crate::ceres_version(),
        },
        commands: Vec::new(),
        scene: SceneView::new(scene),
        noise: comparison.noise,
        models,
        quantities: comparison.quantities,
        warnings: comparison.warnings,
        diagnosis,
        improvement,
    })
}
