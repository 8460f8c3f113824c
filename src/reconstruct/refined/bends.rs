//! Paths that a further force bends, by their positions alone: a polynomial on each side of the collision.
//! Parabolas would meet elsewhere, and at other velocities.

use nalgebra::{DMatrix, Matrix2, Vector3};

use super::parabolas::{Line, Paths, splits};
use crate::Scene;
use crate::scene::{DynamicBody, Gap, Observation};

/// The largest degree: a flight bends more evenly than that.
const LARGEST_DEGREE: usize = 6;
/// Poses that are worth a degree.
const POSES_A_DEGREE: usize = 2;
/// What keeps coefficients finite that poses close together leave open, beside their information.
const RIDGE: f64 = 1e-9;

/// Both sides of every gap.
pub(super) struct Bends {
    gaps: Vec<Gap>,
    /// By gap, then body.
    paths: Vec<Vec<[Path; 2]>>,
}

impl Bends {
    pub(super) fn new(scene: &Scene) -> Self {
        let gaps = scene.gaps();
        let gravity = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
        let of_body = |body: &DynamicBody| -> Vec<[Path; 2]> {
            let sides = |split: usize| {
                let (before, after) = body.observations.split_at(split);
                [before, after].map(|side| Path::through(side, &gravity))
            };
            splits(body, &gaps).into_iter().map(sides).collect()
        };
        let mut bodies: Vec<_> =
            scene.bodies().iter().map(|body| of_body(body).into_iter()).collect();
        let of_gap = |_: &Gap| bodies.iter_mut().filter_map(Iterator::next).collect();
        let paths = gaps.iter().map(of_gap).collect();
        Bends { gaps, paths }
    }
}

impl Paths for Bends {
    fn gaps(&self) -> &[Gap] {
        &self.gaps
    }

    fn lines(&self, index: usize, time_s: f64) -> Vec<[Line; 2]> {
        let at = |sides: &[Path; 2]| [sides[0].at(time_s), sides[1].at(time_s)];
        self.paths[index].iter().map(at).collect()
    }
}

/// p − ½ g s² as a polynomial in s, the time from the poses' middle over half their span.
struct Path {
    middle_s: f64,
    half_s: f64,
    gravity: Vector3<f64>,
    /// A row for each power.
    coefficients: DMatrix<f64>,
    /// Of the coefficients, per unit variance.
    covariance: DMatrix<f64>,
    squares: f64,
}

impl Path {
    fn through(poses: &[Observation], gravity: &Vector3<f64>) -> Path {
        let [first, last] = [&poses[0], &poses[poses.len() - 1]].map(|pose| pose.time_s);
        let middle_s = 0.5 * (first + last);
        let half_s = 0.5 * (last - first);
        let size = 1 + ((poses.len() - 1) / POSES_A_DEGREE).clamp(1, LARGEST_DEGREE);
        let powers = DMatrix::from_fn(poses.len(), size, |row, power| {
            ((poses[row].time_s - middle_s) / half_s).powi(power as i32) / poses[row].noise_scale
        });
        let straight = DMatrix::from_fn(poses.len(), 3, |row, axis| {
            let pose = &poses[row];
            let fall = 0.5 * (pose.time_s - middle_s).powi(2) * gravity[axis];
            (pose.position_in_world[axis] - fall) / pose.noise_scale
        });
        let normal = powers.tr_mul(&powers) + RIDGE * DMatrix::identity(size, size);
        // With the ridge it is positive.
        let covariance =
            normal.cholesky().map_or_else(|| DMatrix::zeros(size, size), |one| one.inverse());
        let coefficients = &covariance * powers.tr_mul(&straight);
        let squares = (straight - powers * &coefficients).norm_squared();
        Path { middle_s, half_s, gravity: *gravity, coefficients, covariance, squares }
    }

    fn at(&self, time_s: f64) -> Line {
        let (ahead_s, size) = (time_s - self.middle_s, self.coefficients.nrows());
        let s = ahead_s / self.half_s;
        let basis = DMatrix::from_fn(size, 2, |power, derivative| match derivative {
            0 => s.powi(power as i32),
            _ if power == 0 => 0.0,
            _ => power as f64 * s.powi(power as i32 - 1) / self.half_s,
        });
        let told = self.coefficients.tr_mul(&basis);
        let both = basis.tr_mul(&(&self.covariance * &basis));
        let column = |index: usize| Vector3::from_fn(|axis, _| told[(axis, index)]);
        Line {
            position: column(0) + 0.5 * ahead_s * ahead_s * self.gravity,
            velocity: column(1) + ahead_s * self.gravity,
            covariance: Matrix2::from_fn(|i, j| both[(i, j)]),
            squares: self.squares,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two bodies; a quartic bends the one's flight before the collision. Their paths are in the span of the
    /// powers: the kink is where and as it is, to what the search for its time leaves.
    #[test]
    fn bent_flights_meet_at_their_kink() {
        let before = |s: f64| [s + 0.5 * s * s - 0.4 * s.powi(3) + 0.3 * s.powi(4), 2.0 * s, 1.0];
        let after = |s: f64| [-0.5 * s - s * s, 0.3 * s, 1.0 + 0.1 * s];
        let pose = |i: i32, bends: bool| {
            let s = 0.05 * f64::from(i) - 1.03;
            let [x, y, z] = if s < 0.0 { before(s) } else { after(s) };
            let y = y - 4.905 * s * s;
            let x = if bends { x } else { 0.5 * s };
            serde_json::json!({ "time": 0.05 * f64::from(i), "position": [x, y, z] })
        };
        let body = |name: &str, bends: bool| {
            let poses: Vec<_> = (0..40).map(|i| pose(i, bends)).collect();
            serde_json::json!({
                "name": name, "shape": { "type": "sphere", "radius": 0.1 }, "observations": poses
            })
        };
        let scene = serde_json::json!({
            "schema": "smash.scene/1", "bodies": [body("a", true), body("b", false)]
        });
        let bends = Bends::new(&Scene::parse(&scene.to_string(), "bent").unwrap());
        let best = bends.best_segments(1)[0];
        assert!((best.collision_time_s - 1.03).abs() < 1e-5, "{best:?}");
        let kink = bends.kinks(&best)[0];
        let [v, w] = [kink.velocity_before, kink.velocity_after];
        assert!((v - Vector3::new(1.0, 2.0, 0.0)).norm() < 1e-4, "{v:?}");
        assert!((w - Vector3::new(-0.5, 0.3, 0.1)).norm() < 1e-4, "{w:?}");
    }
}
