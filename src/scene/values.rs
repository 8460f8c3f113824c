//! The rules of single values: ranges, unit lengths, names.

use std::ops::RangeInclusive;

use nalgebra::{UnitQuaternion, UnitVector3, Vector3};

use super::Noise;
use super::bounds::{LONGEST_NAME, NOISE, NOISE_SCALE, POSITION_M, UNIT_TOLERANCE};
use crate::rigid_body::quaternion::from_wxyz;
use crate::words::{limit, quoted, rounded};
use crate::{Error, Result};

/// Names stand in tables and on terminals.
pub(crate) fn check_name(place: &str, name: &str) -> Result<()> {
    let letters = name.chars().count();
    if letters > LONGEST_NAME {
        let problem = format!("{} has {letters} letters", quoted(name));
        return Err(Error::invalid(place, problem)
            .mend(format!("shorten it to {LONGEST_NAME} letters or fewer")));
    }
    if name.chars().any(char::is_control) {
        let problem = format!("{} holds control characters", quoted(name));
        return Err(Error::invalid(place, problem).mend("use letters, digits and spaces"));
    }
    Ok(())
}

/// A point in the world, in m.
pub(crate) fn position(place: &str, coordinates: [f64; 3]) -> Result<Vector3<f64>> {
    for (axis, &value) in coordinates.iter().enumerate() {
        check_range(&format!("{place}[{axis}]"), value, &POSITION_M, "give coordinates in m")?;
    }
    Ok(Vector3::from(coordinates))
}

pub(crate) fn unit_vector(place: &str, coordinates: [f64; 3]) -> Result<UnitVector3<f64>> {
    let length = unit_length(place, &coordinates)?;
    Ok(UnitVector3::new_unchecked(Vector3::from(coordinates) / length))
}

pub(crate) fn unit_quaternion(place: &str, wxyz: [f64; 4]) -> Result<UnitQuaternion<f64>> {
    let length = unit_length(place, &wxyz)?;
    Ok(from_wxyz(wxyz.map(|component| component / length)))
}

/// The length of what should have length 1; exactly 1 if it is 1 but for rounding, so that what
/// was normalised once stays as it is.
fn unit_length(place: &str, values: &[f64]) -> Result<f64> {
    let length = values.iter().fold(0.0, |sum: f64, value| sum.hypot(*value));
    if (length - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Ok(1.0);
    }
    // Written so that a NaN fails.
    if (length - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(length);
    }
    // Seven digits are enough to see what is wrong.
    let problem = format!("{values:?} has length {}, not 1", length as f32);
    let error = Error::invalid(place, problem);
    Err(if length == 0.0 && values.len() == 4 {
        error.mend("leave `orientation` out if it wasn't measured")
    } else if length.is_normal() && length < 1e100 {
        let unit: Vec<_> = values.iter().map(|value| rounded(value / length)).collect();
        error.mend(format!("divide it by its length: [{}]", unit.join(", ")))
    } else {
        error.mend("give a vector of length 1")
    })
}

/// A NaN is in no range.
pub(crate) fn check_range(
    place: &str,
    value: f64,
    range: &RangeInclusive<f64>,
    mend: &str,
) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    let (least, most) = (limit(*range.start()), limit(*range.end()));
    let problem = format!("{value:?} is not within {least} to {most}");
    Err(Error::invalid(place, problem).mend(mend))
}

/// One σ of positions and of orientations.
pub(crate) fn check_noise(place: &str, noise: &Noise) -> Result<()> {
    let mend = "give one σ in m, above 0";
    check_range(&format!("{place}.position"), noise.position, &NOISE, mend)?;
    let mend = "give one σ in rad, above 0; where no orientation is measured, any will do";
    check_range(&format!("{place}.orientation"), noise.orientation, &NOISE, mend)
}

/// One pose's σ over the scene's.
pub(crate) fn check_noise_scale(place: &str, scale: f64) -> Result<()> {
    let mend =
        "give how many times as noisy the pose is as the others; 1, or nothing, for as noisy";
    check_range(place, scale, &NOISE_SCALE, mend)
}

/// A field that this kind of body has.
pub(crate) fn needed<T>(place: &str, field: &str, value: Option<T>, why: &str) -> Result<T> {
    value.ok_or_else(|| {
        Error::invalid(place, format!("the field `{field}` is missing: {why}"))
            .mend(format!("add `{field}`"))
    })
}

/// A field that this kind of body hasn't.
pub(crate) fn refuse(place: &str, field: &str, is_there: bool, why: &str) -> Result<()> {
    if is_there {
        return Err(Error::invalid(format!("{place}.{field}"), format!("is out of place: {why}"))
            .mend(format!("remove `{field}`")));
    }
    Ok(())
}
