//! Phase 2: which impulse, line of action and mass ratio explain the jumps between the flights of
//! phase 1? From large geometry to the collision's details, and to the start of phase 3.

use nalgebra::{Matrix3, Matrix6, UnitQuaternion, Vector3, Vector6};

use super::model::{any_spin, has_plane};
use super::parabolas::{Kink, Paths, Segment};
use super::spins::{Search, Spin, spins};
use crate::Result;
use crate::bridge::refined::ffi::{
    self, Jump, RefinedBody, RefinedMotion, RefinedPose, RefinedScene, RefinedUnknowns,
};
use crate::reconstruct::solver_error;
use crate::rigid_body::quaternion::to_wxyz;
use crate::scene::{Gap, Noise};

/// Pairs of flights that a body's orientation can't be the same between are dropped beyond this ½ χ².
const HOPELESS: f64 = 50.0;

/// More pairs of a body's flights than these are never looked into.
const MOST_PAIRS: usize = 40;

/// Where phase 3 may start.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    pub(super) gap: Gap,
    pub(super) unknowns: RefinedUnknowns,
    /// ½ χ² by the Gaussian summaries of the flights.
    pub(super) cost: f64,
}

/// A body's two flights, made one at the collision.
struct Pair {
    before: Spin,
    after: Spin,
    /// ½ χ² of both flights, and of their orientations' difference at the collision.
    cost: f64,
    /// The jump in l and its covariance, once the orientations are the same.
    jump: Vector3<f64>,
    covariance: Matrix3<f64>,
}

/// All starts in `segment` that the flights allow, in no order.
pub(super) fn candidates(
    scene: &RefinedScene,
    paths: &impl Paths,
    segment: &Segment,
    noise: Noise,
    search: Search,
) -> Result<Vec<Candidate>> {
    let kinks = paths.kinks(segment);
    let pairs = scene
        .bodies
        .iter()
        .map(|body| body_pairs(body, segment, search))
        .collect::<Result<Vec<Vec<Pair>>>>()?;
    let position_cost = 0.5 * segment.squares_m2 / noise.position.powi(2);
    let mut candidates = Vec::new();
    for choice in combinations(&pairs) {
        let start = start(scene, &kinks, &choice, segment.collision_time_s);
        let jumps: Vec<Jump> = kinks
            .iter()
            .enumerate()
            .map(|(index, kink)| jump(kink, choice[index], noise))
            .collect();
        let fit = ffi::fit_jump(scene, &jumps, &start).map_err(solver_error)?;
        let contact_point = within_reach(scene, &kinks, fit.contact_point.into());
        let mut unknowns = RefinedUnknowns {
            impulse: fit.impulse,
            contact_point: contact_point.into(),
            log_mass_ratio: fit.log_mass_ratio.clamp(-LARGEST_LOG_MASS, LARGEST_LOG_MASS),
            ..start
        };
        let jumps: Vec<[Vector3<f64>; 2]> =
            (0..kinks.len()).map(|index| jump_by_contact(&unknowns, index)).collect();
        settle(&mut unknowns, &kinks, &choice, &jumps);
        let spin_cost: f64 = choice.iter().flatten().map(|pair| pair.cost).sum();
        let cost = position_cost + spin_cost + fit.cost;
        candidates.push(Candidate { gap: segment.gap, unknowns, cost });
    }
    Ok(candidates)
}

/// How a body leaves the collision.
pub(super) struct Leaving {
    pub(super) velocity: Vector3<f64>,
    /// l per unit of its mass.
    pub(super) spin: Vector3<f64>,
}

/// The starts in `segment` by the flights alone, whatever it was that made the jumps between them, the
/// best first; each with how the bodies leave.
pub(super) fn freed_candidates(
    scene: &RefinedScene,
    paths: &impl Paths,
    segment: &Segment,
) -> Result<Vec<(Candidate, Vec<Leaving>)>> {
    let kinks = paths.kinks(segment);
    let pairs = scene
        .bodies
        .iter()
        .map(|body| body_pairs(body, segment, Search::AllAxes))
        .collect::<Result<Vec<Vec<Pair>>>>()?;
    let freed = |choice: Vec<Option<&Pair>>| {
        let mut unknowns = start(scene, &kinks, &choice, segment.collision_time_s);
        let jumps: Vec<[Vector3<f64>; 2]> = kinks
            .iter()
            .zip(&choice)
            .map(|(kink, pair)| {
                let spin = pair.map_or_else(Vector3::zeros, |pair| pair.jump);
                [kink.velocity_after - kink.velocity_before, spin]
            })
            .collect();
        settle(&mut unknowns, &kinks, &choice, &jumps);
        let leaving = unknowns.bodies.iter().zip(&jumps).map(|(body, [velocity, spin])| Leaving {
            velocity: Vector3::from(body.velocity_before) + velocity,
            spin: Vector3::from(body.spin_before) + spin,
        });
        let leaving = leaving.collect();
        let cost = choice.iter().flatten().map(|pair| pair.cost).sum();
        (Candidate { gap: segment.gap, unknowns, cost }, leaving)
    };
    let mut all: Vec<_> = combinations(&pairs).into_iter().map(freed).collect();
    all.sort_by(|(a, _), (b, _)| a.cost.total_cmp(&b.cost));
    Ok(all)
}

