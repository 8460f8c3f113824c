//! What is conserved, and what isn't: momentum, angular momentum and energy before and after.

use nalgebra::{DMatrix, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{Reconstruction, Scene};

/// A deviation or a change that is a smaller part of the number itself is rounding: the method
/// conserves it exactly.
const ROUNDING: f64 = 1e-9;
/// A part of each deviation to step by: the ledger is a polynomial of low degree.
const STEP: f64 = 1e-3;

/// The books of the collision, with the reference body's mass 1.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Ledger {
    /// The fixed point that angular momenta are about, and heights are from, m: where the bodies
    /// touched, or the middle between them.
    pub about: [f64; 3],
    /// By body, then of all together.
    pub lines: Vec<LedgerLine>,
}

/// One quantity of one body, or of both.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LedgerLine {
    /// The body's name; null for all together.
    pub body: Option<String>,
    /// `momentum`, `angular_momentum`, `translational_energy`, `rotational_energy`,
    /// `potential_energy` or `energy`, the sum of the three.
    pub quantity: String,
    /// Per kg of the reference body.
    pub unit: String,
    /// Just before.
    pub before: LedgerEntry,
    /// Just after.
    pub after: LedgerEntry,
    /// After minus before; its deviation knows how the two hang together.
    pub change: LedgerEntry,
    /// The number of `change` that is farthest from zero, in its deviations; null without them.
    pub change_in_sigma: Option<f64>,
}

/// A number or x y z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct LedgerEntry {
    /// Null where the result doesn't tell a spin or the mass ratio.
    pub value: Option<Vec<f64>>,
    /// One standard deviation of each number; null where the result doesn't tell it, and of a change
    /// that the method excludes.
    pub std: Vec<Option<f64>>,
}

/// Name, unit and how many numbers.
const QUANTITIES: [(&str, &str, usize); 6] = [
    ("momentum", "N·s/kg", 3),
    ("angular_momentum", "N·m·s/kg", 3),
    ("translational_energy", "J/kg", 1),
    ("rotational_energy", "J/kg", 1),
    ("potential_energy", "J/kg", 1),
    ("energy", "J/kg", 1),
];
const NUMBERS: usize = 10;

/// The ledger of `result`; what rests on a spin or mass ratio that it doesn't tell is null.
pub(super) fn ledger(scene: &Scene, result: &Reconstruction) -> Ledger {
    let scenes_own = -scene.gravity_m_s2() * scene.up_in_world().into_inner();
    let books = Books {
        about: about(result),
        gravity: result.gravity.map_or(scenes_own, Vector3::from),
        bodies: result.bodies.len(),
    };
    let inputs = inputs(result);
    let values: Vec<f64> = inputs.iter().map(|(_, value)| *value).collect();
    let numbers = books.numbers(&values);
    let stds = stds(&books, result, &inputs, &values);
    let names = result.bodies.iter().map(|body| Some(body.name.clone()));
    // A lone body is all there is.
    let all = (result.bodies.len() > 1).then_some(None);
    let mut lines = Vec::new();
    for (account, body) in names.chain(all).enumerate() {
        let mut first = 0;
        for (quantity, unit, count) in QUANTITIES {
            let entry = |column: usize| {
                let start = 3 * NUMBERS * account + NUMBERS * column + first;
                let value: Option<Vec<f64>> = numbers[start..start + count]
                    .iter()
                    .map(|number| number.is_finite().then_some(*number))
                    .collect();
                LedgerEntry { value, std: stds[start..start + count].to_vec() }
            };
            let (before, after) = (entry(0), entry(1));
            let change = without_rounding(entry(2), &before, &after);
            lines.push(LedgerLine {
                body: body.clone(),
                quantity: quantity.into(),
                unit: unit.into(),
                change_in_sigma: in_sigma(&change),
                before,
                after,
                change,
            });
            first += count;
        }
    }
    Ledger { about: books.about.into(), lines }
}

fn about(result: &Reconstruction) -> Vector3<f64> {
    result.contact_point.map(Vector3::from).unwrap_or_else(|| {
        let centres = result.bodies.iter().map(|body| Vector3::from(body.position));
        centres.sum::<Vector3<f64>>() / result.bodies.len() as f64
    })
}

/// A deviation that is rounding is none, and a change that is rounding is zero.
fn without_rounding(
    mut change: LedgerEntry,
    before: &LedgerEntry,
    after: &LedgerEntry,
) -> LedgerEntry {
    let numbers = before.value.iter().chain(&after.value).flatten();
    let size = numbers.fold(0.0, |most: f64, number| most.max(number.abs()));
    for std in &mut change.std {
        *std = std.filter(|std| *std > ROUNDING * size);
    }
    for value in change.value.iter_mut().flatten().filter(|value| value.abs() <= ROUNDING * size) {
        *value = 0.0;
    }
    change
}

fn in_sigma(change: &LedgerEntry) -> Option<f64> {
    let numbers = change.value.iter().flatten().zip(&change.std);
    numbers.filter_map(|(value, std)| Some(value.abs() / (*std)?)).max_by(f64::total_cmp)
}

