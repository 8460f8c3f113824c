//! The quantities that laws may name, and the registers that hold them.

use super::unit::Dimension;

/// How many registers the inputs take; the parameters follow.
pub const INPUTS: u16 = 49;

/// The first register of the orientation, w x y z, by which `rotate` turns.
pub(super) const ORIENTATION: u16 = 7;

/// A scalar, a vector, or the orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    Scalar,
    Vector,
    Quaternion,
}

/// A quantity of the model.
#[derive(Debug)]
pub(super) struct Name {
    pub text: &'static str,
    pub register: u16,
    pub shape: Shape,
    pub dimension: Dimension,
}

/// All of them. Vectors are in the world; `size` holds the full edges in the body's axes.
pub(super) const NAMES: [Name; 18] = [
    scalar("t", 0, TIME),
    vector("p", 1, LENGTH),
    vector("v", 4, VELOCITY),
    Name { text: "q", register: ORIENTATION, shape: Shape::Quaternion, dimension: Dimension::NONE },
    vector("w", 11, Dimension::of(0, -1, 0)),
    vector("L", 14, Dimension::of(2, -1, 0)),
    vector("up", 17, Dimension::NONE),
    vector("g", 20, Dimension::of(1, -2, 0)),
    vector("camera", 23, LENGTH),
    vector("normal", 26, Dimension::NONE),
    vector("size", 29, LENGTH),
    scalar("mass", 32, Dimension::of(0, 0, 1)),
    vector("J", 33, VELOCITY),
    vector("x", 36, LENGTH),
    vector("slip", 39, VELOCITY),
    vector("across1", 42, Dimension::NONE),
    vector("across2", 45, Dimension::NONE),
    scalar("t_c", 48, TIME),
];

const TIME: Dimension = Dimension::of(0, 1, 0);
const LENGTH: Dimension = Dimension::of(1, 0, 0);
const VELOCITY: Dimension = Dimension::of(1, -1, 0);

const fn scalar(text: &'static str, register: u16, dimension: Dimension) -> Name {
    Name { text, register, shape: Shape::Scalar, dimension }
}

const fn vector(text: &'static str, register: u16, dimension: Dimension) -> Name {
    Name { text, register, shape: Shape::Vector, dimension }
}
