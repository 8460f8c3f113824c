//! Neighbouring poses that share their errors, as after a tracker or a spline that smooths: what is left
//! comes in waves then, as beside a force that is missing.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::dependence::{flights, waves};
use super::otherwise::{Cause, Explained, Otherwise};
use crate::reconstruct::refined::Fitted;
use crate::{Result, Scene};

/// Correlation length of what is left beside smooth curves: of independent errors it is less than 1.1, of
/// errors that share four fifths with each neighbour more than this from 30 poses a flight on.
pub(super) const WAVES: f64 = 1.25;
/// Fewer poses of a flight show next to nothing.
const LEAST_LEFT: usize = 5;

/// Poses so far apart that their errors hardly know of each other, where those show no more than noise.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SharedErrors {
    /// How many neighbours say the same: 1 + 2 Σ ρ over the residuals' correlations ρ.
    pub correlation_length: f64,
    /// Every so manieth pose was kept, outwards from the collision.
    pub every: usize,
}

impl SharedErrors {
    /// Of `scene`, whose best model leaves `fitted`; `None` where too few poses would be left, or those
    /// show something, too, that no effect explains.
    pub(super) fn told(
        scene: &Scene,
        fitted: &Fitted,
        explained: impl FnOnce(&Scene) -> Result<Explained>,
    ) -> Result<Option<Otherwise>> {
        let flights = flights(fitted).into_iter().map(|flight| flight.len());
        let shortest = flights.filter(|poses| *poses > 0).min().unwrap_or(0);
        let correlation_length = waves(fitted);
        let every = (correlation_length.ceil() as usize).max(2);
        if every * LEAST_LEFT > shortest {
            return Ok(None);
        }
        let thinned = scene.thinned(every, fitted.collision_time_s());
        let Explained { missing, leaves_more: false, .. } = explained(&thinned)? else {
            return Ok(None);
        };
        let but = match missing.as_slice() {
            [] => String::new(),
            labels => format!(" but {}", labels.join(" and ")),
        };
        Ok(Some(Otherwise {
            words: format!(
                "Or neighbouring poses share their errors, as after a tracker or a spline that smooths: \
                 one pose in {every}, taken alone, shows nothing missing{but}. A weak force would hide \
                 there, too."
            ),
            mend: format!(
                "if the poses come from a tracker or a spline that smooths, keep one in {every} of them: \
                 what their errors share is taken for physics"
            ),
            missing,
            cause: Cause::SharedErrors(SharedErrors { correlation_length, every }),
        }))
    }
}
