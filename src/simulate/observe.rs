//! The exact scene: every body's pose whenever it is seen.

use serde_json::json;

use super::check::{Actor, Partner, Setup};
use super::{Motion, NoiseSpec, SimulationSpec};
use crate::rigid_body::LARGEST_TURNING_RAD;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::{BodyFile, ObservationFile, SCENE_SCHEMA, SceneFile};
use crate::{Error, Result};

/// Refuses what would take for ever: a spin of a million turns, seen ten thousand times. All free
/// rotations together may take as long as the longest one.
pub(super) fn check_effort(setup: &Setup, motions: &[Motion]) -> Result<()> {
    let total_rad: f64 = setup
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

pub(super) fn scene_file(spec: &SimulationSpec, setup: &Setup, motions: &[Motion]) -> SceneFile {
    let moving = setup.actors().zip(motions);
    let mut bodies: Vec<(usize, BodyFile)> = moving
        .map(|(actor, motion)| {
            let is_measured = spec.bodies[actor.index].measure_orientation.unwrap_or(true);
            (actor.index, dynamic_body(actor, motion, is_measured))
        })
        .collect();
    if let Partner::Plane(plane) = &setup.partner {
        bodies.push((1 - setup.a.index, BodyFile::from(plane)));
    }
    bodies.sort_by_key(|&(index, _)| index);
    SceneFile {
        schema: SCENE_SCHEMA.into(),
        name: spec.name.clone(),
        fps: spec.fps,
        up: setup.up_in_world.into_inner().into(),
        gravity: spec.gravity,
        noise: None,
        camera: None,
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

fn dynamic_body(actor: &Actor, motion: &Motion, is_orientation_measured: bool) -> BodyFile {
    let observe = |instant: &super::instant::Instant| {
        let body = motion.at(instant.time_s);
        ObservationFile {
            frame: instant.frame,
            time: if instant.frame.is_none() { Some(instant.time_s) } else { None },
            position: body.position_in_world.into(),
            orientation: is_orientation_measured.then(|| to_wxyz(&body.world_from_body)),
        }
    };
    BodyFile {
        name: actor.name.clone(),
        shape: Some(actor.shape),
        observations: Some(actor.instants.iter().map(observe).collect()),
        ..BodyFile::default()
    }
}
