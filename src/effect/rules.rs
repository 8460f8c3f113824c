//! What the operators make of shapes and units.

use std::ops::Range;

use super::check::{Checked, Meaning, Value};
use super::evaluate::of_scalars;
use super::mistake::Mistake;
use super::names::Shape;
use super::parse::Binary;
use super::program::Operation;
use super::unit::Dimension;
use crate::words::quoted;

pub(super) fn negative(of: Value, span: Range<usize>) -> Checked {
    let operation = match of.shape {
        Shape::Scalar => Operation::Neg,
        Shape::Vector => Operation::VNeg,
        Shape::Quaternion => return Err(orientation_alone(of.span)),
    };
    Ok(applied(operation, of.shape, of.dimension, vec![of], span))
}

pub(super) fn binary(binary: Binary, left: Value, right: Value, span: Range<usize>) -> Checked {
    use Shape::{Quaternion, Scalar, Vector};
    for side in [&left, &right] {
        if side.shape == Quaternion {
            return Err(orientation_alone(side.span.clone()));
        }
    }
    let shapes = (left.shape, right.shape);
    let of = |value: &Value| value.dimension.unwrap_or(Dimension::NONE);
    let (product, quotient) = (of(&left).times(of(&right)), of(&left).over(of(&right)));
    let both = |operation, shape, dimension, left, right| {
        Ok(applied(operation, shape, dimension, vec![left, right], span.clone()))
    };
    match (binary, shapes) {
        (Binary::Power, _) => power(vec![left, right], span),
        (Binary::Multiply, (Vector, Vector)) => {
            let mend = "write dot(a, b) or cross(a, b)";
            Err(Mistake::new(span, "two vectors have two products", mend))
        }
        (Binary::Multiply, (Scalar, Scalar)) => {
            both(Operation::Mul, Scalar, Some(product), left, right)
        }
        (Binary::Multiply, (Vector, _)) => {
            both(Operation::VScale, Vector, Some(product), right, left)
        }
        (Binary::Multiply, _) => both(Operation::VScale, Vector, Some(product), left, right),
        (Binary::Divide, (_, Vector)) => {
            let mend = "divide by norm(…), or by a component";
            Err(Mistake::new(right.span, "nothing can be divided by a vector", mend))
        }
        (Binary::Divide, (Scalar, _)) => both(Operation::Div, Scalar, Some(quotient), left, right),
        (Binary::Divide, _) => both(Operation::VDiv, Vector, Some(quotient), left, right),
        (Binary::Add | Binary::Subtract, (Scalar, Vector) | (Vector, Scalar)) => {
            let problem =
                format!("{} and {} can't be added", left.shape.noun(), right.shape.noun());
            let mend = "multiply the number by a direction, such as `up`";
            Err(Mistake::new(span, problem, mend))
        }
        (Binary::Add | Binary::Subtract, (shape, _)) => {
            let dimension = common([&left, &right], &span)?;
            let operation = match (binary, shape) {
                (Binary::Add, Scalar) => Operation::Add,
                (Binary::Add, _) => Operation::VAdd,
                (_, Scalar) => Operation::Sub,
                _ => Operation::VSub,
            };
            both(operation, shape, dimension, left, right)
        }
    }
}

/// Of a base and an exponent.
pub(super) fn power(values: Vec<Value>, span: Range<usize>) -> Checked {
    let (base, exponent) = (&values[0], &values[1]);
    for (side, mend) in [(base, "write dot(v, v), or norm(v)^2"), (exponent, "take a component")] {
        if side.shape != Shape::Scalar {
            let problem = format!("{} has no place in a power", side.shape.noun());
            return Err(Mistake::new(side.span.clone(), problem, mend));
        }
    }
    if exponent.dimension.is_some_and(|found| found != Dimension::NONE) {
        return Err(not_pure(exponent));
    }
    let own = base.dimension.unwrap_or(Dimension::NONE);
    let dimension = match exponent.meaning {
        _ if own == Dimension::NONE => Some(own),
        Meaning::Constant(value) => own.to_the(value),
        _ => None,
    };
    if dimension.is_none() {
        let problem = format!("a power of what is in {own} has a unit only for a plain exponent");
        let mend = "divide the base by a value in its unit, or write the exponent as a number";
        return Err(Mistake::new(exponent.span.clone(), problem, mend));
    }
    Ok(applied(Operation::Pow, Shape::Scalar, dimension, values, span))
}

