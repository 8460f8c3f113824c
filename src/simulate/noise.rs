//! The noise of annotations, seeded.

use nalgebra::{UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};
use crate::scene::{Noise, ObservationFile, SceneFile};

/// How observed poses differ from the true ones.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum NoiseSpec {
    /// Not at all.
    #[default]
    None,
    /// Normal deviates, one σ of each position coordinate and of each component of the rotation
    /// vector q⁻¹ q_observed; the scene then states this noise.
    Gaussian(Noise),
    /// The paper's (section 5.1): each position coordinate and each quaternion component times
    /// 1 ± this fraction, uniformly; the quaternion is then normalised. It grows with the distance
    /// from the origin.
    Uniform(#[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1))] f64),
}

/// The same scene with `noise` on every observation; with Gaussian noise it also states it.
///
/// Each body draws from a stream of its own (ChaCha8 with this `seed`; the stream's number is the
/// body's index), observation by observation in the file's order: x, y, z, then the orientation's
/// components. So the result depends on nothing but scene, noise and seed.
#[must_use]
pub fn add_noise(mut scene_file: SceneFile, noise: &NoiseSpec, seed: u64) -> SceneFile {
    if let NoiseSpec::Gaussian(sigma) = noise {
        scene_file.noise = Some(*sigma);
    }
    for (index, body) in scene_file.bodies.iter_mut().enumerate() {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(index as u64);
        for observation in body.observations.iter_mut().flatten() {
            match noise {
                NoiseSpec::None => {}
                NoiseSpec::Gaussian(sigma) => add_gaussian(observation, sigma, &mut random),
                NoiseSpec::Uniform(fraction) => add_uniform(observation, *fraction, &mut random),
            }
        }
    }
    scene_file
}

fn add_gaussian(observation: &mut ObservationFile, sigma: &Noise, random: &mut ChaCha8Rng) {
    let mut deviate = |sigma: f64| -> f64 {
        let unit: f64 = StandardNormal.sample(random);
        sigma * unit
    };
    for coordinate in &mut observation.position {
        *coordinate += deviate(sigma.position);
    }
    if let Some(orientation) = &mut observation.orientation {
        let turn = Vector3::from_fn(|_, _| deviate(sigma.orientation));
        *orientation = to_wxyz(&(from_wxyz(*orientation) * UnitQuaternion::new(turn)));
    }
}

fn add_uniform(observation: &mut ObservationFile, fraction: f64, random: &mut ChaCha8Rng) {
    let mut factor = || 1.0 + fraction * random.random_range(-1.0..=1.0);
    for coordinate in &mut observation.position {
        *coordinate *= factor();
    }
    if let Some(orientation) = &mut observation.orientation {
        let scaled = orientation.map(|component| component * factor());
        let length = scaled.iter().map(|component| component * component).sum::<f64>().sqrt();
        *orientation = scaled.map(|component| component / length);
    }
}
