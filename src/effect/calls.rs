//! What the functions make of shapes and units.

use std::ops::Range;

use super::check::{Checked, Value};
use super::functions::Rule;
use super::mistake::Mistake;
use super::names::Shape;
use super::program::Operation;
use super::rules::{applied, common, not_pure, orientation_alone, power};
use super::unit::Dimension;

/// A function of `arguments`, of which there are as many as it takes.
pub(super) fn apply(name: &str, rule: Rule, arguments: Vec<Value>, span: Range<usize>) -> Checked {
    for argument in &arguments {
        match (rule.takes_vectors(), argument.shape) {
            (true, Shape::Vector) | (false, Shape::Scalar) => {}
            (_, Shape::Quaternion) => return Err(orientation_alone(argument.span.clone())),
            (true, Shape::Scalar) => {
                let problem = format!("`{name}` takes a vector, and this is a number");
                let mend = "write abs(x) for a number's size, or give it a vector";
                return Err(Mistake::new(argument.span.clone(), problem, mend));
            }
            (false, Shape::Vector) => {
                let problem = format!("`{name}` takes a number, and this is a vector");
                let mend = "write norm(v) for a vector's size, or take a component";
                return Err(Mistake::new(argument.span.clone(), problem, mend));
            }
        }
    }
    let of = |index: usize| arguments[index].dimension.unwrap_or(Dimension::NONE);
    let (scalar, vector, pure) = (Shape::Scalar, Shape::Vector, Some(Dimension::NONE));
    let (operation, shape, dimension) = match rule {
        Rule::Pure(_) if of(0) != Dimension::NONE => return Err(not_pure(&arguments[0])),
        Rule::Pure(operation) => (operation, scalar, pure),
        Rule::Keeps(operation) => (operation, scalar, arguments[0].dimension),
        Rule::Drops(operation) => (operation, scalar, pure),
        Rule::Root => {
            let root = of(0).to_the(0.5).ok_or_else(|| {
                let problem = format!("the root of what is in {} has no sensible unit", of(0));
                Mistake::new(span.clone(), problem, "check the units under the root")
            })?;
            (Operation::Sqrt, scalar, Some(root))
        }
        Rule::Alike(operation) => (operation, scalar, common(&arguments, &span)?),
        Rule::Compares(operation) => {
            common(&arguments, &span)?;
            (operation, scalar, pure)
        }
        Rule::Dot => (Operation::Dot, scalar, Some(of(0).times(of(1)))),
        Rule::Cross => (Operation::Cross, vector, Some(of(0).times(of(1)))),
        Rule::Norm => (Operation::Norm, scalar, arguments[0].dimension),
        Rule::Unit => (Operation::Unit, vector, pure),
        Rule::Turns(operation) => (operation, vector, arguments[0].dimension),
        Rule::Power => return power(arguments, span),
        Rule::Clamp => {
            let dimension = common(&arguments, &span)?;
            let mut arguments = arguments;
            let highest = arguments.pop();
            let inner = applied(Operation::Max, scalar, dimension, arguments, span.clone());
            let both = [Some(inner), highest].into_iter().flatten().collect();
            return Ok(applied(Operation::Min, scalar, dimension, both, span));
        }
    };
    Ok(applied(operation, shape, dimension, arguments, span))
}
