//! What no effect explains, described: a free force and a free torque on each body, fitted as smooth
//! functions of time on either side of the collision, and what they go with.

use nalgebra::{DMatrix, DVector, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::bridge::refined::ffi::fly;
use crate::effect::Effect;
use crate::reconstruct::refined::{Fitted, possible};
use crate::reconstruct::solver_error;
use crate::{Result, Scene};

/// An acceleration or a torque that the model lacks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Unexplained {
    /// The body that it acts on.
    pub body: String,
    /// `acceleration` in m/s², or `torque` per unit of the body's mass in m²/s².
    pub kind: Kind,
    /// By how much χ² falls with it; as improbable, where the noise is estimated.
    pub delta_chi2: f64,
    /// Its root mean square over the poses.
    pub rms: f64,
    /// Its mean over the poses, in the world.
    pub mean: [f64; 3],
    /// How much of its square each simple form explains, the most first.
    pub forms: Vec<Form>,
}

/// What acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// On the path.
    Acceleration,
    /// On the rotation.
    Torque,
}

/// A simple law that has the shape of what is unexplained.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Form {
    /// In words.
    pub goes_with: String,
    /// As a line of an effect file's `[law]`.
    pub law: String,
    /// The share of the square that it explains, 0 to 1.
    pub share: f64,
    /// Its factor, in SI units.
    pub factor: f64,
}

const FREE_ACCELERATION: &str = r#"
name = "free_acceleration"
title = "Any smooth acceleration on either side of the collision"
scope = "body"
[parameters.b0]
unit = "m/s^2"
null = [0.0, 0.0, 0.0]
[parameters.b1]
unit = "m/s^3"
null = [0.0, 0.0, 0.0]
[parameters.c0]
unit = "m/s^2"
null = [0.0, 0.0, 0.0]
[parameters.c1]
unit = "m/s^3"
null = [0.0, 0.0, 0.0]
[law]
acceleration = "step(t_c - t) * (b0 + (t - t_c) * b1) + step(t - t_c) * (c0 + (t - t_c) * c1)"
"#;

const FREE_TORQUE: &str = r#"
name = "free_torque"
title = "Any smooth torque on either side of the collision"
scope = "body"
[parameters.b0]
unit = "m^2/s^2"
null = [0.0, 0.0, 0.0]
[parameters.c0]
unit = "m^2/s^2"
null = [0.0, 0.0, 0.0]
[law]
torque = "step(t_c - t) * b0 + step(t - t_c) * c0"
"#;

/// What acts on the bodies of `fitted` beyond its model, the strongest first; only what stands out of
/// the noise.
pub(super) fn unexplained(scene: &Scene, fitted: &Fitted) -> Result<Vec<Unexplained>> {
    let mut all = Vec::new();
    for (kind, text) in [(Kind::Acceleration, FREE_ACCELERATION), (Kind::Torque, FREE_TORQUE)] {
        let effect = Effect::parse(text, "free")?;
        for instance in possible(scene, &effect) {
            let Ok(with) = fitted.with_quickly(scene, &instance) else { continue };
            let Some(evidence) = super::evidence(fitted, &with, 1, 4) else { continue };
            if evidence.p_value > super::FALSE_ALARM {
                continue;
            }
            let body = instance.body.unwrap_or(0);
            let samples = samples(&with, body, kind)?;
            all.push(described(scene, body, kind, evidence.delta_chi2, &samples));
        }
    }
    all.sort_by(|a, b| b.delta_chi2.total_cmp(&a.delta_chi2));
    Ok(all)
}

/// What acts at a pose, and how the body moves there.
struct Sample {
    value: Vector3<f64>,
    since_s: f64,
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
}

fn samples(with: &Fitted, body: usize, kind: Kind) -> Result<Vec<Sample>> {
    let unknowns = &with.best().solution.unknowns;
    let first = with.acting.last().map_or(0, |acting| acting.first);
    let vector = |index: usize| {
        let place = first + 3 * index;
        Vector3::from_row_slice(&unknowns.parameters[place..place + 3])
    };
    let stamps: Vec<f64> = with.refined.bodies[body].poses.iter().map(|p| p.time_s).collect();
    let states = fly(&with.refined, unknowns, body, &stamps).map_err(solver_error)?;
    Ok(stamps
        .iter()
        .zip(&states)
        .map(|(stamp_s, state)| {
            let since_s = stamp_s - unknowns.collision_time_s;
            let value = match (kind, since_s < 0.0) {
                (Kind::Acceleration, true) => vector(0) + since_s * vector(1),
                (Kind::Acceleration, false) => vector(2) + since_s * vector(3),
                (Kind::Torque, true) => vector(0),
                (Kind::Torque, false) => vector(1),
            };
            Sample {
                value,
                since_s,
                position: state.position.into(),
                velocity: state.velocity.into(),
                spin: state.spin.into(),
            }
        })
        .collect())
}

