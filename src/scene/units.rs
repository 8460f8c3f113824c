//! Lengths that look like another unit, another direction of up, or another frame rate, than the file says.

use nalgebra::{Matrix3, UnitVector3, Vector3};

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
/// A fall along another axis is one if it differs by less than this share of gravity: its tilt and scale
/// at the most, for a fall sideways is no small effect.
const SURELY_OTHER: f64 = 0.2;
/// A fitted acceleration counts if its standard error is below this fraction of it: half the
/// narrowest factor of a unit.
const SURE: f64 = 0.025;
/// A body of so many times the length of its own path is hardly in the path's unit.
const LARGEST_SIZE_PER_PATH: f64 = 10.0;
/// Frame rates that cameras have.
const FRAME_RATES: [f64; 25] = [
    12.0, 15.0, 18.0, 24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 72.0, 90.0, 96.0, 100.0, 120.0, 144.0,
    150.0, 180.0, 200.0, 240.0, 250.0, 300.0, 480.0, 500.0, 960.0, 1000.0,
];
/// A frame rate is doubted only where the fall is so many times gravity, or less by as much: nearer to it,
/// an effect may be what is missing.
const LEAST_FACTOR: f64 = 1.5;
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
    let acceleration = acceleration(scene, body)?;
    if let Some(up) = up_of(scene, acceleration) {
        let text = format!(
            "body {} falls along {} with {:.4} m/s²: `up` seems to be {}",
            quoted(&body.name),
            direction_in_words((-up).into_inner().into()),
            acceleration.norm(),
            direction_in_words(up.into_inner().into())
        );
        return Some(Warning { text, mend: "give `up` as the direction against gravity".into() });
    }
    let down = -acceleration.dot(&scene.up_in_world());
    let falls = format!("body {} falls with {down:.4} m/s²", quoted(&body.name));
    if let Some(fps) = fps_of(scene, acceleration) {
        let text = format!("{falls}: `fps` seems to be {fps}");
        return Some(Warning { text, mend: "check `fps`, or else the unit of lengths".into() });
    }
    let unit = unit_of(down / scene.gravity_m_s2())?;
    Some(Warning { text: format!("{falls}: its positions look like {unit}"), mend: MEND.into() })
}

/// The direction against gravity that all bodies' flights show, where it is another axis than the
/// stated `up`.
pub(crate) fn seen_up(scene: &Scene) -> Option<UnitVector3<f64>> {
    seen_by_all(scene, |acceleration| up_of(scene, acceleration))
}

/// The usual frame rate that all bodies' falls show, where it is far from the stated one.
pub(crate) fn seen_fps(scene: &Scene) -> Option<f64> {
    seen_by_all(scene, |acceleration| fps_of(scene, acceleration))
}

/// What the accelerations of all bodies say alike.
fn seen_by_all<T: PartialEq>(scene: &Scene, what: impl Fn(Vector3<f64>) -> Option<T>) -> Option<T> {
    let mut seen = scene.bodies().iter().map(|body| what(acceleration(scene, body)?));
    let first = seen.next()??;
    seen.all(|other| other.as_ref() == Some(&first)).then_some(first)
}

/// The frame rate at which `acceleration` would be that of gravity.
fn fps_of(scene: &Scene, acceleration: Vector3<f64>) -> Option<f64> {
    let in_gravity = -acceleration / scene.gravity_m_s2();
    let ratio = in_gravity.dot(&scene.up_in_world());
    let aside = in_gravity - ratio * scene.up_in_world().into_inner();
    let is_far = !(1.0 / LEAST_FACTOR..LEAST_FACTOR).contains(&ratio) && unit_of(ratio).is_none();
    if !is_far || aside.norm() > SURELY_OTHER * ratio {
        return None;
    }
    let seen = scene.fps()? / ratio.sqrt();
    FRAME_RATES.into_iter().find(|rate| (seen / rate - 1.0).abs() < SURE)
}

