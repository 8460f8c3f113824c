//! Results beside what a simulated scene was made with.

use std::path::Path;

use super::side_by_side::{NOT_DETERMINED, Said, beside, said};
use super::{Entry, Quantity};
use crate::effect::catalogue;
use crate::reconstruct::{ActiveEffect, Number};
use crate::simulate::{EffectSpec, Truth};
use crate::words::listed;
use crate::{Error, Reconstruction, Result, Scene};

/// The reason of an entry whose result hasn't got the effect that acted.
pub const NOT_IN_THE_MODEL: &str = "not in the model";

/// How far `results`, which are of `scene`, are from the truth that `smash simulate` wrote with it: the
/// first entry of each quantity is the truth's, with differences from it. In σ they are told by the
/// results' own deviations, since the truth has none.
///
/// Told are the mass ratio, the restitution, the collision time, the impulse, the velocities and spins,
/// and the parameters of the effects that acted. The truth's impulse and restitution are the contact's
/// alone.
///
/// # Errors
/// The truth is of other bodies.
///
/// # Example
/// ```no_run
/// let scene = smash::Scene::read("scene.json")?;
/// let result = smash::reconstruct(&scene, &smash::Options::default())?;
/// let truth = smash::simulate::Truth::read("truth.json")?;
/// let errors =
///     smash::compare::against_truth(&scene, &truth, &[("result".to_string(), result)])?;
/// println!("{}: {:?}", errors[0].quantity, errors[0].differences[0].in_sigma);
/// # Ok::<(), smash::Error>(())
/// ```
pub fn against_truth(
    scene: &Scene,
    truth: &Truth,
    results: &[(String, Reconstruction)],
) -> Result<Vec<Quantity>> {
    let of_truth: Vec<&str> = truth.bodies.iter().map(|body| body.name.as_str()).collect();
    let of_scene: Vec<&str> = scene.bodies().iter().map(|body| body.name.as_str()).collect();
    if of_truth != of_scene {
        let problem = format!("are {}, but the scene's {}", listed(&of_truth), listed(&of_scene));
        return Err(Error::invalid("bodies", problem)
            .mend("give the truth that `smash simulate --truth` wrote with this scene"));
    }
    let known = true_values(truth);
    let columns = results.iter().map(|(_, result)| {
        let all = [said(scene, result), parameters(truth, result)].concat();
        let found = |(name, unit, _): &Said| {
            let same = all.iter().find(|(other, _, _)| other == name);
            same.cloned().unwrap_or_else(|| (name.clone(), unit.clone(), lacking(NOT_IN_THE_MODEL)))
        };
        known.iter().map(found).collect()
    });
    Ok(beside(std::iter::once(known.clone()).chain(columns)))
}

fn true_values(truth: &Truth) -> Vec<Said> {
    let said = |name: &str, unit: &str, numbers: &[f64]| {
        let entry =
            Entry { value: Some(numbers.to_vec()), std: vec![None; numbers.len()], reason: None };
        (name.to_string(), unit.to_string(), entry)
    };
    let mut all: Vec<Said> =
        truth.mass_ratio.iter().map(|ratio| said("mass_ratio", "", &[*ratio])).collect();
    all.push(said("restitution", "", &[truth.restitution]));
    all.push(said("collision_time", "s", &[truth.collision_time]));
    all.push(said("impulse", "N·s/kg", &truth.impulse));
    for body in &truth.bodies {
        for (quantity, unit, vector) in [
            ("velocity_before", "m/s", &body.velocity_before),
            ("velocity_after", "m/s", &body.velocity_after),
            ("angular_velocity_before", "rad/s", &body.angular_velocity_before),
            ("angular_velocity_after", "rad/s", &body.angular_velocity_after),
        ] {
            all.push(said(&format!("{}.{quantity}", body.name), unit, vector));
        }
    }
    for (index, effect) in truth.effects.iter().enumerate() {
        for (parameter, value) in &effect.parameters {
            let name = format!("{}.{parameter}", numbered(truth, index));
            all.push(said(&name, &unit(effect, parameter), value.components()));
        }
    }
    all
}

/// What `result` says of the parameters of the effects that acted.
fn parameters(truth: &Truth, result: &Reconstruction) -> Vec<Said> {
    let mut all = Vec::new();
    for (index, effect) in truth.effects.iter().enumerate() {
        let name = effect_name(effect);
        let is_it = |active: &&ActiveEffect| {
            let everywhere = active.body.is_none() || effect.body.is_none();
            active.name == name && (everywhere || active.body == effect.body)
        };
        let before = namesakes_before(truth, index);
        let Some(active) = result.effects.iter().filter(is_it).nth(before) else { continue };
        for (parameter, estimate) in &active.parameters {
            let numbers = |number: &Number| number.components().to_vec();
            let value = estimate.value.as_ref().map(numbers);
            let count = value.as_ref().map_or(1, Vec::len);
            let stds = estimate.std.as_ref().map(numbers);
            let std = stds.map_or(vec![None; count], |all| all.into_iter().map(Some).collect());
            let reason = value.is_none().then(|| NOT_DETERMINED.to_string());
            let entry = Entry { value, std, reason };
            let name = format!("{}.{parameter}", numbered(truth, index));
            all.push((name, estimate.unit.clone(), entry));
        }
    }
    all
}

/// Its label; of one that acts again with a number.
fn numbered(truth: &Truth, index: usize) -> String {
    let label = label(&truth.effects[index]);
    match namesakes_before(truth, index) {
        0 => label,
        before => format!("{label} {}", before + 1),
    }
}

/// How many effects before number `index` have its label.
fn namesakes_before(truth: &Truth, index: usize) -> usize {
    let own = label(&truth.effects[index]);
    truth.effects[..index].iter().filter(|other| label(other) == own).count()
}

fn label(effect: &EffectSpec) -> String {
    let name = effect_name(effect);
    effect.body.as_ref().map_or(name.clone(), |body| format!("{name}@{body}"))
}

/// Its name; of one in a file, whose path the truth holds, that of the file. Which isn't read: the truth
/// may come from elsewhere.
fn effect_name(effect: &EffectSpec) -> String {
    let stem = Path::new(&effect.name).file_stem();
    stem.map_or(effect.name.clone(), |stem| stem.to_string_lossy().into_owned())
}

/// The unit of a parameter of a catalogue's effect.
fn unit(effect: &EffectSpec, parameter: &str) -> String {
    let effect = catalogue().iter().find(|known| known.name == effect.name);
    let parameter =
        effect.and_then(|effect| effect.parameters.iter().find(|one| one.name == parameter));
    let unit = parameter.map_or(String::new(), |parameter| parameter.unit.to_string());
    if unit == "1" { String::new() } else { unit }
}

fn lacking(reason: &str) -> Entry {
    Entry { value: None, std: vec![None], reason: Some(reason.to_string()) }
}
