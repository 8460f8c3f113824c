//! What no annotation is more exact than.

use super::{Noise, Scene};

impl Scene {
    /// The least noise that its poses are taken to have.
    pub(crate) fn least_noise(&self) -> Noise {
        Noise::least(self.bodies().iter().map(|body| body.shape.edges_m()))
    }
}

impl Noise {
    /// What no annotation of bodies with these edges is more exact than, whatever it says or its
    /// residuals are: what is smaller is the rounding of the poses and of the integrator (up to 1e-7
    /// rad in a turn of ten rad), and a model that explained it would explain nothing.
    pub(crate) fn least(edges_m: impl Iterator<Item = [f64; 3]>) -> Noise {
        /// Of the smallest body's longest edge: a micrometre a metre.
        const OF_SIZE: f64 = 1e-6;
        const TURN_RAD: f64 = 1e-6;
        Noise { position: OF_SIZE * smallest_m(edges_m), orientation: TURN_RAD }
    }

    /// Each channel, but no less than `least`.
    pub(crate) fn at_least(self, least: Noise) -> Noise {
        Noise {
            position: self.position.max(least.position),
            orientation: self.orientation.max(least.orientation),
        }
    }
}

/// The smallest body's longest edge.
pub(crate) fn smallest_m(edges_m: impl Iterator<Item = [f64; 3]>) -> f64 {
    edges_m.map(|edges| edges.into_iter().fold(0.0, f64::max)).fold(f64::INFINITY, f64::min)
}
