//! What is changed of a scene's poses: wrong ones left out, others at another time, other noise.

use schemars::JsonSchema;
use serde::Serialize;

use crate::scene::bounds::SAME_TIME_S;
use crate::scene::values::{check_noise, check_noise_scale};
use crate::scene::{BodyFile, DynamicBody, Noise, ObservationFile};
use crate::words::{counted, did_you_mean, quoted};
use crate::{Error, ErrorKind, Result, Scene};

/// Poses that a variant may change: of more, no person has looked at each.
const MOST_EDITS: usize = 1_000;

/// σ of orientations where there are none: any will do, nothing is divided by it.
const UNMEASURED_NOISE_RAD: f64 = 0.01;

/// How a variant's poses differ from the scene's. Observations are counted in order of time, from 0.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct Edits {
    /// Poses that the fit leaves out.
    pub marked: Vec<Pose>,
    /// Poses that were seen at another time than the scene says.
    pub times: Vec<MovedPose>,
    /// Poses that are as many times as noisy as the others.
    pub noise_scales: Vec<NoisyPose>,
    /// The noise that is stated instead of the scene's; null where it is as in the scene.
    pub noise: Option<Noise>,
}

/// A pose of a scene.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
pub struct Pose {
    /// The body's name.
    pub body: String,
    /// Which of its observations.
    pub observation: usize,
}

/// A pose at another time.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct MovedPose {
    /// The pose.
    #[serde(flatten)]
    pub pose: Pose,
    /// s.
    pub time: f64,
}

/// A pose with a noise of its own.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NoisyPose {
    /// The pose.
    #[serde(flatten)]
    pub pose: Pose,
    /// Its σ over that of the noise.
    pub scale: f64,
}

impl Edits {
    /// Leaves a pose of `scene` out, or takes it in again.
    pub(super) fn mark(&mut self, scene: &Scene, pose: Pose, is_wrong: bool) -> Result<()> {
        body_of(scene, &pose)?;
        self.marked.retain(|other| *other != pose);
        if is_wrong {
            self.marked.push(pose);
            self.marked.sort();
        }
        self.check_size()
    }

    /// Moves a pose of `scene`: between its neighbours, so that the order of all poses stays.
    pub(super) fn move_to(&mut self, scene: &Scene, pose: Pose, time_s: f64) -> Result<()> {
        let body = body_of(scene, &pose)?;
        let at = pose.observation;
        let of = |at: usize| body.observations.get(at).map(|_| self.time_s(body, at));
        let before_s = at.checked_sub(1).and_then(of).unwrap_or(f64::NEG_INFINITY);
        let after_s = of(at + 1).unwrap_or(f64::INFINITY);
        let is_between = time_s - before_s >= SAME_TIME_S && after_s - time_s >= SAME_TIME_S;
        // What has no neighbour on one side may go as far as any scene's times, which are checked.
        if !is_between {
            let problem = format!("{time_s:?} s isn't between the poses before and after");
            let ends = [("after", before_s), ("before", after_s)];
            let ends = ends.iter().filter(|(_, end_s)| end_s.is_finite());
            let ends: Vec<String> = ends.map(|(word, s)| format!("{word} {s} s")).collect();
            return Err(Error::invalid("time", problem)
                .mend(format!("choose a time {}", ends.join(" and "))));
        }
        self.times.retain(|other| other.pose != pose);
        if time_s != body.observations[at].time_s {
            self.times.push(MovedPose { pose, time: time_s });
            self.times.sort_by(|a, b| a.pose.cmp(&b.pose));
        }
        self.check_size()
    }

    /// States how many times as noisy a pose of `scene` is as the others.
    pub(super) fn scale_noise(&mut self, scene: &Scene, pose: Pose, scale: f64) -> Result<()> {
        let body = body_of(scene, &pose)?;
        check_noise_scale("scale", scale)?;
        self.noise_scales.retain(|other| other.pose != pose);
        if scale != body.observations[pose.observation].noise_scale {
            self.noise_scales.push(NoisyPose { pose, scale });
            self.noise_scales.sort_by(|a, b| a.pose.cmp(&b.pose));
        }
        self.check_size()
    }

