//! Phase 1, orientations: each flight's rotation by its own poses.
//!
//! The two poses that follow each other fastest alias least; the turn between them, and that turn
//! with a whole one more or less, start a fit that takes in more and more poses. What two poses
//! can't tell apart the collision decides.

use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};

use crate::Result;
use crate::bridge::refined::ffi::{self, RefinedBody, RefinedPose, SpinFlight};
use crate::reconstruct::solver_error;
use crate::rigid_body::quaternion::from_wxyz;

/// No whole turn is added that would make a body spin faster, rad/s: six turns a second.
const FASTEST_ALIAS_RAD_S: f64 = 6.0 * std::f64::consts::TAU;
/// Flights whose ½ χ² is larger than the best one's by so much are out of the question.
const HOPELESS: f64 = 30.0;

/// More rotations of one flight than these are never looked into.
const MOST_SPINS: usize = 32;

/// A flight's orientation and angular momentum l (per unit mass) at the collision.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spin {
    pub(super) world_from_body: UnitQuaternion<f64>,
    pub(super) angular_momentum: Vector3<f64>,
    /// Inverse covariance over (turn in the world, l).
    pub(super) information: Matrix6<f64>,
    /// ½ χ².
    pub(super) cost: f64,
}

impl Spin {
    /// The turn from `base` to this orientation, and l, as one vector.
    pub(super) fn relative_to(&self, base: &UnitQuaternion<f64>) -> Vector6<f64> {
        let turn = (self.world_from_body * base.inverse()).scaled_axis();
        Vector6::new(
            turn.x,
            turn.y,
            turn.z,
            self.angular_momentum.x,
            self.angular_momentum.y,
            self.angular_momentum.z,
        )
    }
}

/// How hard to look for the spins of a flight.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Search {
    /// The turn between two poses, and one whole turn more or less.
    Turns,
    /// And spins about all axes: between sparse poses a tumbling body can do much.
    AllAxes,
}

/// Whether poses of the body that follow each other leave open how it turned between them: by a
/// large part of a turn, or with time enough for a whole one more or less.
pub(super) fn may_turn_otherwise(body: &RefinedBody) -> bool {
    /// In less a tumbling body does nothing that its mean spin doesn't tell.
    const LARGE_RAD: f64 = 0.7;
    let oriented: Vec<&RefinedPose> =
        body.poses.iter().filter(|pose| pose.has_orientation).collect();
    body.has_spin
        && oriented.windows(2).any(|pair| {
            let angle = from_wxyz(pair[0].orientation).angle_to(&from_wxyz(pair[1].orientation));
            let most_rad = FASTEST_ALIAS_RAD_S * (pair[1].time_s - pair[0].time_s);
            angle > LARGE_RAD || most_rad > std::f64::consts::TAU - angle
        })
}

/// The rotations before and after the collision that the body's own poses allow, best first.
/// `before` and `after` hold its oriented poses outwards from the collision.
pub(super) fn spins(
    body: &RefinedBody,
    collision_time_s: f64,
    before: &[RefinedPose],
    after: &[RefinedPose],
    search: Search,
) -> Result<[Vec<Spin>; 2]> {
    let inertia = Vector3::from(body.inertia_per_mass);
    let across: Vec<RefinedPose> =
        before.first().into_iter().chain(after.first()).copied().collect();
    let flight = |poses: &[RefinedPose], other: &[RefinedPose]| -> Result<Vec<Spin>> {
        // Where a side has too few poses, the other's spin is the best guess at this one's, and at
        // last the turn across the collision.
        let mut starts = [poses, other, &across]
            .into_iter()
            .map(|poses| start_spins(&inertia, poses))
            .find(|starts| !starts.is_empty())
            .unwrap_or_default();
        if search == Search::AllAxes {
            starts.extend(spins_about_all_axes(&inertia, poses));
        }
        let poses = if poses.is_empty() { &other[..1] } else { poses };
        let mut spins: Vec<Spin> = Vec::new();
        let mut least = f64::INFINITY;
        for start in &starts {
            let spin = fit(body, collision_time_s, poses, start, least + HOPELESS)?;
            least = least.min(spin.cost);
            if spin.cost < f64::MAX && !spins.iter().any(|known| is_same(known, &spin)) {
                spins.push(spin);
            }
        }
        spins.retain(|spin| spin.cost <= least + HOPELESS);
        spins.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        spins.truncate(MOST_SPINS);
        Ok(spins)
    };
    Ok([flight(before, after)?, flight(after, before)?])
}