/// The numbers that the ledger is made from, named as in the result's `uncertainty`; what isn't known
/// is NaN.
fn inputs(result: &Reconstruction) -> Vec<(String, f64)> {
    let mass_ratio = result.mass_ratio.as_ref().and_then(|estimate| estimate.value);
    let mut inputs = vec![("mass_ratio".to_string(), mass_ratio.unwrap_or(f64::NAN))];
    for body in &result.bodies {
        let vectors = [
            ("position", Some(body.position)),
            ("velocity_before", Some(body.velocity_before)),
            ("velocity_after", Some(body.velocity_after)),
            ("angular_velocity_before", body.angular_velocity_before),
            ("angular_velocity_after", body.angular_velocity_after),
            ("angular_momentum_before", body.angular_momentum_before),
            ("angular_momentum_after", body.angular_momentum_after),
        ];
        for (name, vector) in vectors {
            for (axis, value) in ["x", "y", "z"].iter().zip(vector.unwrap_or([f64::NAN; 3])) {
                inputs.push((format!("{}.{name}.{axis}", body.name), value));
            }
        }
    }
    inputs
}

/// How the ledger is made from its inputs.
struct Books {
    about: Vector3<f64>,
    gravity: Vector3<f64>,
    bodies: usize,
}

impl Books {
    /// By account (each body, then all): before, after and change.
    fn numbers(&self, inputs: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; 3 * NUMBERS];
        let mut accounts = Vec::new();
        for body in 0..self.bodies {
            let vector = |number: usize| {
                Vector3::from_column_slice(&inputs[1 + 21 * body + 3 * number..][..3])
            };
            let mass = if body == 0 { 1.0 } else { inputs[0] };
            let before = self.account(mass, vector(0), vector(1), vector(3), vector(5));
            let after = self.account(mass, vector(0), vector(2), vector(4), vector(6));
            let change = after.iter().zip(&before).map(|(after, before)| after - before);
            let account: Vec<f64> = before.iter().chain(&after).copied().chain(change).collect();
            all.iter_mut().zip(&account).for_each(|(all, one)| *all += one);
            accounts.extend(account);
        }
        accounts.extend(all);
        accounts
    }

    /// In the order of [`QUANTITIES`].
    fn account(
        &self,
        mass: f64,
        position: Vector3<f64>,
        velocity: Vector3<f64>,
        omega: Vector3<f64>,
        spin: Vector3<f64>,
    ) -> [f64; NUMBERS] {
        let momentum = mass * velocity;
        let lever = position - self.about;
        let angular = lever.cross(&momentum) + spin;
        let translational = 0.5 * momentum.dot(&velocity);
        let rotational = 0.5 * omega.dot(&spin);
        let potential = -mass * self.gravity.dot(&lever);
        let energies =
            [translational, rotational, potential, translational + rotational + potential];
        let mut numbers = [0.0; NUMBERS];
        numbers[..3].copy_from_slice(momentum.as_slice());
        numbers[3..6].copy_from_slice(angular.as_slice());
        numbers[6..].copy_from_slice(&energies);
        numbers
    }
}

/// One deviation of each number, by linear propagation of those of the inputs.
fn stds(
    books: &Books,
    result: &Reconstruction,
    inputs: &[(String, f64)],
    values: &[f64],
) -> Vec<Option<f64>> {
    let count = books.numbers(values).len();
    let Some(table) = &result.uncertainty else { return vec![None; count] };
    let places: Vec<Option<usize>> = inputs
        .iter()
        .map(|(name, _)| table.quantities.iter().position(|known| known == name))
        .map(|place| place.filter(|&at| table.std[at].is_some()))
        .collect();
    let std = |input: usize| places[input].and_then(|at| table.std[at]);
    let covariance = DMatrix::from_fn(inputs.len(), inputs.len(), |row, column| {
        let covariance = || {
            let (one, other) = (places[row]?, places[column]?);
            let correlation = table.correlation.get(one.max(other))?.get(one.min(other))?;
            Some((*correlation)? * std(row)? * std(column)?)
        };
        covariance().unwrap_or(0.0)
    });
    let mut slopes = DMatrix::zeros(count, inputs.len());
    for input in 0..inputs.len() {
        let step = std(input).map_or(1e-6, |std| STEP * std);
        let beside = |step: f64| {
            let mut values = values.to_vec();
            values[input] += step;
            books.numbers(&values)
        };
        for (row, (high, low)) in beside(step).iter().zip(beside(-step)).enumerate() {
            slopes[(row, input)] = (high - low) / (2.0 * step);
        }
    }
    let spread = &slopes * covariance;
    let unknown: Vec<usize> = (0..inputs.len()).filter(|&input| std(input).is_none()).collect();
    (0..count)
        .map(|row| {
            let variance = spread.row(row).dot(&slopes.row(row));
            let rests_on_unknown = unknown.iter().any(|&input| slopes[(row, input)] != 0.0);
            (variance.is_finite() && !rests_on_unknown).then(|| variance.max(0.0).sqrt())
        })
        .collect()
}
