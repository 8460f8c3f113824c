//! What a model leaves unexplained: a free force and a free torque on each body, any polynomials in
//! time on either side of the collision, and which simple law they look like.

use nalgebra::Vector3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::evidence::by_chance;
use super::forms::{LawForm, forms, free};
use super::verdict::EXPLAINS;
use crate::reconstruct::refined::{Fitted, Gain, Instance, gains, possible};
use crate::{Result, Scene};

/// Degrees of the polynomials that are tried.
const DEGREES: [usize; 2] = [0, 1];
/// Forms that are told.
const MOST_FORMS: usize = 4;

/// An acceleration, a torque, or a swing of the tracked point that the model lacks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Unexplained {
    /// The body that it acts on.
    pub body: String,
    /// `acceleration` in m/s², `torque` per unit of the body's mass in m²/s², or `position` in m.
    pub kind: Kind,
    /// By how much χ² falls with it; as improbable, where the noise is estimated.
    pub delta_chi2: f64,
    /// Its root mean square over the poses; of a position over those of one flight, about the mean.
    pub rms: f64,
    /// Its mean over the same poses, in the world.
    pub mean: [f64; 3],
    /// Simple laws that it looks like, the likeliest first; none where the model is far off.
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
    /// On where the tracked point is beside the body's centre.
    Position,
}

/// A simple law that has the shape of what is unexplained.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Form {
    /// In words.
    pub goes_with: String,
    /// As a line of an effect file's `[law]`.
    pub law: String,
    /// How much of the fall of χ² this law alone brings, 0 to 1.
    pub share: f64,
    /// Its factor `k`, or the length of its vector, in SI units; of a swing its rate in rad/s.
    pub factor: f64,
}

/// A free force or torque that was tried.
struct Tried {
    kind: Kind,
    degree: usize,
    instance: Instance,
}

/// What acts on the bodies of `fitted` beyond its model, the clearest first; only what stands out of
/// the noise. All is told from the slopes of the poses: what is left over is small.
pub(crate) fn unexplained(scene: &Scene, fitted: &Fitted) -> Result<Vec<Unexplained>> {
    let mut all: Vec<Tried> = Vec::new();
    for kind in [Kind::Acceleration, Kind::Torque] {
        for degree in DEGREES {
            let instances = possible(scene, &free(kind, degree)).into_iter();
            all.extend(instances.map(|instance| Tried { kind, degree, instance }));
        }
    }
    let laws: Vec<(&LawForm, Instance)> = forms()
        .iter()
        .flat_map(|form| possible(scene, &form.effect).into_iter().map(move |one| (form, one)))
        .collect();
    let instances = all.iter().map(|one| &one.instance).chain(laws.iter().map(|(_, one)| one));
    let tests: Vec<(Instance, Vec<f64>)> =
        instances.map(|instance| (instance.clone(), instance.null())).collect();
    let mut gains = gains(fitted, &tests)?;
    let of_laws = gains.split_off(all.len());
    let laws: Vec<(&LawForm, Instance, Gain)> =
        laws.into_iter().zip(of_laws).map(|((form, one), gain)| (form, one, gain)).collect();
    let mut found: Vec<(f64, &Tried, &Gain)> = Vec::new();
    for (tried, gain) in all.iter().zip(&gains) {
        let chance = by_chance(fitted, gain) * all.len() as f64;
        let is_same =
            |other: &Tried| other.kind == tried.kind && other.instance.body == tried.instance.body;
        match found.iter_mut().find(|(_, other, _)| is_same(other)) {
            Some(known) if known.0 > chance => *known = (chance, tried, gain),
            Some(_) => {}
            None => found.push((chance, tried, gain)),
        }
    }
    found.retain(|(chance, _, _)| *chance < super::FALSE_ALARM);
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(found.iter().map(|(_, tried, gain)| described(scene, fitted, tried, gain, &laws)).collect())
}

