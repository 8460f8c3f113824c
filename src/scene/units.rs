//! Lengths that look like another unit, or another direction of up, than the file says.

use nalgebra::{Matrix3, Vector3};

use super::gaps::{self, Gap};
use super::{DynamicBody, Scene, Shape, Warning};
use crate::words::{quoted, rounded};

/// What people mean instead of m: how many go into a metre, and the factor around that number
/// that still points to the unit. Wrong frame rates give factors too, hence the narrow ones.
const UNITS: [(&str, f64, f64); 4] =
    [("mm", 1000.0, 1.5), ("cm", 100.0, 1.5), ("inches", 39.37, 1.2), ("feet", 3.281, 1.05)];
/// For positions and sizes in another unit.
const MEND: &str =
    "give positions and sizes in m; `smash import` converts them from its `--length-unit`";
/// Gravity on Earth in m/s², to judge the stated value.
const EARTH_M_S2: f64 = 9.81;
/// A fitted acceleration counts if its standard error is below this fraction of it: half the
/// narrowest factor of a unit.
const SURE: f64 = 0.025;
/// A body of so many times the length of its own path is hardly in the path's unit.
const LARGEST_SIZE_PER_PATH: f64 = 10.0;
/// Gaps that are tried for the collision; more would tell no more.
const MOST_SPLITS: usize = 64;

/// Looks at gravity, at the fall of each body, and at its size.
pub(super) fn look(scene: &Scene) -> Vec<Warning> {
    let bodies = scene.bodies().iter();
    let gravity = stated_gravity(scene.gravity_m_s2());
    let falls = bodies.clone().filter_map(|body| fall(scene, body));
    gravity.into_iter().chain(falls).chain(bodies.filter_map(size)).collect()
}

fn stated_gravity(gravity_m_s2: f64) -> Option<Warning> {
    let unit = unit_of(gravity_m_s2 / EARTH_M_S2)?;
    Some(Warning {
        text: format!("`gravity` is {gravity_m_s2} m/s², which looks like {unit}/s²"),
        mend: "give gravity and all lengths in m".into(),
    })
}

fn fall(scene: &Scene, body: &DynamicBody) -> Option<Warning> {
    let acceleration = downward_acceleration(scene, body)?;
    let ratio = acceleration / scene.gravity_m_s2();
    let falls = format!("body {} falls with {acceleration:.4} m/s²", quoted(&body.name));
    // Twice gravity's tilt and scale at the most: a fall upwards is no small effect.
    if (-1.2..=-0.8).contains(&ratio) {
        let text = format!("{falls}: `up` seems to point down");
        return Some(Warning { text, mend: "turn the sign of `up`".into() });
    }
    let unit = unit_of(ratio)?;
    Some(Warning { text: format!("{falls}: its positions look like {unit}"), mend: MEND.into() })
}

fn size(body: &DynamicBody) -> Option<Warning> {
    let smallest = match body.shape {
        Shape::Box { size } => size.into_iter().fold(f64::INFINITY, f64::min),
        Shape::Sphere { radius } => 2.0 * radius,
    };
    let steps = body.observations.windows(2);
    let path: f64 =
        steps.map(|pair| (pair[1].position_in_world - pair[0].position_in_world).norm()).sum();
    (path > 0.0 && smallest > LARGEST_SIZE_PER_PATH * path).then(|| Warning {
        text: format!(
            "body {}: its size of {} m is more than {LARGEST_SIZE_PER_PATH} times its \
             path of {path:.4} m; the size looks like cm or mm",
            quoted(&body.name),
            rounded(smallest)
        ),
        mend: MEND.into(),
    })
}

/// The unit whose number in a metre the `ratio` is.
fn unit_of(ratio: f64) -> Option<&'static str> {
    let fits = |per_metre: f64, factor| (per_metre / factor..per_metre * factor).contains(&ratio);
    UNITS.iter().find(|&&(_, per_metre, factor)| fits(per_metre, factor)).map(|&(unit, ..)| unit)
}

/// The acceleration against `up` in m/s², if the longer side of the collision shows it clearly.
/// The collision is taken to be in the gap that leaves the two best parabolas.
fn downward_acceleration(scene: &Scene, body: &DynamicBody) -> Option<f64> {
    let up = scene.up_in_world();
    let start_s = body.observations.first()?.time_s;
    let heights: Vec<[f64; 2]> = body
        .observations
        .iter()
        .map(|seen| [seen.time_s - start_s, seen.position_in_world.dot(&up)])
        .collect();
    let gaps = scene.gaps();
    let splits = gaps.iter().step_by(gaps.len().div_ceil(MOST_SPLITS));
    let sides = splits.map(|gap: &Gap| heights.split_at(gaps::poses_before(body, gap)));
    let misfit = |side: &[[f64; 2]]| Parabola::fit(side).map_or(0.0, |fit| fit.squares);
    let (before, after) = sides
        .map(|(before, after)| (misfit(before) + misfit(after), (before, after)))
        .min_by(|one, other| one.0.total_cmp(&other.0))?
        .1;
    let span = |side: &[[f64; 2]]| side[side.len() - 1][0] - side[0][0];
    let longest = if span(before) > span(after) { before } else { after };
    let fit = Parabola::fit(longest)?;
    let is_sure = fit.acceleration_std < SURE * fit.acceleration.abs();
    is_sure.then_some(-fit.acceleration)
}

/// A least-squares parabola through heights over time.
struct Parabola {
    /// In m/s².
    acceleration: f64,
    /// Standard error of the acceleration, from the residuals.
    acceleration_std: f64,
    /// Sum of the squared residuals in m².
    squares: f64,
}

impl Parabola {
    /// `None` for fewer than 4 points: they leave no residual to judge by.
    fn fit(points: &[[f64; 2]]) -> Option<Parabola> {
        let (first, last) = (points.first()?, points.last()?);
        let spare = points.len().checked_sub(3).filter(|&spare| spare > 0)?;
        // Time from −1 to 1 keeps the normal equations well conditioned.
        let (middle, half) = (0.5 * (first[0] + last[0]), 0.5 * (last[0] - first[0]));
        let powers = |time: f64| {
            let t = (time - middle) / half;
            Vector3::new(1.0, t, t * t)
        };
        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for &[time, height] in points {
            let row = powers(time);
            normal += row * row.transpose();
            right += row * height;
        }
        let covariance = normal.try_inverse()?;
        let solution = covariance * right;
        let residual = |&[time, height]: &[f64; 2]| height - powers(time).dot(&solution);
        let squares: f64 = points.iter().map(|point| residual(point).powi(2)).sum();
        let to_acceleration = 2.0 / (half * half);
        let variance = covariance[(2, 2)] * squares / spare as f64;
        Some(Parabola {
            acceleration: to_acceleration * solution[2],
            acceleration_std: to_acceleration * variance.sqrt(),
            squares,
        })
    }
}
