//! Checks of single values: finite, positive, of unit length.

use nalgebra::{Quaternion, UnitQuaternion, UnitVector3, Vector3};

use crate::{Error, Result};

/// How far from 1 the length of a direction or quaternion may be; it is normalised then.
const UNIT_TOLERANCE: f64 = 1e-2;

pub(super) fn finite(place: &str, value: f64) -> Result<f64> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(Error::invalid(place, format!("is {value}")).mend("give a finite number"))
}

pub(super) fn positive(place: &str, value: f64) -> Result<f64> {
    if finite(place, value)? > 0.0 {
        return Ok(value);
    }
    Err(Error::invalid(place, format!("is {value}")).mend("give a number above 0"))
}

/// A field that this kind of body or collision must have.
pub(super) fn required<T: Copy>(place: &str, value: Option<T>, why: &str) -> Result<T> {
    value.ok_or_else(|| Error::invalid(place, "is missing").mend(why))
}

/// A field that this kind of body or collision mustn't have.
pub(super) fn absent<T>(place: &str, value: &Option<T>, why: &str) -> Result<()> {
    match value {
        None => Ok(()),
        Some(_) => Err(Error::invalid(place, "doesn't belong here").mend(why)),
    }
}

pub(super) fn vector(place: &str, value: [f64; 3]) -> Result<Vector3<f64>> {
    for (axis, component) in value.into_iter().enumerate() {
        finite(&format!("{place}[{axis}]"), component)?;
    }
    Ok(Vector3::from(value))
}

pub(super) fn direction(place: &str, value: [f64; 3]) -> Result<UnitVector3<f64>> {
    let vector = vector(place, value)?;
    let length = vector.norm();
    if (length - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(UnitVector3::new_normalize(vector));
    }
    Err(not_unit(place, &value, length, "[0, 1, 0]"))
}

pub(super) fn orientation(place: &str, value: [f64; 4]) -> Result<UnitQuaternion<f64>> {
    for (index, component) in value.into_iter().enumerate() {
        finite(&format!("{place}[{index}]"), component)?;
    }
    let [w, x, y, z] = value;
    let quaternion = Quaternion::new(w, x, y, z);
    let length = quaternion.norm();
    if (length - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(UnitQuaternion::from_quaternion(quaternion));
    }
    Err(not_unit(place, &value, length, "[1, 0, 0, 0]"))
}

fn not_unit(place: &str, value: &[f64], length: f64, example: &str) -> Error {
    let error = Error::invalid(place, format!("{value:?} has the length {length:.6}"));
    if length > 0.0 && length.is_finite() {
        let scaled: Vec<String> = value.iter().map(|x| format!("{:.6}", x / length)).collect();
        error.mend(format!("make its length 1: [{}]", scaled.join(", ")))
    } else {
        error.mend(format!("make its length 1, such as {example}"))
    }
}