fn described(
    scene: &Scene,
    body: usize,
    kind: Kind,
    delta_chi2: f64,
    samples: &[Sample],
) -> Unexplained {
    let count = samples.len() as f64;
    let mean = samples.iter().map(|s| s.value).sum::<Vector3<f64>>() / count;
    let square = samples.iter().map(|s| s.value.norm_squared()).sum::<f64>();
    let up = scene.up_in_world().into_inner();
    type Basis = fn(&Sample) -> Vector3<f64>;
    let single: &[(&str, &str, Basis)] = match kind {
        Kind::Acceleration => &[
            ("the velocity", "acceleration = \"k * v\"", |s| s.velocity),
            ("speed times velocity", "acceleration = \"k * norm(v) * v\"", |s| {
                s.velocity.norm() * s.velocity
            }),
            ("spin × velocity", "acceleration = \"k * cross(L, v)\"", |s| {
                s.spin.cross(&s.velocity)
            }),
        ],
        Kind::Torque => &[("the spin", "torque = \"k * L\"", |s| s.spin)],
    };
    let name = match kind {
        Kind::Acceleration => "acceleration",
        Kind::Torque => "torque",
    };
    let mut forms: Vec<Form> = single
        .iter()
        .map(|(goes_with, law, basis)| {
            let top: f64 = samples.iter().map(|s| basis(s).dot(&s.value)).sum();
            let bottom: f64 = samples.iter().map(|s| basis(s).norm_squared()).sum();
            let factor = if bottom > 0.0 { top / bottom } else { 0.0 };
            form(goes_with, law, factor * top / square, factor)
        })
        .collect();
    forms.push(form(
        "nothing: it is constant in the world",
        &format!("{name} = \"a\""),
        count * mean.norm_squared() / square,
        mean.norm(),
    ));
    let upright = mean.dot(&up);
    forms.push(form(
        "nothing: it is constant along gravity",
        &format!("{name} = \"k * up\""),
        count * upright * upright / square,
        upright,
    ));
    if kind == Kind::Acceleration {
        let (share, factor) = spring(samples, square);
        let law = "acceleration = \"-k * (p - anchor)\"";
        forms.push(form("the position: like a spring to an anchor", law, share, factor));
        let (share, factor) = steered(samples, square);
        let law = "acceleration = \"cross(W, v)\"";
        forms.push(form("a fixed axis × velocity: like Coriolis' force", law, share, factor));
        let late: f64 = samples.iter().map(|s| s.since_s * s.value.dot(&mean)).sum();
        let times: f64 = samples.iter().map(|s| s.since_s.powi(2)).sum();
        let slope = late / (times * mean.norm_squared().max(f64::MIN_POSITIVE));
        let law = "acceleration = \"(t - t_c) * a\"";
        let share = slope * late / square;
        forms.push(form("time: it grows along one direction", law, share, slope * mean.norm()));
    }
    forms.sort_by(|a, b| b.share.total_cmp(&a.share));
    Unexplained {
        body: scene.bodies()[body].name.clone(),
        kind,
        delta_chi2,
        rms: (square / count).sqrt(),
        mean: mean.into(),
        forms,
    }
}

fn form(goes_with: &str, law: &str, share: f64, factor: f64) -> Form {
    Form {
        goes_with: goes_with.to_string(),
        law: law.to_string(),
        share: if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 },
        factor,
    }
}

/// −k (p − anchor): four numbers, linear in k and k · anchor.
fn spring(samples: &[Sample], square: f64) -> (f64, f64) {
    linear(samples, square, 4, |s, axis, row| {
        row[0] = -s.position[axis];
        row[1 + axis] = 1.0;
    })
}

/// W × v: three numbers.
fn steered(samples: &[Sample], square: f64) -> (f64, f64) {
    linear(samples, square, 3, |s, axis, row| {
        for turn in 0..3 {
            row[turn] = Vector3::ith(turn, 1.0).cross(&s.velocity)[axis];
        }
    })
}

/// The share of the square that a law linear in `size` numbers explains, and the size of the first.
fn linear(
    samples: &[Sample],
    square: f64,
    size: usize,
    fill: impl Fn(&Sample, usize, &mut [f64]),
) -> (f64, f64) {
    let mut rows = DMatrix::zeros(3 * samples.len(), size);
    let mut values = DVector::zeros(3 * samples.len());
    for (index, sample) in samples.iter().enumerate() {
        for axis in 0..3 {
            let mut row = vec![0.0; size];
            fill(sample, axis, &mut row);
            rows.row_mut(3 * index + axis).copy_from_slice(&row);
            values[3 * index + axis] = sample.value[axis];
        }
    }
    let Ok(solution) = rows.clone().svd(true, true).solve(&values, 1e-9) else { return (0.0, 0.0) };
    let rest = (&values - rows * &solution).norm_squared();
    (1.0 - rest / square, solution[0])
}