pub(super) fn component(of: Value, axis: &str, span: Range<usize>) -> Checked {
    if of.shape != Shape::Vector {
        let problem = format!("{} has no components", of.shape.noun());
        return Err(Mistake::new(span, problem, "take the components of a vector"));
    }
    let Some(index) = ["x", "y", "z"].iter().position(|known| *known == axis) else {
        let problem = format!("a vector has no component {}", quoted(axis));
        return Err(Mistake::new(span, problem, "write .x, .y or .z"));
    };
    let dimension = of.dimension;
    let meaning = Meaning::Component(Box::new(of), index as u16);
    Ok(Value { meaning, shape: Shape::Scalar, dimension, span })
}

pub(super) fn vector(items: Vec<Value>, span: Range<usize>) -> Checked {
    if items.len() != 3 {
        let problem = format!("a vector has 3 components, not {}", items.len());
        return Err(Mistake::new(span, problem, "write [x, y, z]"));
    }
    for item in &items {
        expect_scalar(item)?;
    }
    let dimension = common([&items[0], &items[1], &items[2]], &span)?;
    Ok(Value { meaning: Meaning::Vector(items), shape: Shape::Vector, dimension, span })
}

/// The operation; where all it takes are numbers, its result.
pub(super) fn applied(
    operation: Operation,
    shape: Shape,
    dimension: Option<Dimension>,
    values: Vec<Value>,
    span: Range<usize>,
) -> Value {
    let constants: Vec<f64> = values.iter().map_while(constant).collect();
    let meaning = if shape == Shape::Scalar && constants.len() == values.len() {
        Meaning::Constant(of_scalars(operation, constants[0], *constants.get(1).unwrap_or(&0.0)))
    } else {
        Meaning::Apply(operation, values)
    };
    Value { meaning, shape, dimension, span }
}

fn constant(value: &Value) -> Option<f64> {
    match value.meaning {
        Meaning::Constant(number) => Some(number),
        _ => None,
    }
}

/// The unit that all share.
pub(super) fn common<'a>(
    values: impl IntoIterator<Item = &'a Value>,
    span: &Range<usize>,
) -> Result<Option<Dimension>, Mistake> {
    let mut shared: Option<Dimension> = None;
    for value in values {
        match (shared, value.dimension) {
            (Some(one), Some(other)) if one != other => {
                let problem = format!("{one} and {other} don't go together");
                let has_bare_number = [one, other].contains(&Dimension::NONE);
                let mend = if has_bare_number {
                    "a bare number has no unit: make it a parameter that has one"
                } else {
                    "bring both to the same unit"
                };
                return Err(Mistake::new(span.clone(), problem, mend));
            }
            (None, found) => shared = found,
            _ => {}
        }
    }
    Ok(shared)
}

fn expect_scalar(value: &Value) -> Result<(), Mistake> {
    match value.shape {
        Shape::Scalar => Ok(()),
        other => {
            let problem = format!("{} can't be a component", other.noun());
            Err(Mistake::new(value.span.clone(), problem, "write a number"))
        }
    }
}

pub(super) fn not_pure(value: &Value) -> Mistake {
    let found = value.dimension.unwrap_or(Dimension::NONE);
    let problem = format!("a pure number must stand here, and this is in {found}");
    Mistake::new(value.span.clone(), problem, "divide it by a value in the same unit")
}

pub(super) fn orientation_alone(span: Range<usize>) -> Mistake {
    let mend = "write rotate(v), body to world, or unrotate(v), world to body";
    Mistake::new(span, "the orientation `q` can't be reckoned with by itself", mend)
}
