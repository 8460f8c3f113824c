//! How far a fitted model is from the poses, and whether it has lost its way.

use super::fitted::Fitted;
use super::noise::{KnownNoise, least_beside, positions, turns};
use crate::scene::Noise;

impl Fitted {
    /// χ², with the tilt's prior.
    pub(crate) fn chi2(&self) -> f64 {
        2.0 * self.best().solution.cost
    }

    /// By how much −2 ln L falls to `larger`, a model that holds this one: χ² where the noise is
    /// stated; else, with each channel's noise at its most likely, Σ ν ln(RSS / RSS of `larger`),
    /// where ν are the numbers that the larger fit leaves spare in the channel (the restricted
    /// likelihood: a channel of which little is spare tells little).
    pub(crate) fn fall_to(&self, larger: &Fitted) -> f64 {
        if self.stated.is_some() {
            return self.chi2() - larger.chi2();
        }
        let [before, after] = [self, larger].map(Fitted::left);
        let of = |before: f64, after: f64, spare: Option<f64>| {
            2.0 * spare.unwrap_or(0.0) * (before / after).ln()
        };
        let KnownNoise { position_dof, orientation_dof, .. } = larger.noise;
        of(before.position, after.position, position_dof)
            + of(before.orientation, after.orientation, orientation_dof)
    }

    /// The root mean square of what is left in each channel, no less than its least noise.
    fn left(&self) -> Noise {
        let solution = &self.best().solution;
        let rms = |(count, squares): (f64, f64)| (squares / count.max(1.0)).sqrt();
        let left = Noise {
            position: rms(positions(&self.refined, solution)),
            orientation: rms(turns(&self.refined, solution)),
        };
        left.at_least(least_beside(&self.refined, left))
    }

    /// What share of the squares of `other`, the same model of poses that are read otherwise, this leaves; each
    /// channel by what this leaves in it. `None` where it leaves more in one.
    pub(crate) fn share_of(&self, other: &Fitted) -> Option<f64> {
        /// What a channel that nothing changed differs by.
        const AS_MUCH: f64 = 0.9;
        let solution = &self.best().solution;
        let [own, other] = [self.left(), other.left()];
        let [position, orientation] =
            [other.position / own.position, other.orientation / own.orientation];
        let squares = positions(&self.refined, solution).0 * position.powi(2)
            + turns(&self.refined, solution).0 * orientation.powi(2);
        (position.min(orientation) > AS_MUCH).then_some(self.numbers() / squares)
    }

    /// How many of the measured numbers the fit used up.
    pub(crate) fn used(&self) -> f64 {
        let solution = &self.best().solution;
        [&solution.position_information, &solution.orientation_information]
            .map(|channel| self.best().used(channel))
            .iter()
            .sum()
    }

    /// How many numbers were measured.
    pub(crate) fn numbers(&self) -> f64 {
        let solution = &self.best().solution;
        positions(&self.refined, solution).0 + turns(&self.refined, solution).0
    }

    /// Whether the poses are missed by so much that slopes foretell little; it shows only where noise is
    /// stated.
    pub(crate) fn is_far_off(&self) -> bool {
        const FAR: f64 = 10.0;
        self.has_stated_noise() && self.chi2() > FAR * self.numbers()
    }

    /// Whether the fit has lost its way: what is missing alone hardly leaves so much. Where the noise isn't
    /// stated only turns tell: a spin that has wrapped is what leads astray.
    pub(crate) fn is_lost(&self) -> bool {
        /// More than an annotator is ever off.
        const LARGE_RAD: f64 = 0.2;
        match self.has_stated_noise() {
            true => self.is_far_off(),
            false => self.noise.value.orientation > LARGE_RAD,
        }
    }

    /// Whether the noise was stated.
    pub(crate) fn has_stated_noise(&self) -> bool {
        self.stated.is_some()
    }
}
