//! Laws tried out in numbers: nothing at the null, finite values and derivatives everywhere near.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::names::{INPUTS, NAMES, Shape};
use super::{Effect, Hook, Operation, Program};
use crate::{Error, Result};

/// States tried beside those at rest.
const RANDOM_STATES: usize = 8;

/// The seed of all random states: a law is good or not, at every run.
const SEED: u64 = 1;

/// The step of central differences, relative to a size near 1: what is lost by cancellation, and by
/// the step's own length, both stay near 1e-8.
const STEP: f64 = 1e-6;

/// At a value and a step such as these, only a pole has such a slope.
const STEEPEST: f64 = 1e9;

/// Numbers a size or two above the rounding of what a law adds up and takes away again.
const ROUNDING: f64 = 1e-9;

/// A state of the model: the inputs, and in words what is special about it.
struct State {
    inputs: Vec<f64>,
    words: &'static str,
}

/// Runs all laws in many states.
///
/// # Errors
/// A law does something at the null values, or it or a derivative isn't finite.
pub(super) fn try_out(effect: &Effect) -> Result<()> {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let null: Vec<f64> = effect.parameters.iter().flat_map(|p| p.null.clone()).collect();
    for state in states(&mut random) {
        let near = near_null(effect, &mut random);
        for (hook, program) in &effect.laws {
            check_null(*hook, program, &state, &null)?;
            for parameters in [&null, &near] {
                check_derivatives(effect, *hook, program, &state, parameters)?;
            }
        }
    }
    Ok(())
}

fn check_null(hook: Hook, program: &Program, state: &State, null: &[f64]) -> Result<()> {
    let result = evaluate(program, hook, state, null)?;
    let of = |register: u16| &state.inputs[usize::from(register)..][..hook.length()];
    let nothing = match hook {
        Hook::Inertia => &[1.0; 3],
        Hook::Time => of(register("t")),
        Hook::Position => of(register("p")),
        Hook::ImpulsePoint | Hook::EventTime => return Ok(()),
        _ => &[0.0; 3],
    };
    let mut pairs = result.iter().zip(nothing);
    if pairs.all(|(found, wanted)| (found - wanted).abs() <= ROUNDING) {
        return Ok(());
    }
    let wanted = match hook {
        Hook::Inertia => "[1, 1, 1]",
        Hook::Time => "t",
        Hook::Position => "p",
        _ => "[0, 0, 0]",
    };
    let problem = format!("does something at the null values of the parameters: not {wanted}");
    let mend = "at their nulls the model must be the base model: change the law, or the nulls";
    Err(Error::invalid(format!("law.{hook}"), problem).mend(mend))
}

fn check_derivatives(
    effect: &Effect,
    hook: Hook,
    program: &Program,
    state: &State,
    parameters: &[f64],
) -> Result<()> {
    let bounds = effect.parameters.iter().flat_map(|p| p.null.iter().map(|_| (p.bounds, p.scale)));
    for (index, ([low, high], scale)) in bounds.enumerate() {
        let mut ends = [parameters.to_vec(), parameters.to_vec()];
        ends[0][index] = (parameters[index] - STEP * scale).max(low);
        ends[1][index] = (parameters[index] + STEP * scale).min(high);
        let [before, after] = ends.map(|end| evaluate(program, hook, state, &end));
        check_slope(program, hook, state, &before?, &after?)?;
    }
    for index in 0..usize::from(INPUTS) {
        let at = |step: f64| {
            let mut moved = State { inputs: state.inputs.clone(), ..*state };
            moved.inputs[index] += step;
            evaluate(program, hook, &moved, parameters)
        };
        check_slope(program, hook, state, &at(-STEP)?, &at(STEP)?)?;
    }
    Ok(())
}

fn check_slope(
    program: &Program,
    hook: Hook,
    state: &State,
    before: &[f64],
    after: &[f64],
) -> Result<()> {
    let steepest = before.iter().zip(after).map(|(a, b)| (b - a).abs() / (2.0 * STEP));
    match steepest.fold(0.0, f64::max) {
        steepest if steepest < STEEPEST => Ok(()),
        _ => Err(not_finite(program, hook, "has no finite derivative", state)),
    }
}