/// No start has one body a hundred thousand times as heavy as the other.
const LARGEST_LOG_MASS: f64 = 11.5;

/// Every way to take one of each body's pairs; `None` for a body without spin.
fn combinations(pairs: &[Vec<Pair>]) -> Vec<Vec<Option<&Pair>>> {
    let mut all: Vec<Vec<Option<&Pair>>> = vec![Vec::new()];
    for of_body in pairs {
        let choices: Vec<Option<&Pair>> = match of_body.is_empty() {
            true => vec![None],
            false => of_body.iter().map(Some).collect(),
        };
        all = all
            .iter()
            .flat_map(|chosen| {
                choices.iter().map(move |&choice| {
                    let mut chosen = chosen.clone();
                    chosen.push(choice);
                    chosen
                })
            })
            .collect();
    }
    all
}

/// The pairs of flights that `body` may have made; none where its spin is no unknown.
fn body_pairs(body: &RefinedBody, segment: &Segment, search: Search) -> Result<Vec<Pair>> {
    if !body.has_spin {
        return Ok(Vec::new());
    }
    let oriented: Vec<RefinedPose> =
        body.poses.iter().filter(|pose| pose.has_orientation).copied().collect();
    let middle_s = segment.gap.midpoint_s();
    let split = oriented.partition_point(|pose| pose.time_s < middle_s);
    let outwards: Vec<RefinedPose> = oriented[..split].iter().rev().copied().collect();
    let [befores, afters] =
        spins(body, segment.collision_time_s, &outwards, &oriented[split..], search)?;
    let mut pairs: Vec<Pair> = befores
        .iter()
        .flat_map(|before| afters.iter().map(move |after| pair(*before, *after)))
        .collect();
    pairs.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let least = pairs.first().map_or(0.0, |pair| pair.cost);
    pairs.retain(|pair| pair.cost <= least + HOPELESS);
    pairs.truncate(MOST_PAIRS);
    Ok(pairs)
}

/// Both flights have the same orientation at the collision: the Gaussian condition on their turn.
fn pair(before: Spin, after: Spin) -> Pair {
    let [c, d] = [&before, &after].map(|spin| inverse(&spin.information));
    let both = c + d;
    let difference =
        after.relative_to(&before.world_from_body) - before.relative_to(&before.world_from_body);
    let block = |row, column| both.fixed_view::<3, 3>(row, column).into_owned();
    let of_turn = block(0, 0).try_inverse().unwrap_or_else(Matrix3::zeros);
    let turn: Vector3<f64> = difference.fixed_rows::<3>(0).into_owned();
    let gain = block(3, 0) * of_turn;
    Pair {
        cost: before.cost + after.cost + 0.5 * turn.dot(&(of_turn * turn)),
        jump: difference.fixed_rows::<3>(3) - gain * turn,
        covariance: block(3, 3) - gain * block(0, 3),
        before,
        after,
    }
}

fn inverse(information: &Matrix6<f64>) -> Matrix6<f64> {
    // The weak prior keeps it positive.
    information.try_inverse().unwrap_or_else(Matrix6::identity)
}

fn jump(kink: &Kink, pair: Option<&Pair>, noise: Noise) -> Jump {
    let velocity_weight = Matrix3::identity() / (noise.position * kink.jump_variance.sqrt());
    let spin_weight = pair.map_or_else(Matrix3::zeros, |pair| weight(&pair.covariance));
    Jump {
        position: kink.position.into(),
        velocity: (kink.velocity_after - kink.velocity_before).into(),
        velocity_weight: row_by_row(&velocity_weight),
        spin: pair.map_or_else(Vector3::zeros, |pair| pair.jump).into(),
        spin_weight: row_by_row(&spin_weight),
    }
}

/// W with WᵀW = C⁻¹.
fn weight(covariance: &Matrix3<f64>) -> Matrix3<f64> {
    let symmetric = 0.5 * (covariance + covariance.transpose());
    match symmetric.cholesky().and_then(|c| c.l().try_inverse()) {
        Some(weight) => weight,
        None => Matrix3::zeros(),
    }
}

fn row_by_row(m: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|i| m[(i / 3, i % 3)])
}

