//! What every effect of the catalogue must keep.

use smash::effect::{Effect, Hook, INPUTS, Program, catalogue};
use smash::nalgebra::{UnitQuaternion, Vector3};

use super::inputs::{State, factor, is_in_world, states};

/// Some ten operations on numbers near ten: rounding stays far below, any mistake far above.
const ROUNDING: f64 = 1e-10;

fn results(effect: &Effect, state: &State) -> Vec<(Hook, Vec<f64>)> {
    let run =
        |(hook, program): &(Hook, Program)| (*hook, program.evaluate(&state.known, hook.length()));
    effect.laws.iter().map(run).collect()
}

fn assert_near(found: &[f64], wanted: &[f64], place: &str) {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= ROUNDING * (1.0 + b.abs());
    let agree = found.len() == wanted.len() && found.iter().zip(wanted).all(near);
    assert!(agree, "{place}: {found:?} instead of {wanted:?}");
}

#[test]
fn at_its_nulls_an_effect_does_nothing() {
    for effect in catalogue() {
        for state in states(effect) {
            let null = state.with_nulls(effect);
            for (hook, found) in results(effect, &null) {
                let nothing = match hook {
                    Hook::Inertia => vec![1.0; 3],
                    Hook::Time => vec![null.known[0]],
                    Hook::Position => null.known[1..4].to_vec(),
                    // Where and when nothing happens makes no difference.
                    Hook::ImpulsePoint | Hook::EventTime => found.clone(),
                    _ => vec![0.0; 3],
                };
                assert_near(&found, &nothing, &format!("{} {hook}", effect.name));
            }
        }
    }
}

/// A law that does nothing anywhere would pass all else.
#[test]
fn away_from_its_nulls_an_effect_does_something() {
    for effect in catalogue() {
        let state = &states(effect)[0];
        let base = results(effect, &state.with_nulls(effect));
        for (law, null) in results(effect, state).into_iter().zip(base) {
            if law.0 != Hook::ImpulsePoint {
                assert_ne!(law, null, "{}", effect.name);
            }
        }
    }
}

/// Also at rest, without spin and nearly at rest. A thousandth of a step changes a smooth law's
/// slope by little; at a pole it would grow a thousandfold.
#[test]
fn central_differences_are_finite_and_settle() {
    for effect in catalogue() {
        for state in states(effect) {
            for index in 0..state.known.len() {
                // A stamp is the same as another or it isn't; sliding has a direction or none:
                // there is a jump, and no slope.
                let is_stamp = [0, usize::from(INPUTS)].contains(&index);
                let is_slip = (39..42).contains(&index) && !state.slides();
                if effect.name == "outlier" && is_stamp || effect.name == "friction" && is_slip {
                    continue;
                }
                let slope = |step: f64| {
                    let [before, after] = [-step, step].map(|step| {
                        let mut moved = state.clone();
                        moved.known[index] += step;
                        results(effect, &moved)
                    });
                    let pairs = before.into_iter().zip(after);
                    let lists = pairs.flat_map(|(b, a)| b.1.into_iter().zip(a.1));
                    lists.map(|(b, a)| (a - b) / (2.0 * step)).collect::<Vec<f64>>()
                };
                for (coarse, fine) in slope(1e-4).into_iter().zip(slope(1e-7)) {
                    let place = format!("{}, register {index}", effect.name);
                    assert!(coarse.is_finite() && fine.is_finite(), "{place}");
                    assert!(fine.abs() <= 10.0 * coarse.abs() + 1e-3, "{place}: {coarse} {fine}");
                }
            }
        }
    }
}

#[test]
fn turning_the_scene_turns_the_law() {
    let turn = UnitQuaternion::new(Vector3::new(0.7, -1.9, 1.1));
    for effect in catalogue() {
        for state in states(effect) {
            let turned = results(effect, &state.turned(effect, &turn));
            for ((hook, before), (_, after)) in results(effect, &state).into_iter().zip(turned) {
                let wanted = if is_in_world(hook) {
                    (turn * Vector3::from_column_slice(&before)).as_slice().to_vec()
                } else {
                    before
                };
                assert_near(&after, &wanted, &format!("{} {hook}", effect.name));
            }
        }
    }
}

/// A law doesn't know what a metre is: in millimetres and minutes it says the same.
#[test]
fn units_scale() {
    let units = [1e3, 1.0 / 60.0, 7.0];
    for effect in catalogue() {
        for state in states(effect) {
            let other = results(effect, &state.in_units(effect, units));
            for ((hook, si), (_, found)) in results(effect, &state).into_iter().zip(other) {
                let factor = factor(hook.dimension().powers(), units);
                let wanted: Vec<f64> = si.iter().map(|value| factor * value).collect();
                assert_near(&found, &wanted, &format!("{} {hook}", effect.name));
            }
        }
    }
}
