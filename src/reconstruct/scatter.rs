//! The scatter of the annotated positions about each flight's own parabola: the noise as far as
//! positions show it, without any law of collision.

use nalgebra::{Matrix2, Vector2, Vector3};

use crate::Scene;
use crate::scene::Observation;

/// Fewer poses of a flight tell too little of the noise.
const LEAST_POSES: usize = 5;

/// One σ of a position coordinate in m, from lines fitted to p − ½ g t² on each side of
/// `collision_time_s`: that of the flight that scatters least, since what scatters more isn't in
/// free flight. `None` where no side has five poses.
pub(super) fn position_scatter_m(scene: &Scene, collision_time_s: f64) -> Option<f64> {
    let gravity = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
    let sides = scene.bodies().iter().flat_map(|body| {
        let split = body.observations.partition_point(|o| o.time_s < collision_time_s);
        let (before, after) = body.observations.split_at(split);
        [before, after]
    });
    let scatters = sides.filter(|side| side.len() >= LEAST_POSES).map(|side| {
        let spare = 3 * (side.len() - 2);
        (squares_about_line(side, &gravity, collision_time_s) / spare as f64).sqrt()
    });
    scatters.min_by(f64::total_cmp)
}

fn squares_about_line(side: &[Observation], gravity: &Vector3<f64>, origin_s: f64) -> f64 {
    let points: Vec<(Vector2<f64>, Vector3<f64>)> = side
        .iter()
        .map(|observation| {
            let t = observation.time_s - origin_s;
            (Vector2::new(1.0, t), observation.position_in_world - 0.5 * t * t * gravity)
        })
        .collect();
    let normal: Matrix2<f64> = points.iter().map(|(row, _)| row * row.transpose()).sum();
    let right: nalgebra::Matrix2x3<f64> = points.iter().map(|(row, y)| row * y.transpose()).sum();
    let Some(inverse) = normal.try_inverse() else { return 0.0 };
    let line = inverse * right;
    points.iter().map(|(row, y)| (y.transpose() - row.transpose() * line).norm_squared()).sum()
}
