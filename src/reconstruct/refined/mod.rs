//! The refined solver: exact conservation, continuous collision time, residuals over the noise.
//!
//! ```text
//! scene ─► 1 flights ─────────► 2 impulse ────────► 3 everything ──► uncertainty ─► reconstruction
//!          parabolas (closed    jumps between the   χ² over all     covariance of
//!          form, all segments), flights, for each   poses, from     all reported
//!          spins (± turns)      choice of turns     the best starts numbers
//! ```

mod alternatives;
mod covariance;
mod layout;
mod model;
mod noise;
mod optimum;
mod parabolas;
mod profile;
mod quantities;
mod report;
mod robust;
mod significance;
mod solve;
#[cfg(test)]
mod solver_tests;
mod spins;
mod start;
mod uncertainty;

use self::noise::LEAST_NOISE;
use super::{Intervals, Loss, Reconstruction, RefinedOptions};
use crate::scene::Noise;
use crate::{Error, ErrorKind, Result, Scene};

/// Less is rounding; more is no direction.
const LEAST_TILT_RAD: f64 = 1e-9;
const LARGEST_TILT_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Reconstructs the collision in `scene` by the refined solver.
pub(super) fn reconstruct(scene: &Scene, options: &RefinedOptions) -> Result<Reconstruction> {
    if !(LEAST_TILT_RAD..=LARGEST_TILT_RAD).contains(&options.tilt_std_rad) {
        let problem = format!("the tilt's deviation is {} rad", options.tilt_std_rad);
        return Err(Error::new(ErrorKind::Invalid, problem)
            .mend("give an angle from 1e-9 rad to a quarter turn"));
    }
    if options.loss == Loss::Robust && options.intervals == Intervals::Profile {
        let problem = "profile intervals are of least squares, not of the robust loss";
        return Err(Error::new(ErrorKind::Invalid, problem).mend("leave one of the two out"));
    }
    let stated = scene.noise().map(|noise| Noise {
        position: noise.position.max(LEAST_NOISE.position),
        orientation: noise.orientation.max(LEAST_NOISE.orientation),
    });
    let parabolas = parabolas::Parabolas::new(scene);
    let mut refined = model::refined_scene(scene, LEAST_NOISE, options.tilt_std_rad);
    let solved = solve::solve(&mut refined, &parabolas, stated, options.loss)?;
    Ok(report::reconstruction(scene, &refined, &solved, options))
}
