//! Residuals of the model at the observations, and what they add up to.

use nalgebra::Vector3;

use super::super::result::Fit;
use super::internal::InternalScene;
use super::phases::Solved;
use crate::bridge::paper::ffi;
use crate::rigid_body::quaternion::from_wxyz;
use crate::{Result, Scene};

/// Sums of squares over the measured numbers.
#[derive(Default)]
struct SquaredResiduals {
    position_m2: f64,
    position_count: usize,
    orientation_rad2: f64,
    orientation_count: usize,
    /// Over the stated noise, if it is.
    chi2: Option<f64>,
}

/// Compares the model with every pose.
pub(super) fn fit(scene: &Scene, internal: &InternalScene, solved: &Solved) -> Result<Fit> {
    let squares = squared_residuals(scene, internal, solved)?;
    let measured = squares.position_count + squares.orientation_count;
    let dof = measured as i64 - free_parameters(internal) as i64;
    let unmeasured = (squares.orientation_count == 0).then_some("no orientation was fitted");
    let untested = match (scene.noise(), dof) {
        (None, _) => Some("the scene states no noise"),
        (_, ..=0) => Some("there are no more measured numbers than free parameters"),
        _ => None,
    };
    let reasons: Vec<&str> = unmeasured.into_iter().chain(untested).collect();
    Ok(Fit {
        position_rmse: (squares.position_m2 / squares.position_count as f64).sqrt(),
        orientation_rmse: (squares.orientation_count > 0)
            .then(|| (squares.orientation_rad2 / squares.orientation_count as f64).sqrt()),
        chi2: squares.chi2,
        dof,
        reduced_chi2: squares.chi2.filter(|_| dof > 0).map(|chi2| chi2 / dof as f64),
        cost: solved.cost,
        reason: (!reasons.is_empty()).then(|| reasons.join("; ")),
    })
}

fn squared_residuals(
    scene: &Scene,
    internal: &InternalScene,
    solved: &Solved,
) -> Result<SquaredResiduals> {
    let noise = scene.noise();
    let mut squares = SquaredResiduals { chi2: noise.map(|_| 0.0), ..SquaredResiduals::default() };
    for (index, body) in internal.paper.bodies.iter().enumerate() {
        let times: Vec<f64> = body.observations.iter().map(|o| o.time_frames).collect();
        let (paper, unknowns) = (&internal.paper, &solved.unknowns);
        let poses =
            ffi::predict_paper_poses(paper, solved.collision_frames, unknowns, index, &times)
                .map_err(super::solver_error)?;
        let scales = scene.bodies()[index].observations.iter().map(|seen| seen.noise_scale);
        for ((seen, model), scale) in body.observations.iter().zip(&poses).zip(scales) {
            let mut add = |square: f64, sigma: Option<f64>| {
                let whole = squares.chi2.iter_mut().zip(sigma);
                whole.for_each(|(chi2, sigma)| *chi2 += square / (scale * sigma).powi(2));
            };
            let difference = Vector3::from(model.position) - Vector3::from(seen.position);
            add(difference.norm_squared(), noise.map(|noise| noise.position));
            squares.position_m2 += difference.norm_squared();
            squares.position_count += 3;
            if body.has_spin && seen.has_orientation {
                let angle = from_wxyz(seen.orientation).angle_to(&from_wxyz(model.orientation));
                add(angle * angle, noise.map(|noise| noise.orientation));
                squares.orientation_rad2 += angle * angle;
                squares.orientation_count += 3;
            }
        }
    }
    Ok(squares)
}

/// Free parameters of the physical model: of the 47 unknowns, the constraints take away those that
/// follow from others, and the contact point's place along the impulse is none.
fn free_parameters(internal: &InternalScene) -> usize {
    let bodies = &internal.paper.bodies;
    let flights: usize = bodies.iter().map(|body| if body.has_spin { 12 } else { 6 }).sum();
    let line_of_action = if bodies.iter().any(|body| body.has_spin) { 2 } else { 0 };
    let (impulse, tilt, mass_ratio) = (3, 2, bodies.len() - 1);
    flights + impulse + line_of_action + tilt + mass_ratio
}