/// To a hundredth of the spin: fits end where they end to far less.
fn is_same(a: &Spin, b: &Spin) -> bool {
    let difference = (a.angular_momentum - b.angular_momentum).norm();
    difference <= 0.01 * a.angular_momentum.norm().max(b.angular_momentum.norm())
}

/// l along 26 axes evenly about the sphere (Fibonacci's lattice) at three speeds, up to one and a
/// half turns between the poses that follow each other fastest.
fn spins_about_all_axes(inertia: &Vector3<f64>, poses: &[RefinedPose]) -> Vec<Vector3<f64>> {
    const AXES: usize = 26;
    let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let shortest_s = poses
        .windows(2)
        .map(|pair| (pair[1].time_s - pair[0].time_s).abs())
        .fold(f64::INFINITY, f64::min);
    // A single pose bounds nothing.
    let fastest = match shortest_s.is_finite() {
        true => (1.5 * std::f64::consts::TAU / shortest_s).min(FASTEST_ALIAS_RAD_S),
        false => FASTEST_ALIAS_RAD_S,
    };
    (0..AXES)
        .flat_map(|index| {
            let height = 1.0 - (2 * index + 1) as f64 / AXES as f64;
            let radius = (1.0 - height * height).sqrt();
            let (sine, cosine) = (golden * index as f64).sin_cos();
            let axis = Vector3::new(radius * cosine, height, radius * sine);
            [0.2, 0.5, 0.8].map(|share| inertia.mean() * share * fastest * axis)
        })
        .collect()
}

fn fit(
    body: &RefinedBody,
    collision_time_s: f64,
    poses: &[RefinedPose],
    start: &Vector3<f64>,
    hopeless_cost: f64,
) -> Result<Spin> {
    let flight = SpinFlight {
        inertia_per_mass: body.inertia_per_mass,
        collision_time_s,
        poses: poses.to_vec(),
        spin: (*start).into(),
        hopeless_cost,
    };
    let fit = ffi::fit_spin(&flight).map_err(solver_error)?;
    let inertia = Vector3::from(body.inertia_per_mass);
    Ok(Spin {
        world_from_body: from_wxyz(fit.orientation),
        angular_momentum: fit.spin.into(),
        information: Matrix6::from_row_slice(&fit.information) + weak_prior(&inertia),
        cost: fit.cost,
    })
}

/// What keeps a flight of a single pose finite: any orientation, any spin of some turns a second.
fn weak_prior(inertia: &Vector3<f64>) -> Matrix6<f64> {
    let spin = 1.0 / (FASTEST_ALIAS_RAD_S * inertia.max()).powi(2);
    let turn = 1.0 / std::f64::consts::PI.powi(2);
    Matrix6::from_diagonal(&Vector6::new(turn, turn, turn, spin, spin, spin))
}

/// l from the two poses that follow each other fastest, by the shortest turn and one more either
/// way; none from fewer than two poses.
fn start_spins(inertia: &Vector3<f64>, poses: &[RefinedPose]) -> Vec<Vector3<f64>> {
    let duration = |pair: &&[RefinedPose]| (pair[1].time_s - pair[0].time_s).abs();
    let fastest = poses.windows(2).min_by(|a, b| duration(a).total_cmp(&duration(b)));
    let Some([near, far]) = fastest else { return Vec::new() };
    let duration_s = far.time_s - near.time_s;
    let from = from_wxyz(near.orientation);
    let turn = (from_wxyz(far.orientation) * from.inverse()).scaled_axis();
    let angle = turn.norm();
    // The middle's spin, l = R I Rᵀ ω.
    let spin = |turn: Vector3<f64>| {
        let middle = UnitQuaternion::new(0.5 * turn) * from;
        let omega_in_body = middle.inverse_transform_vector(&(turn / duration_s));
        middle * inertia.component_mul(&omega_in_body)
    };
    let whole = std::f64::consts::TAU;
    let alias = |turns: f64| {
        let other = angle + turns * whole;
        let possible = angle > 0.0 && other.abs() < FASTEST_ALIAS_RAD_S * duration_s.abs();
        possible.then(|| spin(turn * (other / angle)))
    };
    [Some(spin(turn)), alias(-1.0), alias(1.0)].into_iter().flatten().collect()
}