/// The one that explains most where `fitted` is far off: found by fits, since slopes foretell little, and
/// what they say of the other bodies is but how this one bends the model. Forms aren't told.
pub(super) fn clearest(scene: &Scene, fitted: &Fitted) -> Option<Unexplained> {
    let tried = |kind: Kind| {
        let degree = DEGREES[DEGREES.len() - 1];
        let instances = possible(scene, &free(kind, degree)).into_iter();
        instances.map(move |instance| Tried { kind, degree, instance })
    };
    let all: Vec<Tried> = [Kind::Acceleration, Kind::Torque].into_iter().flat_map(tried).collect();
    let fit = |one: &Tried| {
        let with = fitted.with_at_once(scene, &one.instance).ok()?;
        let acting = with.acting.last()?;
        let values = &with.best().solution.unknowns.parameters[acting.first..];
        Some(Gain {
            chi2: fitted.fall_to(&with),
            directions: with.directions(acting),
            step: values.to_vec(),
        })
    };
    let gains: Vec<Option<Gain>> = all.par_iter().map(fit).collect();
    let found = all.iter().zip(gains).filter_map(|(tried, gain)| Some((tried, gain?)));
    let (tried, gain) = found.max_by(|a, b| a.1.chi2.total_cmp(&b.1.chi2))?;
    let explains = gain.chi2 > EXPLAINS * fitted.chi2();
    explains.then(|| described(scene, fitted, tried, &gain, &[]))
}

fn described(
    scene: &Scene,
    fitted: &Fitted,
    tried: &Tried,
    gain: &Gain,
    laws: &[(&LawForm, Instance, Gain)],
) -> Unexplained {
    let body = tried.instance.body.unwrap_or(0);
    let values = values(fitted, body, tried.degree, &gain.step);
    let count = values.len() as f64;
    let is_on = |instance: &Instance| instance.body.is_none_or(|on| on == body);
    let mut alike: Vec<&(&LawForm, Instance, Gain)> =
        laws.iter().filter(|(form, one, _)| form.kind == tried.kind && is_on(one)).collect();
    let behind = |gain: &Gain| gain.directions as f64 * fitted.numbers().ln() - gain.chi2;
    alike.sort_by(|a, b| behind(&a.2).total_cmp(&behind(&b.2)));
    let form = |(form, _, own): &&(&LawForm, Instance, Gain)| Form {
        goes_with: form.goes_with.to_string(),
        law: form.line(),
        share: (own.chi2 / gain.chi2).clamp(0.0, 1.0),
        factor: factor(form, &own.step),
    };
    Unexplained {
        body: scene.bodies()[body].name.clone(),
        kind: tried.kind,
        delta_chi2: gain.chi2,
        rms: (values.iter().map(Vector3::norm_squared).sum::<f64>() / count).sqrt(),
        mean: (values.iter().sum::<Vector3<f64>>() / count).into(),
        forms: alike.iter().take(MOST_FORMS).map(form).collect(),
    }
}

fn factor(form: &LawForm, step: &[f64]) -> f64 {
    match form.effect.parameters[0].null.len() {
        1 => step[0],
        _ => Vector3::from_row_slice(&step[..3]).norm(),
    }
}

/// The polynomials' values at a body's poses.
fn values(fitted: &Fitted, body: usize, degree: usize, step: &[f64]) -> Vec<Vector3<f64>> {
    let [before, after] = [0, 3 * (degree + 1)].map(|first| &step[first..first + 3 * (degree + 1)]);
    let value = |since_s: f64| {
        let side = if since_s < 0.0 { before } else { after };
        let terms = side.chunks(3).enumerate();
        terms.map(|(power, c)| Vector3::from_row_slice(c) * since_s.powi(power as i32)).sum()
    };
    let poses = fitted.refined.bodies[body].poses.iter();
    poses.map(|pose| value(pose.time_s - fitted.collision_time_s())).collect()
}
