//! The scene as the refined solver sees it: numbers with their standard deviations.

use nalgebra::Vector3;

use crate::Scene;
use crate::bridge::refined::ffi::{RefinedBody, RefinedPose, RefinedScene};
use crate::rigid_body::principal_inertia_per_mass;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::{DynamicBody, Noise, Observation};

/// Fewer orientations of a body say nothing of its spin.
const LEAST_ORIENTATIONS: usize = 2;

/// The scene in the solver's terms, with one noise for all poses but for their own scales.
pub(crate) fn refined_scene(scene: &Scene, noise: Noise, tilt_std_rad: f64) -> RefinedScene {
    let down = -scene.up_in_world().into_inner();
    let first = across(&down);
    RefinedScene {
        gravity_m_s2: scene.gravity_m_s2(),
        down: down.into(),
        across: [first.into(), down.cross(&first).into()],
        tilt_std_rad,
        bodies: scene.bodies().iter().map(|body| refined_body(body, noise)).collect(),
        plane_normal: scene
            .plane()
            .map_or([0.0; 3], |plane| plane.normal_in_world.into_inner().into()),
        camera: scene.camera().map_or([0.0; 3], |camera| camera.position),
        laws: Vec::new(),
        parameters: Vec::new(),
    }
}

/// Gives all poses another noise, each by its scale.
pub(super) fn set_noise(scene: &mut RefinedScene, noise: Noise) {
    for pose in scene.bodies.iter_mut().flat_map(|body| &mut body.poses) {
        pose.position_std_m = noise.position * pose.noise_scale;
        pose.orientation_std_rad = noise.orientation * pose.noise_scale;
    }
}

/// Whether any body's spin is an unknown.
pub(super) fn any_spin(scene: &RefinedScene) -> bool {
    scene.bodies.iter().any(|body| body.has_spin)
}

pub(super) fn has_plane(scene: &RefinedScene) -> bool {
    scene.plane_normal != [0.0; 3]
}

/// A unit vector across `v`.
pub(crate) fn across(v: &Vector3<f64>) -> Vector3<f64> {
    v.cross(&Vector3::ith(v.iamin(), 1.0)).normalize()
}

fn refined_body(body: &DynamicBody, noise: Noise) -> RefinedBody {
    let poses: Vec<RefinedPose> =
        body.observations.iter().map(|seen| refined_pose(seen, noise)).collect();
    RefinedBody {
        inertia_per_mass: principal_inertia_per_mass(&body.shape).into(),
        has_spin: poses.iter().filter(|pose| pose.has_orientation).count() >= LEAST_ORIENTATIONS,
        size: body.shape.edges_m(),
        poses,
    }
}

fn refined_pose(seen: &Observation, noise: Noise) -> RefinedPose {
    RefinedPose {
        time_s: seen.time_s,
        position: seen.position_in_world.into(),
        position_std_m: noise.position * seen.noise_scale,
        orientation: seen.world_from_body.map_or([1.0, 0.0, 0.0, 0.0], |q| to_wxyz(&q)),
        orientation_std_rad: noise.orientation * seen.noise_scale,
        has_orientation: seen.world_from_body.is_some(),
        noise_scale: seen.noise_scale,
    }
}
