//! The film that one plans: what happens in it, how often and how exactly it is seen.

use crate::reconstruct::RefinedOptions;
use crate::reconstruct::refined::{self, Fitted};
use crate::scene::bounds::LEAST_POSES;
use crate::scene::{Noise, Scene};
use crate::simulate::{
    EffectSpec, NoiseSpec, Sampling, SimulationSpec, Truth, simulate, with_effects,
};
use crate::{Error, Result};

/// A film with stated noise, in which noise itself isn't drawn.
#[derive(Debug, Clone)]
pub(super) struct Film {
    spec: SimulationSpec,
    noise: Noise,
    /// The model that it is reconstructed with: the specification's effects are known to act.
    model: RefinedOptions,
}

/// What the film shows without noise, and what the model makes of it.
pub(super) struct Shown {
    pub scene: Scene,
    pub truth: Truth,
    pub fitted: Fitted,
}

impl Film {
    /// The film of `spec`.
    ///
    /// # Errors
    /// `spec` states no Gaussian noise, or an effect that isn't one.
    pub fn new(spec: &SimulationSpec) -> Result<Film> {
        let NoiseSpec::Gaussian(noise) = spec.noise else {
            let mend = "write `\"noise\": {\"gaussian\": {\"position\": 0.002, \"orientation\": \
                        0.01}}` (m, rad), or give --noise-position and --noise-orientation";
            let problem = "isn't Gaussian: how exact the annotations are decides what can be found";
            return Err(Error::invalid("noise", problem).mend(mend));
        };
        // A faulty specification is told as it stands.
        simulate(spec)?;
        let known = spec.effects.iter().map(EffectSpec::unknown).collect::<Result<_>>()?;
        let model = RefinedOptions { effects: known, ..RefinedOptions::default() };
        Ok(Film { spec: SimulationSpec { noise: NoiseSpec::None, ..spec.clone() }, noise, model })
    }

    /// The noise that it states.
    pub fn noise(&self) -> Noise {
        self.noise
    }

    /// What acts in it beside the effect that is sought.
    pub fn known_effects(&self) -> &[EffectSpec] {
        &self.spec.effects
    }

    /// The scene without any further effect.
    pub fn scene(&self) -> Result<Scene> {
        Ok(self.exact(&self.spec)?.0)
    }

    /// The scene with `effect`, and the model, which lacks it, fitted.
    pub fn shown(&self, effect: &EffectSpec) -> Result<Shown> {
        let mut effects = self.spec.effects.clone();
        effects.push(effect.clone());
        let (scene, truth) = self.exact(&with_effects(&self.spec, effects)?)?;
        let fitted = refined::fit(&scene, &self.model)?;
        Ok(Shown { scene, truth, fitted })
    }

    fn exact(&self, spec: &SimulationSpec) -> Result<(Scene, Truth)> {
        let simulation = simulate(spec)?;
        let mut file = simulation.scene_file;
        file.noise = Some(self.noise);
        Ok((Scene::from_file(file)?, simulation.truth))
    }

    /// The same with the noise so many times as large.
    pub fn with_noise(&self, factor: f64) -> Film {
        let Noise { position, orientation } = self.noise;
        let noise = Noise { position: factor * position, orientation: factor * orientation };
        Film { noise, ..self.clone() }
    }

    /// The same with so many times the intervals between the frames of each body, from its first
    /// frame to the last one before the collision, and from the first one after it to the last.
    ///
    /// # Errors
    /// Too few frames are left.
    pub fn with_frames(&self, factor: f64) -> Result<Film> {
        let collision_s = self.spec.collision.time;
        let mut film = self.clone();
        for body in self.scene()?.bodies() {
            let times: Vec<f64> = body.observations.iter().map(|seen| seen.time_s).collect();
            let (before, after) = times.split_at(times.partition_point(|t| *t < collision_s));
            let times = [resampled(before, factor), resampled(after, factor)];
            if times.iter().any(|side| side.len() < LEAST_POSES) {
                let problem = "too few frames are left on one side of the collision";
                return Err(Error::invalid("observations", problem).mend("film more of them"));
            }
            let named = |other: &&mut crate::simulate::BodySpec| other.name == body.name;
            if let Some(planned) = film.spec.bodies.iter_mut().find(named) {
                planned.observations = Some(Sampling::Times(times.concat()));
            }
        }
        Ok(film)
    }
}

/// The first and the last of `times`, and evenly by number between them, so that a finer one holds
/// all of a coarser one.
fn resampled(times: &[f64], factor: f64) -> Vec<f64> {
    let intervals = times.len().saturating_sub(1);
    let wanted = (factor * intervals as f64).floor() as usize;
    if wanted == 0 {
        return times.iter().take(1).copied().collect();
    }
    let at = |index: usize| {
        let place = index as f64 * intervals as f64 / wanted as f64;
        let known = (place.floor() as usize).min(intervals);
        let next = times[(known + 1).min(intervals)];
        let part = place - known as f64;
        // What is a frame stays that frame to the last bit.
        if part == 0.0 { times[known] } else { times[known] + part * (next - times[known]) }
    };
    (0..=wanted).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::resampled;

    #[test]
    fn finer_frames_hold_the_coarser_ones() {
        let times = [0.0, 0.1, 0.25, 0.3, 0.7];
        assert_eq!(resampled(&times, 0.5), [0.0, 0.25, 0.7]);
        assert_eq!(resampled(&times, 1.0), times);
        let double = resampled(&times, 2.0);
        assert_eq!(double.len(), 9);
        assert!(times.iter().all(|time| double.contains(time)));
        assert!(double.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(resampled(&times[..2], 0.5), [0.0]);
    }
}
