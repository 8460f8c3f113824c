//! The exact scene: every body's pose whenever it is seen.

use serde_json::json;

use super::check::{Actor, Partner, Stage};
use super::{Motion, NoiseSpec, SimulationSpec};
use crate::rigid_body::LARGEST_TURNING_RAD;
use crate::scene::{BodyFile, ObservationFile, SCENE_SCHEMA, SceneFile};
use crate::{Error, Result};

/// Where a body is seen, and its quaternion [w, x, y, z].
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    pub position: [f64; 3],
    pub orientation: [f64; 4],
}

/// Refuses what would take for ever: a spin of a million turns, seen ten thousand times. All free
/// rotations together may take as long as the longest one.
pub(super) fn check_effort(stage: &Stage, motions: &[Motion]) -> Result<()> {
    let total_rad: f64 = stage
        .actors()
        .zip(motions)
        .flat_map(|(actor, motion)| {
            actor.instants.iter().map(|instant| motion.integrated_angle_rad(instant.time_s))
        })
        .sum();
    if total_rad <= LARGEST_TURNING_RAD {
        return Ok(());
    }
    let problem =
        format!("turn too fast for too long: {total_rad:.3e} rad between collision and poses");
    Err(Error::invalid("bodies", problem).mend(format!(
        "keep it below {LARGEST_TURNING_RAD:.0e} rad: angular velocities are in rad/s, sizes \
         in m"
    )))
}

/// The scene in which the dynamic bodies, a first, are `seen` so.
pub(super) fn scene_file(spec: &SimulationSpec, stage: &Stage, seen: &[Vec<Pose>]) -> SceneFile {
    let mut bodies: Vec<(usize, BodyFile)> = stage
        .actors()
        .zip(seen)
        .map(|(actor, poses)| {
            let is_measured = spec.bodies[actor.index].measure_orientation.unwrap_or(true);
            (actor.index, dynamic_body(actor, poses, is_measured))
        })
        .collect();
    if let Partner::Plane(plane) = &stage.partner {
        bodies.push((1 - stage.a.index, BodyFile::from(plane)));
    }
    bodies.sort_by_key(|&(index, _)| index);
    SceneFile {
        schema: SCENE_SCHEMA.into(),
        name: spec.name.clone(),
        fps: spec.fps,
        up: stage.up_in_world.into_inner().into(),
        gravity: spec.gravity,
        noise: None,
        camera: spec.camera.clone(),
        source: Some(source(spec)),
        bodies: bodies.into_iter().map(|(_, body)| body).collect(),
    }
}

/// Where the scene is from, for people.
fn source(spec: &SimulationSpec) -> serde_json::Map<String, serde_json::Value> {
    let mut source = serde_json::Map::new();
    source.insert("made_by".into(), json!("smash simulate"));
    if spec.noise != NoiseSpec::None {
        source.insert("noise".into(), json!(spec.noise));
        source.insert("seed".into(), json!(spec.seed));
    }
    source
}

fn dynamic_body(actor: &Actor, poses: &[Pose], is_orientation_measured: bool) -> BodyFile {
    let observations = actor.instants.iter().zip(poses).map(|(instant, pose)| ObservationFile {
        frame: instant.frame,
        time: if instant.frame.is_none() { Some(instant.time_s) } else { None },
        position: pose.position,
        orientation: is_orientation_measured.then_some(pose.orientation),
        noise_scale: None,
    });
    BodyFile {
        name: actor.name.clone(),
        shape: Some(actor.shape),
        observations: Some(observations.collect()),
        ..BodyFile::default()
    }
}
