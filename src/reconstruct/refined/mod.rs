//! The refined solver: exact conservation, continuous collision time, residuals over the noise.
//!
//! ```text
//! scene ─► 1 flights ─────────► 2 impulse ────────► 3 everything ──► uncertainty ─► reconstruction
//!          parabolas (closed    jumps between the   χ² over all     covariance of
//!          form, all segments), flights, for each   poses, from     all reported
//!          spins (± turns)      choice of turns     the best starts numbers
//! ```

pub(crate) mod acting;
mod along_bounds;
mod alternatives;
mod approach;
mod bends;
mod covariance;
mod fitted;
mod flown;
mod found_again;
mod freed;
mod gain;
mod layout;
mod misfit;
pub(crate) mod model;
mod noise;
mod optimum;
mod parabolas;
mod parameters;
mod profile;
mod quantities;
mod report;
mod robust;
mod significance;
mod solve;
mod solved_anew;
#[cfg(test)]
mod solver_tests;
mod spins;
mod start;
mod starts;
mod uncertainty;

pub(crate) use self::acting::{Acting, Instance, instances, possible};
pub(crate) use self::fitted::Fitted;
pub(crate) use self::flown::{FlownPose, flown, model_times};
pub(crate) use self::found_again::Loose;
pub(crate) use self::gain::{Gain, gains, information_of_last, linearised};
pub(crate) use self::optimum::HOPELESS;
pub(crate) use self::report::reconstruction as report;
pub(crate) use self::starts::{points, scanned};

use super::{Intervals, Loss, Reconstruction, RefinedOptions};
use crate::{Error, ErrorKind, Result, Scene};

/// Less is rounding; more is no direction.
const LEAST_TILT_RAD: f64 = 1e-9;
const LARGEST_TILT_RAD: f64 = std::f64::consts::FRAC_PI_2;

/// Reconstructs the collision in `scene` by the refined solver.
pub(super) fn reconstruct(scene: &Scene, options: &RefinedOptions) -> Result<Reconstruction> {
    if options.loss == Loss::Robust && options.intervals == Intervals::Profile {
        let problem = "profile intervals are of least squares, not of the robust loss";
        return Err(Error::new(ErrorKind::Invalid, problem).mend("leave one of the two out"));
    }
    report(scene, &fit(scene, options)?, options.intervals)
}

/// Fits the base model to `scene`, and then effect after effect.
pub(crate) fn fit(scene: &Scene, options: &RefinedOptions) -> Result<Fitted> {
    if !(LEAST_TILT_RAD..=LARGEST_TILT_RAD).contains(&options.tilt_std_rad) {
        let problem = format!("the tilt's deviation is {} rad", options.tilt_std_rad);
        return Err(Error::new(ErrorKind::Invalid, problem)
            .mend("give an angle from 1e-9 rad to a quarter turn"));
    }
    let mut fitted = Fitted::base(scene, options.tilt_std_rad, options.loss)?;
    for request in &options.effects {
        for instance in instances(scene, request)? {
            fitted = fitted.with(scene, &instance)?;
        }
    }
    Ok(fitted)
}
