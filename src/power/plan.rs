//! From a plan and an effect to all answers.

use super::answer::{QUESTIONS, answer};
use super::axis::axes;
use super::chance::{Chance, sought};
use super::film::Film;
use super::report::{POWER_SCHEMA, Power};
use super::words::explanation;
use crate::reconstruct::refined::{Instance, instances};
use crate::simulate::{EffectSpec, SimulationSpec};
use crate::{Error, Result, Scene};

/// Tells how large `effect` must be to be found in the film that `spec` plans, and what more frames
/// and less noise do to that. `spec` states Gaussian noise; its own effects are known to act, and are
/// part of the model, their sizes unknown.
///
/// A parameter that `effect` gives says in which direction it grows, and how large it is; without
/// one each component of each parameter is asked for on its own, at its typical size. `size`, the
/// distance from the null, takes the place of either. What happens at one moment needs its `time`.
///
/// # Errors
/// The specification breaks a rule or states no noise; there is no such effect or body, the film
/// can't show it, or a value or the size is out of place.
///
/// # Example
/// ```no_run
/// use smash::simulate::{EffectSpec, SimulationSpec};
/// let spec = SimulationSpec::read("scenes/ball_on_floor.spec.json".as_ref())?;
/// let power = smash::power(&spec, &EffectSpec::parse("quadratic_drag@ball")?, None)?;
/// println!("{}", power.explanation);
/// # Ok::<(), smash::Error>(())
/// ```
pub fn power(spec: &SimulationSpec, effect: &EffectSpec, size: Option<f64>) -> Result<Power> {
    power_with_progress(spec, effect, size, &|_| {})
}

/// The same; `progress` is called, from any thread, whenever one of so many questions is answered.
///
/// # Errors
/// As [`power`].
pub fn power_with_progress(
    spec: &SimulationSpec,
    effect: &EffectSpec,
    size: Option<f64>,
    progress: &(impl Fn(usize) + Sync),
) -> Result<Power> {
    let film = Film::new(spec)?;
    let scene = film.scene()?;
    let instance = sought(&scene, effect)?;
    refuse_known(&film, effect, &instance, &scene)?;
    let axes = axes(&instance.effect, effect, size)?;
    let done = || progress(QUESTIONS * axes.len());
    // One after the other: the questions of each run side by side.
    let chances: Vec<Chance> = axes
        .iter()
        .map(|axis| Chance::of(&film, &axis.effect(axis.size)))
        .collect::<Result<_>>()?;
    let answers =
        axes.iter().zip(&chances).map(|(axis, chance)| answer(&film, axis, chance, &done));
    let mut power = Power {
        schema: POWER_SCHEMA.to_string(),
        scene: spec.name.clone(),
        effect: instance.effect.name.clone(),
        body: instance.body.map(|body| scene.bodies()[body].name.clone()),
        noise: film.noise(),
        poses: chances[0].poses,
        candidates_tried: chances[0].tried,
        axes: answers.collect::<Result<_>>()?,
        explanation: String::new(),
    };
    power.explanation = explanation(&power, &instance.effect);
    Ok(power)
}

/// What the film has already can't be sought in it.
fn refuse_known(
    film: &Film,
    effect: &EffectSpec,
    instance: &Instance,
    scene: &Scene,
) -> Result<()> {
    for known in film.known_effects() {
        let all = instances(scene, &known.unknown()?)?;
        let is_it =
            |other: &Instance| other.effect == instance.effect && other.body == instance.body;
        if all.iter().any(is_it) && !instance.is_of_a_moment() {
            let problem = format!("has {} already, and its model too", instance.label(scene));
            return Err(Error::invalid("effects", problem)
                .mend(format!("take it out, and ask for {}:PARAMETER=VALUE", effect.name)));
        }
    }
    Ok(())
}