fn evaluate(program: &Program, hook: Hook, state: &State, parameters: &[f64]) -> Result<Vec<f64>> {
    let known = [&state.inputs, parameters].concat();
    let result = program.evaluate(&known, hook.length());
    match result.iter().all(|value| value.is_finite()) {
        true => Ok(result),
        false => Err(not_finite(program, hook, "isn't finite", state)),
    }
}

fn not_finite(program: &Program, hook: Hook, problem: &str, state: &State) -> Error {
    let mut mend =
        "write unit(v), which is 0 at 0, for v / norm(v); keep divisors off 0, and roots and \
                    logarithms above it: max(x, 0)"
            .to_string();
    if program.instructions.iter().any(|one| one.operation == Operation::Exp) {
        mend += "; exp(x) overflows for x above 700, and is steep long before: divide x by a usual size";
    }
    Error::invalid(format!("law.{hook}"), format!("{problem} {}", state.words)).mend(mend)
}

/// Parameters within a scale of their nulls.
fn near_null(effect: &Effect, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut values = Vec::new();
    for parameter in &effect.parameters {
        let [low, high] = parameter.bounds;
        for null in &parameter.null {
            let value = null + parameter.scale * random.random_range(-1.0..1.0);
            values.push(value.clamp(low, high));
        }
    }
    values
}

fn states(random: &mut ChaCha8Rng) -> Vec<State> {
    let mut states: Vec<State> =
        (0..RANDOM_STATES).map(|_| State { inputs: inputs(random), words: "in flight" }).collect();
    let special: [(&str, &[&str], f64); 4] = [
        ("at rest (v, w and slip 0)", &["v", "w", "L", "slip"], 0.0),
        ("without spin (w and L 0)", &["w", "L"], 0.0),
        ("near rest (v, w and slip 1e-9)", &["v", "w", "L", "slip"], 1e-9),
        ("without an impulse (J 0)", &["J"], 0.0),
    ];
    for (words, names, factor) in special {
        let mut inputs = inputs(random);
        for name in names {
            let first = usize::from(register(name));
            inputs[first..first + 3].iter_mut().for_each(|value| *value *= factor);
        }
        states.push(State { inputs, words });
    }
    states
}

/// A state in which nothing is zero or one but by definition; quantities are of everyday size.
fn inputs(random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut inputs = vec![0.0; usize::from(INPUTS)];
    for name in &NAMES {
        let length = match name.shape {
            Shape::Scalar => 1,
            Shape::Vector => 3,
            Shape::Quaternion => 4,
        };
        let part = &mut inputs[usize::from(name.register)..][..length];
        part.iter_mut().for_each(|value| *value = random.random_range(-2.0..2.0));
        match name.text {
            "size" | "mass" => part.iter_mut().for_each(|value| *value = f64::abs(*value) + 0.01),
            "q" | "normal" => normalise(part),
            "up" | "across1" | "across2" => part.fill(0.0),
            _ => {}
        }
    }
    for (name, value) in [("across1", [1.0, 0.0, 0.0]), ("up", [0.0, 1.0, 0.0])] {
        inputs[usize::from(register(name))..][..3].copy_from_slice(&value);
    }
    inputs[usize::from(register("across2"))..][..3].copy_from_slice(&[0.0, 0.0, 1.0]);
    inputs[usize::from(register("g"))..][..3].copy_from_slice(&[0.0, -9.81, 0.0]);
    inputs
}

fn normalise(part: &mut [f64]) {
    let norm = part.iter().map(|value| value * value).sum::<f64>().sqrt();
    part.iter_mut().for_each(|value| *value /= norm);
}

/// The first register of an input.
fn register(name: &str) -> u16 {
    NAMES.iter().find(|known| known.text == name).map_or(0, |known| known.register)
}
