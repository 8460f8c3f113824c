//! How large and how small a scene's numbers may be, and why.
//!
//! The bounds are far outside what a camera can see. They are there so that the squares and
//! quotients of the mechanics stay finite, and a slip such as `1e308` gets a message here.

use std::ops::RangeInclusive;

/// Coordinates in m: beyond 1000 km gravity isn't constant.
pub(crate) const POSITION_M: RangeInclusive<f64> = -1e6..=1e6;
/// Times in s: room for Unix time stamps, whose rounding is still below a microsecond.
pub(crate) const TIME_S: RangeInclusive<f64> = -1e10..=1e10;
/// The longest scene in s: a day; no flight takes so long.
pub(crate) const LONGEST_SPAN_S: f64 = 86_400.0;
/// Times nearer than this, in s, are one time: the rounding of frame / fps, not a motion.
pub(crate) const SAME_TIME_S: f64 = 1e-9;
/// Edges and radii in m: from a grain of dust to a mountain.
pub(crate) const SIZE_M: RangeInclusive<f64> = 1e-6..=1e4;
/// Frames per second: from a time lapse to the fastest cameras.
pub(crate) const FPS: RangeInclusive<f64> = 1e-3..=1e7;
/// Gravity in m/s²: mm/s² would be 9810, which gets a warning.
pub(crate) const GRAVITY_M_S2: RangeInclusive<f64> = 0.0..=1e5;
/// σ of positions in m, and of orientations in rad: a weight is its inverse square.
pub(crate) const NOISE: RangeInclusive<f64> = 1e-12..=1e3;
/// One pose's σ over the scene's: beyond, a pose is either all that counts or nothing.
pub(crate) const NOISE_SCALE: RangeInclusive<f64> = 1e-3..=1e3;
/// How far from 1 the length of a unit vector or quaternion may be; rounded text is within it.
pub(crate) const UNIT_TOLERANCE: f64 = 1e-2;
/// Poses of one body: a minute at 1600 frames per second.
pub(crate) const MOST_OBSERVATIONS: usize = 100_000;
/// Letters of a name: it stands in tables and on the command line.
pub(crate) const LONGEST_NAME: usize = 200;
/// The poses of each body that the collision needs on each side.
pub(crate) const LEAST_POSES: usize = 2;
/// The poses of each body on each side below which a fit can't be checked by its residuals.
pub(crate) const FEW_POSES: usize = 3;