    /// States other noise; with neither number the scene's own. Where `scene` has no orientations, that
    /// of positions is enough.
    pub(super) fn state_noise(
        &mut self,
        scene: &Scene,
        position: Option<f64>,
        orientation: Option<f64>,
    ) -> Result<()> {
        self.noise = match (position, orientation) {
            (Some(position), Some(orientation)) => Some(Noise { position, orientation }),
            (None, None) => None,
            (Some(position), None) if !scene.has_orientations() => {
                Some(Noise { position, orientation: UNMEASURED_NOISE_RAD })
            }
            (Some(_), None) | (None, Some(_)) => {
                let field = if position.is_none() { "position" } else { "orientation" };
                return Err(Error::invalid(field, "is missing")
                    .mend("give both, or neither for the scene's own noise"));
            }
        };
        self.noise.iter().try_for_each(|noise| check_noise("noise", noise))
    }

    /// What the model is fitted to.
    ///
    /// # Errors
    /// What is left is no scene.
    pub(super) fn fitted_poses(&self, scene: &Scene) -> Result<Scene> {
        self.scene(scene, true)
    }

    /// What residuals are shown of: the poses that are left out, too.
    pub(super) fn all_poses(&self, scene: &Scene) -> Result<Scene> {
        self.scene(scene, false)
    }

    fn scene(&self, scene: &Scene, without_marked: bool) -> Result<Scene> {
        let unmarked = Edits { marked: Vec::new(), ..self.clone() };
        if *self == Edits::default() || (!without_marked && unmarked == Edits::default()) {
            return Ok(scene.clone());
        }
        let mut file = scene.to_file();
        file.noise = self.noise.or(file.noise);
        for BodyFile { name, observations, .. } in &mut file.bodies {
            let Some(observations) = observations else { continue };
            for moved in self.times.iter().filter(|moved| moved.pose.body == *name) {
                observations[moved.pose.observation].time = Some(moved.time);
            }
            for noisy in self.noise_scales.iter().filter(|noisy| noisy.pose.body == *name) {
                observations[noisy.pose.observation].noise_scale = Some(noisy.scale);
            }
            let is_marked = |at: usize| {
                self.marked.iter().any(|pose| pose.body == *name && pose.observation == at)
            };
            let kept = |(at, seen): (usize, ObservationFile)| {
                (!without_marked || !is_marked(at)).then_some(seen)
            };
            *observations =
                std::mem::take(observations).into_iter().enumerate().filter_map(kept).collect();
        }
        Scene::from_file(file)
    }

    /// When a pose is taken to be seen.
    fn time_s(&self, body: &DynamicBody, observation: usize) -> f64 {
        let is_it = |moved: &&MovedPose| {
            moved.pose.body == body.name && moved.pose.observation == observation
        };
        let moved = self.times.iter().find(is_it);
        moved.map_or(body.observations[observation].time_s, |moved| moved.time)
    }

    fn check_size(&self) -> Result<()> {
        let count = self.marked.len() + self.times.len() + self.noise_scales.len();
        if count <= MOST_EDITS {
            return Ok(());
        }
        let problem = format!("{} would be changed", counted(count, "pose"));
        Err(Error::new(ErrorKind::Invalid, problem)
            .mend(format!("change {MOST_EDITS} at most here, and the others in the scene's file")))
    }
}

/// The body of a pose that `scene` has.
fn body_of<'a>(scene: &'a Scene, pose: &Pose) -> Result<&'a DynamicBody> {
    let names: Vec<&str> = scene.bodies().iter().map(|body| body.name.as_str()).collect();
    let Some(body) = scene.bodies().iter().find(|body| body.name == pose.body) else {
        let problem = format!("there is no dynamic body {}", quoted(&pose.body));
        return Err(Error::invalid("body", problem).mend(did_you_mean(&pose.body, &names)));
    };
    let count = body.observations.len();
    if pose.observation >= count {
        let problem = format!("{} is beyond the last", pose.observation);
        return Err(Error::invalid("observation", problem).mend(format!(
            "{} has 0 to {}",
            quoted(&pose.body),
            count - 1
        )));
    }
    Ok(body)
}
