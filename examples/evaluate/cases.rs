//! Full scenes with their truth: simulated, or from a folder.

use std::path::Path;

use smash::files::read_text;
use smash::scene::{Noise, SceneFile};
use smash::simulate::{
    NoiseSpec, RegularSampling, SimulationSpec, add_noise, keep_frames, simulate,
};
use smash::{Error, ErrorKind, Result, Scene};

/// A collision seen in every frame, without noise, and what truly happened.
pub struct Case {
    scene: SceneFile,
    frame_count: u32,
    pub mass_ratio: f64,
    pub restitution: f64,
    pub collision_frame: f64,
}

impl Case {
    /// What an annotator sees: every `interval`-th frame, a gap around the collision, noise.
    pub fn seen(&self, interval: u32, noise: &NoiseSpec, seed: u64) -> Result<Scene> {
        Scene::from_file(add_noise(self.sparse(interval), noise, seed))
    }

    fn sparse(&self, interval: u32) -> SceneFile {
        let sampling = RegularSampling { interval, frame_count: self.frame_count, gap: None };
        let frames = sampling.frame_numbers(self.collision_frame);
        keep_frames(self.scene.clone(), &frames)
    }
}

/// The least standard deviations that any unbiased estimate can have (Cramér and Rao).
#[derive(Debug, Clone, Copy)]
pub struct Bound {
    /// Relative.
    pub mass_ratio: f64,
    pub restitution: f64,
}

impl Case {
    /// The bound for Gaussian noise: the deviations of the refined fit to the true poses, where the
    /// information is the truth's.
    pub fn bound(&self, interval: u32, noise: Noise) -> Option<Bound> {
        let mut exact = self.sparse(interval);
        exact.noise = Some(noise);
        let scene = Scene::from_file(exact).ok()?;
        let result = smash::reconstruct(&scene, &smash::Options::default()).ok()?;
        let mass_ratio = result.mass_ratio?;
        Some(Bound {
            mass_ratio: mass_ratio.std? / mass_ratio.value?,
            restitution: result.restitution.std?,
        })
    }
}

/// The first `count` of smash's own random collisions of two cuboids.
pub fn simulated(count: usize) -> Result<Vec<Case>> {
    (0..count as u64)
        .map(|seed| {
            let mut spec = SimulationSpec::random_cuboids(seed);
            // The paper sub-samples "starting from the collision time": in the middle of the gap.
            spec.collision.time = 0.75;
            let simulation = simulate(&spec)?;
            let truth = simulation.truth;
            let fps = simulation.scene_file.fps.unwrap_or(60.0);
            Ok(Case {
                frame_count: frame_count(&simulation.scene_file),
                scene: simulation.scene_file,
                mass_ratio: truth.mass_ratio.unwrap_or(f64::NAN),
                restitution: truth.restitution,
                collision_frame: truth.collision_time * fps,
            })
        })
        .collect()
}

/// The first `count` of `scene_NN.json` with `truth_NN.json` in `folder`.
pub fn from_folder(folder: &Path, count: usize) -> Result<Vec<Case>> {
    let mut cases = Vec::new();
    for number in 0..count {
        let scene_path = folder.join(format!("scene_{number:02}.json"));
        if !scene_path.exists() {
            break;
        }
        let truth_path = folder.join(format!("truth_{number:02}.json"));
        let truth: serde_json::Value = serde_json::from_str(&read_text(&truth_path)?)
            .map_err(|error| wrong_file(&truth_path, &error.to_string()))?;
        let number_at = |field: &str| {
            let problem = format!("`{field}` isn't a number");
            truth[field].as_f64().ok_or_else(|| wrong_file(&truth_path, &problem))
        };
        let scene: SceneFile = serde_json::from_str(&read_text(&scene_path)?)
            .map_err(|error| wrong_file(&scene_path, &error.to_string()))?;
        let fps = scene.fps.unwrap_or(60.0);
        cases.push(Case {
            frame_count: frame_count(&scene),
            mass_ratio: number_at("mass_ratio")?,
            restitution: number_at("restitution_measured").or(number_at("restitution"))?,
            collision_frame: number_at("collision_time")? * fps,
            scene,
        });
    }
    if cases.is_empty() {
        return Err(Error::new(ErrorKind::Read, "holds no scene_00.json")
            .in_file(folder.display().to_string())
            .mend("name a folder with scene_NN.json and truth_NN.json"));
    }
    Ok(cases)
}

fn wrong_file(path: &Path, problem: &str) -> Error {
    Error::new(ErrorKind::Parse, problem).in_file(path.display().to_string())
}

/// One more than the last observed frame.
fn frame_count(scene: &SceneFile) -> u32 {
    let observations = scene.bodies.iter().flat_map(|body| body.observations.iter().flatten());
    observations.filter_map(|o| o.frame).fold(0.0, f64::max) as u32 + 1
}