/// Impulse and mass ratio from the jumps in velocity, the contact point from those in spin.
fn start(
    scene: &RefinedScene,
    kinks: &[Kink],
    choice: &[Option<&Pair>],
    collision_time_s: f64,
) -> RefinedUnknowns {
    let jumps: Vec<Vector3<f64>> =
        kinks.iter().map(|kink| kink.velocity_after - kink.velocity_before).collect();
    // J = Δv_a = −m Δv_b: m by projection on b's jump.
    let mass_ratio = jumps.get(1).map_or(1.0, |b| {
        let ratio = -jumps[0].dot(b) / b.norm_squared();
        if ratio.is_finite() { ratio.clamp(1e-3, 1e3) } else { 1.0 }
    });
    let impulse = match jumps.get(1) {
        Some(b) => (jumps[0] - mass_ratio * b) / 2.0,
        None if has_plane(scene) => {
            let normal = Vector3::from(scene.plane_normal);
            normal * normal.dot(&jumps[0])
        }
        None => jumps[0],
    };
    let motion = |(kink, pair): (&Kink, &Option<&Pair>)| RefinedMotion {
        position: kink.position.into(),
        velocity_before: kink.velocity_before.into(),
        spin_before: pair.map_or_else(Vector3::zeros, |p| p.before.angular_momentum).into(),
        orientation: to_wxyz(
            &pair.map_or_else(UnitQuaternion::identity, |p| p.before.world_from_body),
        ),
    };
    RefinedUnknowns {
        bodies: kinks.iter().zip(choice).map(motion).collect(),
        collision_time_s,
        tilt: [0.0; 2],
        impulse: impulse.into(),
        contact_point: contact_start(scene, kinks, choice, &impulse, mass_ratio).into(),
        contact_basis: [[0.0; 3]; 2],
        log_mass_ratio: mass_ratio.ln(),
        parameters: Vec::new(),
    }
}

/// The mean over the bodies of p + J × Δk/|J|², the point of the line of action nearest to each:
/// Δk = (x_c − p) × J.
fn contact_start(
    scene: &RefinedScene,
    kinks: &[Kink],
    choice: &[Option<&Pair>],
    impulse: &Vector3<f64>,
    mass_ratio: f64,
) -> Vector3<f64> {
    let centres = kinks.iter().map(|kink| kink.position);
    let middle = centres.sum::<Vector3<f64>>() / kinks.len() as f64;
    let mut points = Vec::new();
    for (index, (kink, pair)) in kinks.iter().zip(choice).enumerate() {
        let Some(pair) = pair else { continue };
        let kick = if index == 0 { *impulse } else { -impulse / mass_ratio };
        let arm = kick.cross(&pair.jump) / kick.norm_squared();
        if arm.iter().all(|x| x.is_finite()) {
            points.push(within_reach(scene, kinks, kink.position + arm));
        }
    }
    if points.is_empty() || !any_spin(scene) {
        return middle;
    }
    let mean = points.iter().sum::<Vector3<f64>>() / points.len() as f64;
    // Along the impulse nothing changes: stay near the bodies.
    let along = impulse.normalize();
    mean + along * along.dot(&(middle - mean))
}

/// The point, or where the way to it from the middle of the bodies leaves their reach: where there
/// is hardly an impulse its line of action may seem to lie anywhere.
fn within_reach(scene: &RefinedScene, kinks: &[Kink], point: Vector3<f64>) -> Vector3<f64> {
    let middle = kinks.iter().map(|kink| kink.position).sum::<Vector3<f64>>() / kinks.len() as f64;
    // A box's half diagonal is √(1.5 trace I) for unit mass; a ball's radius is less.
    let reach_m: f64 = scene
        .bodies
        .iter()
        .map(|body| (1.5 * body.inertia_per_mass.iter().sum::<f64>()).sqrt())
        .zip(kinks)
        .map(|(radius, kink)| 2.0 * radius + (kink.position - middle).norm())
        .sum();
    let way = point - middle;
    if way.norm() > reach_m { middle + way * (reach_m / way.norm()) } else { point }
}

/// What the impulse at the contact does to a body: the jumps in v and l.
fn jump_by_contact(unknowns: &RefinedUnknowns, index: usize) -> [Vector3<f64>; 2] {
    let impulse = Vector3::from(unknowns.impulse);
    let kick = if index == 0 { impulse } else { -impulse * (-unknowns.log_mass_ratio).exp() };
    let centre = Vector3::from(unknowns.bodies[index].position);
    [kick, (Vector3::from(unknowns.contact_point) - centre).cross(&kick)]
}

/// Gives each body the velocity, orientation and spin that fit both of its flights best, now that
/// the jumps in v and l between them are known.
fn settle(
    unknowns: &mut RefinedUnknowns,
    kinks: &[Kink],
    choice: &[Option<&Pair>],
    jumps: &[[Vector3<f64>; 2]],
) {
    for (index, motion) in unknowns.bodies.iter_mut().enumerate() {
        let [kick, jump] = &jumps[index];
        let kink = &kinks[index];
        let velocity = 0.5 * (kink.velocity_before + kink.velocity_after - kick);
        motion.velocity_before = velocity.into();
        let Some(pair) = choice[index] else { continue };
        let base = pair.before.world_from_body;
        let mut after = pair.after.relative_to(&base);
        after -= Vector6::new(0.0, 0.0, 0.0, jump.x, jump.y, jump.z);
        let sum = pair.before.information + pair.after.information;
        let right = pair.before.information * pair.before.relative_to(&base)
            + pair.after.information * after;
        let Some(both) = sum.cholesky().map(|c| c.solve(&right)) else { continue };
        let turn: Vector3<f64> = both.fixed_rows::<3>(0).into_owned();
        let spin: Vector3<f64> = both.fixed_rows::<3>(3).into_owned();
        motion.orientation = to_wxyz(&(UnitQuaternion::new(turn) * base));
        motion.spin_before = spin.into();
    }
}