/// The axis against which gravity of about the stated size would give `acceleration`, where that isn't
/// `up`.
fn up_of(scene: &Scene, acceleration: Vector3<f64>) -> Option<UnitVector3<f64>> {
    let up = scene.up_in_world();
    let axes = [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()];
    let others = axes.into_iter().flat_map(|axis| [axis, -axis]).filter(|axis| axis.dot(&up) < 0.5);
    let is_it = |other: &UnitVector3<f64>| {
        (acceleration / scene.gravity_m_s2() + other.into_inner()).norm() < SURELY_OTHER
    };
    std::iter::once(-up).chain(others).find(is_it)
}

/// `[0, 0, 1]`.
pub(crate) fn direction_in_words(direction: [f64; 3]) -> String {
    format!("[{}]", direction.map(rounded).join(", "))
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

/// The acceleration in m/s², if the longer side of the collision shows it clearly. The collision is
/// taken to be in the gap that leaves the best parabolas.
fn acceleration(scene: &Scene, body: &DynamicBody) -> Option<Vector3<f64>> {
    let start_s = body.observations.first()?.time_s;
    let path: Vec<(f64, Vector3<f64>)> = body
        .observations
        .iter()
        .map(|seen| (seen.time_s - start_s, seen.position_in_world))
        .collect();
    let gaps = scene.gaps();
    let splits = gaps.iter().step_by(gaps.len().div_ceil(MOST_SPLITS));
    let sides = splits.map(|gap: &Gap| path.split_at(gaps::poses_before(body, gap)));
    let misfit = |side: &[(f64, Vector3<f64>)]| Parabola::fit(side).map_or(0.0, |fit| fit.squares);
    let (before, after) = sides
        .map(|(before, after)| (misfit(before) + misfit(after), (before, after)))
        .min_by(|one, other| one.0.total_cmp(&other.0))?
        .1;
    let span = |side: &[(f64, Vector3<f64>)]| side[side.len() - 1].0 - side[0].0;
    let longest = if span(before) > span(after) { before } else { after };
    let fit = Parabola::fit(longest)?;
    (fit.acceleration_std < SURE * fit.acceleration.norm()).then_some(fit.acceleration)
}

/// A least-squares parabola through positions over time.
struct Parabola {
    /// In m/s².
    acceleration: Vector3<f64>,
    /// Standard error of each of its components, from the residuals.
    acceleration_std: f64,
    /// Sum of the squared residuals in m².
    squares: f64,
}

impl Parabola {
    /// `None` for fewer than 4 points: they leave no residual to judge by.
    fn fit(points: &[(f64, Vector3<f64>)]) -> Option<Parabola> {
        let (first, last) = (points.first()?.0, points.last()?.0);
        let spare = points.len().checked_sub(3).filter(|&spare| spare > 0)?;
        // Time from −1 to 1 keeps the normal equations well conditioned.
        let (middle, half) = (0.5 * (first + last), 0.5 * (last - first));
        let powers = |time: f64| {
            let t = (time - middle) / half;
            Vector3::new(1.0, t, t * t)
        };
        let mut normal = Matrix3::zeros();
        let mut right = Matrix3::zeros();
        for (time, position) in points {
            let row = powers(*time);
            normal += row * row.transpose();
            right += row * position.transpose();
        }
        let covariance = normal.try_inverse()?;
        let solution = covariance * right;
        let residual =
            |(time, position): &(f64, Vector3<f64>)| position - solution.tr_mul(&powers(*time));
        let squares: f64 = points.iter().map(|point| residual(point).norm_squared()).sum();
        let to_acceleration = 2.0 / (half * half);
        let variance = covariance[(2, 2)] * squares / (3 * spare) as f64;
        Some(Parabola {
            acceleration: to_acceleration * solution.row(2).transpose(),
            acceleration_std: to_acceleration * variance.sqrt(),
            squares,
        })
    }
}
