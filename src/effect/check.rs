//! What an expression means: names become registers, and shapes and units are checked.

use std::f64::consts::PI;
use std::ops::Range;

use super::functions::{FUNCTIONS, Rule, function};
use super::hook::Hook;
use super::mistake::Mistake;
use super::names::{NAMES, Shape};
use super::parse::{Expression, Kind};
use super::program::Operation;
use super::unit::Dimension;
use super::{calls, rules};
use crate::words::{counted, did_you_mean, quoted};

/// An expression that is understood.
#[derive(Debug)]
pub(super) struct Value {
    pub meaning: Meaning,
    pub shape: Shape,
    /// `None` for the number 0, which fits every unit.
    pub dimension: Option<Dimension>,
    pub span: Range<usize>,
}

#[derive(Debug)]
pub(super) enum Meaning {
    Constant(f64),
    /// An input or a parameter.
    Known(u16),
    /// Of a vector: 0, 1 or 2.
    Component(Box<Value>, u16),
    Vector(Vec<Value>),
    Apply(Operation, Vec<Value>),
}

/// A parameter, as laws see it.
#[derive(Debug, Clone)]
pub(super) struct KnownParameter<'a> {
    pub name: &'a str,
    pub register: u16,
    pub shape: Shape,
    pub dimension: Dimension,
}

/// What the names in a law may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scope<'a> {
    pub hook: Hook,
    pub parameters: &'a [KnownParameter<'a>],
}

pub(super) type Checked = Result<Value, Mistake>;

impl Scope<'_> {
    /// Checks an expression and what it is made of.
    pub(super) fn check(self, expression: &Expression<'_>) -> Checked {
        let span = expression.span.clone();
        match &expression.kind {
            Kind::Number(value) => {
                let dimension = (*value != 0.0).then_some(Dimension::NONE);
                Ok(Value {
                    meaning: Meaning::Constant(*value),
                    shape: Shape::Scalar,
                    dimension,
                    span,
                })
            }
            Kind::Name(name) => self.name(name, span),
            Kind::Negative(of) => rules::negative(self.check(of)?, span),
            Kind::Binary(binary, parts) => {
                let [left, right] = &**parts;
                rules::binary(*binary, self.check(left)?, self.check(right)?, span)
            }
            Kind::Component(of, axis) => rules::component(self.check(of)?, axis, span),
            Kind::Call { name, name_span, arguments } => {
                self.call(name, name_span, arguments, span)
            }
            Kind::Vector(items) => {
                let items = items.iter().map(|item| self.check(item));
                rules::vector(items.collect::<Result<_, _>>()?, span)
            }
        }
    }

    fn name(self, text: &str, span: Range<usize>) -> Checked {
        if text == "pi" {
            return Ok(scalar(Meaning::Constant(PI), Dimension::NONE, span));
        }
        if let Some(own) = self.parameters.iter().find(|parameter| parameter.name == text) {
            let (meaning, dimension) = (Meaning::Known(own.register), Some(own.dimension));
            return Ok(Value { meaning, shape: own.shape, dimension, span });
        }
        let hook = self.hook;
        match NAMES.iter().find(|name| name.text == text) {
            Some(name) if hook.scope().contains(&text) => {
                let (meaning, dimension) = (Meaning::Known(name.register), Some(name.dimension));
                Ok(Value { meaning, shape: name.shape, dimension, span })
            }
            Some(_) => {
                let problem = format!("{} isn't known in `{hook}`", quoted(text));
                Err(Mistake::new(span, problem, self.known_names()))
            }
            None if function(text).is_some() => {
                let problem = format!("{} is a function", quoted(text));
                Err(Mistake::new(span, problem, format!("write {text}(…)")))
            }
            None => {
                let problem = format!("{} is unknown", quoted(text));
                let known: Vec<&str> = self.names().chain(["pi"]).collect();
                Err(Mistake::new(span, problem, did_you_mean(text, &known)))
            }
        }
    }

    fn names(&self) -> impl Iterator<Item = &str> {
        let inputs = self.hook.scope().iter().copied();
        self.parameters.iter().map(|parameter| parameter.name).chain(inputs)
    }

    fn known_names(&self) -> String {
        format!("known here: {}", self.names().collect::<Vec<_>>().join(" "))
    }

    fn call(
        self,
        name: &str,
        name_span: &Range<usize>,
        arguments: &[Expression<'_>],
        span: Range<usize>,
    ) -> Checked {
        let Some(rule) = function(name) else {
            let known = FUNCTIONS.map(|(known, _)| known);
            let is_name = self.names().any(|known| known == name);
            let mend = if is_name {
                "write `*` before the bracket".into()
            } else {
                did_you_mean(name, &known)
            };
            let problem = format!("{} is no function", quoted(name));
            return Err(Mistake::new(name_span.clone(), problem, mend));
        };
        if matches!(rule, Rule::Turns(_)) && !self.hook.scope().contains(&"q") {
            let problem = format!("the orientation isn't known in `{}`", self.hook);
            return Err(Mistake::new(name_span.clone(), problem, self.known_names()));
        }
        let wanted = rule.arguments();
        if arguments.len() != wanted {
            let wanted = counted(wanted, "argument");
            let problem = format!("`{name}` takes {wanted}, not {}", arguments.len());
            return Err(Mistake::new(span, problem, format!("give it {wanted}")));
        }
        let arguments = arguments.iter().map(|argument| self.check(argument));
        calls::apply(name, rule, arguments.collect::<Result<_, _>>()?, span)
    }
}

impl Value {
    /// Checks that this is what `hook` is to be.
    pub(super) fn fits(&self, hook: Hook) -> Result<(), Mistake> {
        let wanted = if hook.length() == 3 { Shape::Vector } else { Shape::Scalar };
        if self.shape != wanted {
            let problem =
                format!("`{hook}` must be {}, and this is {}", wanted.noun(), self.shape.noun());
            let mend = match wanted {
                Shape::Vector => "multiply it by a direction, or write [x, y, z]",
                _ => "take a component (v.x), norm(v) or dot(a, b)",
            };
            return Err(Mistake::new(self.span.clone(), problem, mend));
        }
        match self.dimension {
            Some(found) if found != hook.dimension() => {
                let problem =
                    format!("`{hook}` must be in {}, and this is in {found}", hook.dimension());
                Err(Mistake::new(
                    self.span.clone(),
                    problem,
                    "check the law and its parameters' units",
                ))
            }
            _ => Ok(()),
        }
    }
}

impl Shape {
    pub(super) fn noun(self) -> &'static str {
        match self {
            Shape::Scalar => "a number",
            Shape::Vector => "a vector",
            Shape::Quaternion => "the orientation",
        }
    }
}

fn scalar(meaning: Meaning, dimension: Dimension, span: Range<usize>) -> Value {
    Value { meaning, shape: Shape::Scalar, dimension: Some(dimension), span }
}
