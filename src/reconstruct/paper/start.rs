//! Start values of the paper's energy (SMASH section 4.1), interpolated across a segment.

use nalgebra::{UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::bridge::paper::ffi::{
    PaperBody, PaperBodyUnknowns, PaperFlight, PaperScene, PaperUnknowns,
};
use crate::rigid_body::quaternion::{from_wxyz, to_wxyz};

/// b₂ in m/frame: upwards.
const VERTICAL_SPEED: f64 = -0.05;
/// b₃ in m/s, before the division by the frame rate.
const HORIZONTAL_SPEED_M_S: f64 = 1.0;
/// β_y0: slightly facing away from the camera in the paper's set-up.
const AZIMUTH_RAD: f64 = 20.0 * std::f64::consts::PI / 180.0;
/// Each component of the impulse is random around this, in kg·m/s.
const IMPULSE: f64 = 0.1;

/// The start for a collision at `collision_frames`. `seed` makes the paper's random impulse.
pub(super) fn start_values(scene: &PaperScene, collision_frames: f64, seed: u64) -> PaperUnknowns {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let bodies: Vec<_> =
        scene.bodies.iter().map(|body| start_body(scene, body, collision_frames)).collect();
    PaperUnknowns {
        contact_point: tied_contact_point(scene, &bodies),
        bodies,
        tilt: [0.0, 0.0],
        impulse: std::array::from_fn(|_| IMPULSE * random.random_range(0.5..1.5)),
        mass_ratio: 1.0,
    }
}

/// Where phase 2 puts the contact point: midway between two centres; below one centre on the
/// plane; or at the centre where no plane is known.
pub(super) fn tied_contact_point(scene: &PaperScene, bodies: &[PaperBodyUnknowns]) -> [f64; 3] {
    let a = Vector3::from(bodies[0].position);
    let point = match bodies.get(1) {
        Some(b) => (a + Vector3::from(b.position)) / 2.0,
        None => {
            let normal = Vector3::from(scene.plane_normal);
            a + (scene.plane_height_m - normal.dot(&a)) * normal
        }
    };
    point.into()
}

fn start_body(scene: &PaperScene, body: &PaperBody, collision_frames: f64) -> PaperBodyUnknowns {
    let (orientation, omega_in_world) = start_rotation(scene, body, collision_frames);
    // k = I(q) ω with the start's mass ratio of 1.
    let inertia = Vector3::from(body.inertia_per_mass);
    let omega_in_body = orientation.inverse_transform_vector(&omega_in_world);
    let angular_momentum = orientation * inertia.component_mul(&omega_in_body);
    let flight = PaperFlight {
        parabola: [VERTICAL_SPEED, HORIZONTAL_SPEED_M_S / scene.frames_per_second, AZIMUTH_RAD],
        angular_momentum: angular_momentum.into(),
    };
    PaperBodyUnknowns {
        position: start_position(body, collision_frames),
        orientation: to_wxyz(&orientation),
        before: flight,
        after: flight,
    }
}

fn start_position(body: &PaperBody, collision_frames: f64) -> [f64; 3] {
    let times: Vec<f64> = body.observations.iter().map(|o| o.time_frames).collect();
    let (first, second) = neighbours(&times, collision_frames);
    let [from, to] = [first, second].map(|i| Vector3::from(body.observations[i].position));
    from.lerp(&to, share(times[first], times[second], collision_frames)).into()
}

/// Slerp across the segment: the orientation at the collision, and its constant angular velocity
/// in rad/s. Without two annotated orientations nothing turns.
fn start_rotation(
    scene: &PaperScene,
    body: &PaperBody,
    collision_frames: f64,
) -> (UnitQuaternion<f64>, Vector3<f64>) {
    let seen: Vec<_> = body.observations.iter().filter(|o| o.has_orientation).collect();
    if !body.has_spin {
        return (UnitQuaternion::identity(), Vector3::zeros());
    }
    let times: Vec<f64> = seen.iter().map(|o| o.time_frames).collect();
    let (first, second) = neighbours(&times, collision_frames);
    let [from, to] = [first, second].map(|i| from_wxyz(seen[i].orientation));
    let turn_in_world = (to * from.inverse()).scaled_axis();
    let share = share(times[first], times[second], collision_frames);
    let orientation = UnitQuaternion::from_scaled_axis(turn_in_world * share) * from;
    let duration_s = (times[second] - times[first]) / scene.frames_per_second;
    (orientation, turn_in_world / duration_s)
}

/// The two of the sorted `times` around `time`, or the nearest two at an end. There are at least
/// two.
fn neighbours(times: &[f64], time: f64) -> (usize, usize) {
    let second = times.partition_point(|&t| t < time).clamp(1, times.len() - 1);
    (second - 1, second)
}

/// Where `time` lies between the two, as a share; held at the ends.
fn share(first: f64, second: f64, time: f64) -> f64 {
    ((time - first) / (second - first)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bridge::paper::ffi::PaperObservation;

    /// A unit cube seen at frames 0 and 10 of 10 a second, a metre along x and a quarter turn
    /// about y on.
    fn scene() -> PaperScene {
        let quarter = std::f64::consts::FRAC_PI_4;
        let seen = |time_frames, x, orientation| PaperObservation {
            time_frames,
            position: [x, 0.0, 0.0],
            orientation,
            has_orientation: true,
        };
        let observations = vec![
            seen(0.0, 0.0, [1.0, 0.0, 0.0, 0.0]),
            seen(10.0, 1.0, [quarter.cos(), 0.0, quarter.sin(), 0.0]),
        ];
        PaperScene {
            frames_per_second: 10.0,
            gravity_m_s2: 9.81,
            bodies: vec![PaperBody {
                inertia_per_mass: [1.0 / 6.0; 3],
                observations,
                has_spin: true,
            }],
            plane_normal: [0.0, -1.0, 0.0],
            plane_height_m: 2.0,
        }
    }

    /// SMASH section 4.1, by hand.
    #[test]
    fn the_start_is_the_papers() {
        let start = start_values(&scene(), 3.0, 0);
        let body = &start.bodies[0];
        let flight = [-0.05, 0.1, 20.0_f64.to_radians()];
        assert_eq!((body.before.parabola, body.after.parabola), (flight, flight));
        assert_eq!(body.before, body.after);
        assert_eq!((start.mass_ratio, start.tilt), (1.0, [0.0, 0.0]));
        // Three tenths of the way, of the turn, and a quarter turn in a second: π/2 rad/s.
        assert!((Vector3::from(body.position) - Vector3::new(0.3, 0.0, 0.0)).norm() < 1e-15);
        let turn = from_wxyz(body.orientation).scaled_axis();
        let quarter_turn = std::f64::consts::FRAC_PI_2;
        assert!((turn - Vector3::new(0.0, 0.3 * quarter_turn, 0.0)).norm() < 1e-15);
        let k = Vector3::from(body.before.angular_momentum);
        assert!((k - Vector3::new(0.0, quarter_turn / 6.0, 0.0)).norm() < 1e-15);
        // The foot on the plane two metres along gravity's opposite.
        assert!((Vector3::from(start.contact_point) - Vector3::new(0.3, -2.0, 0.0)).norm() < 1e-15);
    }

    /// "Random values around 0.1", the same for the same seed.
    #[test]
    fn the_impulse_is_random_around_a_tenth_and_seeded() {
        let impulse = |seed| start_values(&scene(), 3.0, seed).impulse;
        assert_eq!(impulse(5), impulse(5));
        assert_ne!(impulse(5), impulse(6));
        assert!(impulse(5).iter().all(|component| (0.05..0.15).contains(component)));
    }
}
