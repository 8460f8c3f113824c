//! What laws are evaluated on: random states of the model, turned, and in other units.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use smash::effect::{Effect, Frame, Hook, INPUTS, Scan};
use smash::nalgebra::{Quaternion, UnitQuaternion, UnitVector3, Vector3};

/// How an input behaves when the scene is turned.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Scalar,
    /// A vector in the world.
    World,
    /// Three numbers in the body's axes.
    Body,
    Orientation,
}

/// First register, kind, and the powers of m, s and kg.
const LAYOUT: [(usize, Kind, [i32; 3]); 18] = [
    (0, Kind::Scalar, [0, 1, 0]),      // t
    (1, Kind::World, [1, 0, 0]),       // p
    (4, Kind::World, [1, -1, 0]),      // v
    (7, Kind::Orientation, [0, 0, 0]), // q
    (11, Kind::World, [0, -1, 0]),     // w
    (14, Kind::World, [2, -1, 0]),     // L
    (17, Kind::World, [0, 0, 0]),      // up
    (20, Kind::World, [1, -2, 0]),     // g
    (23, Kind::World, [1, 0, 0]),      // camera
    (26, Kind::World, [0, 0, 0]),      // normal
    (29, Kind::Body, [1, 0, 0]),       // size
    (32, Kind::Scalar, [0, 0, 1]),     // mass
    (33, Kind::World, [1, -1, 0]),     // J
    (36, Kind::World, [1, 0, 0]),      // x
    (39, Kind::World, [1, -1, 0]),     // slip
    (42, Kind::World, [0, 0, 0]),      // across1
    (45, Kind::World, [0, 0, 0]),      // across2
    (48, Kind::Scalar, [0, 1, 0]),     // t_c
];

/// The registers that hold what is zero at rest: v, w, L, slip.
const MOTION: [usize; 4] = [4, 11, 14, 39];

/// The inputs and the parameters of an effect, as an evaluator takes them.
#[derive(Clone)]
pub struct State {
    pub known: Vec<f64>,
}

/// Two tables of four states: in flight, at rest, without spin, and nearly at rest.
pub fn states(effect: &Effect) -> Vec<State> {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut states = Vec::new();
    for factors in [[1.0; 4], [0.0; 4], [1.0, 0.0, 0.0, 1.0], [1e-9; 4]].repeat(2) {
        let mut state = State::random(effect, &mut random);
        for (first, factor) in MOTION.into_iter().zip(factors) {
            state.known[first..first + 3].iter_mut().for_each(|value| *value *= factor);
        }
        states.push(state);
    }
    states
}

impl State {
    fn random(effect: &Effect, random: &mut ChaCha8Rng) -> State {
        let mut known: Vec<f64> =
            (0..usize::from(INPUTS)).map(|_| random.random_range(-2.0..2.0)).collect();
        let q = UnitQuaternion::from_quaternion(Quaternion::new(
            known[7], known[8], known[9], known[10],
        ));
        known[7..11].copy_from_slice(&[q.w, q.i, q.j, q.k]);
        let up = UnitVector3::new_normalize(vector(&known, 17));
        let across1 = UnitVector3::new_normalize(up.cross(&vector(&known, 42)));
        let normal = UnitVector3::new_normalize(vector(&known, 26));
        let across2 = up.cross(&across1);
        for (first, value) in [
            (17, up.into_inner()),
            (20, -9.81 * up.into_inner()),
            (26, normal.into_inner()),
            (42, across1.into_inner()),
            (45, across2),
        ] {
            known[first..first + 3].copy_from_slice(value.as_slice());
        }
        for size in &mut known[29..33] {
            *size = f64::abs(*size) + 0.01;
        }
        for parameter in &effect.parameters {
            let [low, high] = parameter.bounds;
            for null in &parameter.null {
                // Where a bound is at the null, only one side is left.
                let step = parameter.scale * random.random_range(-3.0..3.0);
                let is_within = (low..=high).contains(&(null + step));
                known.push(if is_within { null + step } else { null - step });
            }
        }
        // Else the law of a single stamp would never be seen at work.
        if effect.parameters[0].scan == Some(Scan::ObservationTimes) {
            known[0] = known[usize::from(INPUTS)];
        }
        State { known }
    }

    /// Whether the contact point slides.
    pub fn slides(&self) -> bool {
        vector(&self.known, 39).norm() > 1e-3
    }

    pub fn with_nulls(&self, effect: &Effect) -> State {
        let nulls = effect.parameters.iter().flat_map(|parameter| &parameter.null);
        let inputs = &self.known[..usize::from(INPUTS)];
        State { known: inputs.iter().chain(nulls).copied().collect() }
    }

    /// The same state in a world that is turned.
    pub fn turned(&self, effect: &Effect, turn: &UnitQuaternion<f64>) -> State {
        let mut known = self.known.clone();
        for (first, kind, _) in LAYOUT {
            match kind {
                Kind::World => turn_at(&mut known, first, turn),
                Kind::Orientation => {
                    let [w, x, y, z] = [0, 1, 2, 3].map(|part| self.known[first + part]);
                    let q = turn.into_inner() * Quaternion::new(w, x, y, z);
                    known[first..first + 4].copy_from_slice(&[q.w, q.i, q.j, q.k]);
                }
                Kind::Scalar | Kind::Body => {}
            }
        }
        let mut first = usize::from(INPUTS);
        for parameter in &effect.parameters {
            if parameter.null.len() == 3 && parameter.frame == Frame::World {
                turn_at(&mut known, first, turn);
            }
            first += parameter.null.len();
        }
        State { known }
    }

    /// The same state in units of which a metre, a second and a kilogram have so many.
    pub fn in_units(&self, effect: &Effect, units: [f64; 3]) -> State {
        let mut known = self.known.clone();
        for (first, kind, powers) in LAYOUT {
            let length = match kind {
                Kind::Scalar => 1,
                Kind::World | Kind::Body => 3,
                Kind::Orientation => 4,
            };
            let factor = factor(powers.map(f64::from), units);
            known[first..first + length].iter_mut().for_each(|value| *value *= factor);
        }
        let mut first = usize::from(INPUTS);
        for parameter in &effect.parameters {
            let factor = factor(parameter.unit.dimension().powers(), units);
            let length = parameter.null.len();
            known[first..first + length].iter_mut().for_each(|value| *value *= factor);
            first += length;
        }
        State { known }
    }
}

/// By how much a quantity's number grows in such units.
pub fn factor(powers: [f64; 3], units: [f64; 3]) -> f64 {
    powers.iter().zip(units).map(|(power, unit)| unit.powf(*power)).product()
}

/// Whether the hook's result is a vector in the world.
pub fn is_in_world(hook: Hook) -> bool {
    hook.length() == 3 && !matches!(hook, Hook::Inertia | Hook::Orientation)
}

fn vector(known: &[f64], first: usize) -> Vector3<f64> {
    Vector3::from_column_slice(&known[first..first + 3])
}

fn turn_at(known: &mut [f64], first: usize, turn: &UnitQuaternion<f64>) {
    let turned = turn * vector(known, first);
    known[first..first + 3].copy_from_slice(turned.as_slice());
}
