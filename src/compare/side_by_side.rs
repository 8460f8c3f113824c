//! What the results say, quantity by quantity.

use std::collections::HashMap;

use super::ledger::{LedgerEntry, ledger};
use super::{Difference, Entry, Quantity};
use crate::reconstruct::Estimate;
use crate::rigid_body::quaternion::from_wxyz;
use crate::{Reconstruction, Scene};

/// A difference that is a smaller part of the numbers is rounding.
const ROUNDING: f64 = 1e-12;
pub(super) const NOT_DETERMINED: &str = "not determined";

/// What one result says of a quantity, with the quantity's name and the unit of its values.
pub(super) type Said = (String, String, Entry);

/// All quantities, with one entry for each of `results`, which are of `scene`.
pub(super) fn quantities(scene: &Scene, results: &[(String, Reconstruction)]) -> Vec<Quantity> {
    // Results of one scene have the same bodies, hence the same rows.
    beside(results.iter().map(|(_, result)| said(scene, result)))
}

/// All that `result` says.
pub(super) fn said(scene: &Scene, result: &Reconstruction) -> Vec<Said> {
    Column::of(scene, result).rows
}

/// Columns of the same quantities side by side; differences are from the first.
pub(super) fn beside(columns: impl Iterator<Item = Vec<Said>>) -> Vec<Quantity> {
    let mut quantities: Vec<Quantity> = Vec::new();
    for rows in columns {
        if quantities.is_empty() {
            quantities = rows
                .iter()
                .map(|(quantity, unit, _)| Quantity {
                    quantity: quantity.clone(),
                    unit: unit.clone(),
                    difference_unit: match quantity.ends_with(".orientation") {
                        true => "rad".to_string(),
                        false => unit.clone(),
                    },
                    entries: Vec::new(),
                    differences: Vec::new(),
                })
                .collect();
        }
        for (quantity, (_, _, entry)) in quantities.iter_mut().zip(rows) {
            if let Some(first) = quantity.entries.first() {
                quantity.differences.push(difference(first, &entry));
            }
            quantity.entries.push(entry);
        }
    }
    quantities
}

/// All that one result says: quantity, unit and entry.
struct Column<'a> {
    /// One standard deviation of each number, by its name in the result's `uncertainty`.
    std: HashMap<&'a str, f64>,
    rows: Vec<Said>,
}

impl<'a> Column<'a> {
    fn of(scene: &Scene, result: &'a Reconstruction) -> Self {
        let table = result.uncertainty.iter().flat_map(|u| u.quantities.iter().zip(&u.std));
        let std = table.filter_map(|(name, std)| std.map(|std| (name.as_str(), std))).collect();
        let mut column = Column { std, rows: Vec::new() };
        if scene.bodies().len() == 2 {
            column.number("mass_ratio", "", result.mass_ratio.as_ref());
        }
        column.number("restitution", "", Some(&result.restitution));
        column.number("collision_time", "s", Some(&result.collision_time));
        column.vector("contact_point", "m", result.contact_point, None);
        column.vector("impulse", "N·s/kg", Some(result.impulse), None);
        column.vector("normal", "", result.normal, None);
        // Of all bodies together: the last lines.
        let lines = ledger(scene, result).lines;
        let all = lines.last().map(|line| line.body.clone());
        for line in lines.into_iter().filter(|line| Some(&line.body) == all.as_ref()) {
            let unit = match line.quantity.as_str() {
                "momentum" => "N·s/kg",
                "angular_momentum" => "N·m·s/kg",
                "energy" => "J/kg",
                _ => continue,
            };
            let LedgerEntry { value, std } = line.change;
            let reason = value.is_none().then(|| NOT_DETERMINED.to_string());
            let entry = Entry { value, std, reason };
            column.rows.push((format!("{}_change", line.quantity), unit.to_string(), entry));
        }
        for body in &result.bodies {
            let name = |quantity: &str| format!("{}.{quantity}", body.name);
            let why = body.reason.as_deref();
            column.vector(&name("position"), "m", Some(body.position), None);
            column.vector(&name("orientation"), "", body.orientation, why);
            column.vector(&name("velocity_before"), "m/s", Some(body.velocity_before), None);
            column.vector(&name("velocity_after"), "m/s", Some(body.velocity_after), None);
            let (before, after) = (body.angular_velocity_before, body.angular_velocity_after);
            column.vector(&name("angular_velocity_before"), "rad/s", before, why);
            column.vector(&name("angular_velocity_after"), "rad/s", after, why);
        }
        column
    }

    fn number(&mut self, quantity: &str, unit: &str, estimate: Option<&Estimate>) {
        let value = estimate.and_then(|estimate| estimate.value);
        let reason = || {
            estimate.and_then(|estimate| estimate.reason.clone()).unwrap_or(NOT_DETERMINED.into())
        };
        let entry = Entry {
            value: value.map(|value| vec![value]),
            std: vec![estimate.and_then(|estimate| estimate.std)],
            reason: value.is_none().then(reason),
        };
        self.rows.push((quantity.to_string(), unit.to_string(), entry));
    }

    /// `value`: x y z, or w x y z.
    fn vector<const N: usize>(
        &mut self,
        quantity: &str,
        unit: &str,
        value: Option<[f64; N]>,
        why: Option<&str>,
    ) {
        let std = ["x", "y", "z"].map(|axis| {
            let name = format!("{quantity}.{axis}");
            self.std.get(name.as_str()).copied()
        });
        let reason = value.is_none().then(|| why.unwrap_or(NOT_DETERMINED).to_string());
        let entry = Entry { value: value.map(Vec::from), std: std.into(), reason };
        self.rows.push((quantity.to_string(), unit.to_string(), entry));
    }
}

fn difference(first: &Entry, later: &Entry) -> Difference {
    let (Some(from), Some(to)) = (&first.value, &later.value) else {
        return Difference { difference: None, size: None, in_sigma: None };
    };
    let difference: Vec<f64> = match (from.as_slice(), to.as_slice()) {
        (&[w, x, y, z], &[s, a, b, c]) => {
            let (from, to) = (from_wxyz([w, x, y, z]), from_wxyz([s, a, b, c]));
            (to * from.inverse()).scaled_axis().iter().copied().collect()
        }
        _ => {
            let size = from.iter().chain(to).fold(0.0, |most: f64, one| most.max(one.abs()));
            let apart = to.iter().zip(from).map(|(to, from)| to - from);
            apart.map(|one| if one.abs() <= ROUNDING * size { 0.0 } else { one }).collect()
        }
    };
    let in_sigmas = difference.iter().zip(first.std.iter().zip(&later.std)).filter_map(
        |(difference, (one, other))| {
            let std = match (one, other) {
                (Some(one), Some(other)) => one.hypot(*other),
                (Some(std), None) | (None, Some(std)) => *std,
                (None, None) => return None,
            };
            Some(difference.abs() / std)
        },
    );
    Difference {
        size: Some(difference.iter().map(|number| number * number).sum::<f64>().sqrt()),
        in_sigma: in_sigmas.max_by(f64::total_cmp),
        difference: Some(difference),
    }
}
