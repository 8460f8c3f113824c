//! Effects of any size, from one that hardly shows to the largest that is sensible.

use std::collections::BTreeMap;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, UnitSphere};
use smash::nalgebra::{Quaternion, UnitQuaternion, Vector3};
use smash::reconstruct::Number;
use smash::rigid_body::principal_inertia_per_mass;
use smash::simulate::{EffectSpec, Simulation, SimulationSpec};

use crate::foreign;

/// An effect but for its size.
pub struct Hidden {
    name: String,
    body: Option<usize>,
    parameters: Parameters,
    /// The largest sensible size; 1 where the size isn't free.
    pub largest: f64,
}

pub type Value = Vec<f64>;
/// Names, values at the null, and what a size of 1 adds to them.
pub type Parameters = Vec<(&'static str, Value, Value)>;

/// Which body an effect acts on, among the dynamic ones; `None` for all together.
pub fn acted_on(name: &str, base: &Simulation, random: &mut ChaCha8Rng) -> Option<usize> {
    let last = base.scene.bodies().len() - 1;
    match name {
        "gravity_scale" | "gravity_tilt" | "friction" | "torsional_impulse" | "coriolis" => None,
        "external_impulse" | "time_offset" | "depth_scale" => Some(last),
        _ => Some(random.random_range(0..=last)),
    }
}

impl Hidden {
    /// A random one on `body` of the scene that is `base` without it.
    pub fn draw(
        name: &str,
        body: Option<usize>,
        base: &Simulation,
        random: &mut ChaCha8Rng,
    ) -> Hidden {
        let seen = &base.scene.bodies()[body.unwrap_or(0)];
        if foreign::LAWS.contains(&name) {
            let centre = base.truth.bodies[body.unwrap_or(0)].position.into();
            let parameters = foreign::parameters(name, centre, random);
            return Hidden { name: foreign::path(name), body, parameters, largest: 50.0 };
        }
        let edges_m = Vector3::from(seen.shape.edges_m());
        let sign = if random.random() { 1.0 } else { -1.0 };
        let (parameters, largest) = match name {
            "linear_drag" => (vec![scalar("k", 0.1)], 10.0),
            "quadratic_drag" => (vec![scalar("k", 0.05)], 10.0),
            "magnus" => (vec![scalar("k", sign * 0.005)], 20.0),
            "constant_force" => {
                let direction = direction(random);
                let across = Vector3::new(direction.x, 0.0, direction.z).normalize();
                (vec![vector("a", 0.2 * across)], 10.0)
            }
            "gravity_scale" => (vec![("s", vec![1.0], vec![sign * 0.02])], 5.0),
            "gravity_tilt" => {
                let towards: f64 = random.random_range(0.0..std::f64::consts::TAU);
                let tilts = vec![
                    scalar("tilt1", 0.05 * towards.cos()),
                    scalar("tilt2", 0.05 * towards.sin()),
                ];
                (tilts, 3.0)
            }
            "spin_drag" => (vec![scalar("kappa", 0.1)], 15.0),
            "inertia" => (vec![("factor", vec![1.0; 3], other_inertia(seen, random))], 3.0),
            "com_offset" => {
                let share = Vector3::from_fn(|_, _| random.random_range(-0.05..0.05));
                (vec![vector("offset", share.component_mul(&edges_m))], 5.0)
            }
            "friction" => (vec![scalar("mu", 0.02)], 15.0),
            "external_impulse" => {
                let impulse = Vector3::from(base.truth.impulse);
                let size_m_s = 0.1 * impulse.norm();
                (vec![vector("P", size_m_s * across(&impulse, random))], 5.0)
            }
            "torsional_impulse" => (vec![scalar("M", sign * 0.002)], 20.0),
            "second_impact" => {
                let impulse = 0.1 * direction(random);
                let lever = 0.4 * direction(random).component_mul(&edges_m);
                let time = fixed("time", &[a_gap_s(base, body.unwrap_or(0), random)]);
                (
                    vec![time, vector("impulse", impulse), vector("spin", lever.cross(&impulse))],
                    10.0,
                )
            }
            "outlier" => {
                let hit = random.random_range(0..seen.observations.len());
                let time = fixed("time", &[seen.observations[hit].time_s]);
                let turn = if random.random() { 0.2 } else { 0.0 } * direction(random);
                (vec![time, vector("shift", 0.05 * direction(random)), vector("turn", turn)], 4.0)
            }
            "time_offset" => {
                let frames = sign * random.random_range(0.5..2.0);
                (vec![scalar("delay", frames / base.scene.fps().unwrap_or(60.0))], 1.0)
            }
            // depth_scale
            _ => (vec![("s", vec![1.0], vec![sign * 0.02])], 5.0),
        };
        Hidden { name: name.into(), body, parameters, largest }
    }

    /// `spec` with the effect so large.
    pub fn put_in(&self, mut spec: SimulationSpec, size: f64) -> SimulationSpec {
        let of = |null: &Value, unit: &Value| -> Value {
            null.iter().zip(unit).map(|(null, unit)| null + size * unit).collect()
        };
        let values = self.parameters.iter().map(|(name, null, unit)| (*name, of(null, unit)));
        let values: BTreeMap<&str, Value> = values.collect();
        // Dynamic bodies come first in all that are drawn.
        let body = self.body.map(|index| &mut spec.bodies[index]);
        let named = body.as_ref().map(|body| body.name.clone());
        if let (Some(body), Some(offset)) = (body, values.get("offset")) {
            // The shape stays where it touches; its centre of mass moves.
            let [w, x, y, z] = body.orientation.unwrap_or([1.0, 0.0, 0.0, 0.0]);
            let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
            let moved = q.transform_vector(&Vector3::from_column_slice(offset));
            body.position = body.position.map(|p| (Vector3::from(p) + moved).into());
        }
        let parameters =
            values.into_iter().map(|(name, value)| (name.to_owned(), Number::from(value)));
        spec.effects.push(EffectSpec {
            name: self.name.clone(),
            body: named,
            parameters: parameters.collect(),
        });
        spec
    }
}

/// A scalar that is so much at a size of 1.
pub fn scalar(name: &'static str, size: f64) -> (&'static str, Value, Value) {
    (name, vec![0.0], vec![size])
}

/// A vector that is so much at a size of 1.
pub fn vector(name: &'static str, v: Vector3<f64>) -> (&'static str, Value, Value) {
    (name, vec![0.0; 3], v.as_slice().to_vec())
}

/// What is there at any size.
pub fn fixed(name: &'static str, value: &[f64]) -> (&'static str, Value, Value) {
    (name, value.to_vec(), vec![0.0; value.len()])
}

pub fn direction(random: &mut ChaCha8Rng) -> Vector3<f64> {
    Vector3::from(UnitSphere.sample(random))
}

/// A direction 60 to 120 degrees off another.
fn across(v: &Vector3<f64>, random: &mut ChaCha8Rng) -> Vector3<f64> {
    loop {
        let drawn = direction(random);
        if drawn.dot(&v.normalize()).abs() < 0.5 {
            return drawn;
        }
    }
}

/// The middle between two poses of a body, not next to the collision nor at the ends.
fn a_gap_s(base: &Simulation, body: usize, random: &mut ChaCha8Rng) -> f64 {
    let stamps: Vec<f64> =
        base.scene.bodies()[body].observations.iter().map(|pose| pose.time_s).collect();
    let after = stamps.iter().filter(|&&stamp_s| stamp_s < base.truth.collision_time).count();
    let gaps = (1..stamps.len() - 2).filter(|gap| (gap + 1).abs_diff(after) > 1);
    let gaps: Vec<usize> = gaps.collect();
    let gap = gaps[random.random_range(0..gaps.len())];
    0.5 * (stamps[gap] + stamps[gap + 1])
}

/// What a size of 1 adds to the factors: up to ± 0.2, such that even three times as much is a body
/// that can be: each principal moment is less than the sum of the others.
fn other_inertia(seen: &smash::scene::DynamicBody, random: &mut ChaCha8Rng) -> Value {
    let solid = principal_inertia_per_mass(&seen.shape);
    loop {
        let unit: Vector3<f64> = Vector3::from_fn(|_, _| random.random_range(-0.2..0.2));
        let can_be = [1.0, 3.0].iter().all(|&size: &f64| {
            let moments = solid.component_mul(&(Vector3::repeat(1.0) + size * unit));
            2.0 * moments.max() < moments.sum()
        });
        if can_be {
            return unit.as_slice().to_vec();
        }
    }
}
