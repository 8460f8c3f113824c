//! The parameters of an effect, from its file to the registers that laws find them in.

use super::check::KnownParameter;
use super::file::{Null, ParameterFile};
use super::functions::FUNCTIONS;
use super::names::{INPUTS, NAMES, Shape};
use super::unit::Unit;
use super::{Frame, Parameter};
use crate::words::{limit, quoted};
use crate::{Error, ErrorKind, Result};

/// The bounds of a parameter whose file states none.
const WIDEST: [f64; 2] = [-1e6, 1e6];

/// A result with larger numbers couldn't be read back.
const LARGEST: f64 = 1e100;

/// The longest name of an effect or a parameter, in letters.
const LONGEST_NAME: usize = 40;

/// Checks that `text` can be read as one word wherever it stands.
pub(super) fn check_name(text: &str) -> Result<()> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let starts_well = text.starts_with(|c: char| c.is_ascii_alphabetic());
    if starts_well && text.chars().all(is_part) && text.len() <= LONGEST_NAME {
        return Ok(());
    }
    let error = Error::new(ErrorKind::Invalid, format!("{} can't be a name", quoted(text)));
    let mend = "use letters, digits and `_`, at most 40, and start with a letter";
    Err(error.mend(mend))
}

/// Checks a parameter.
pub(super) fn parameter((name, file): (String, ParameterFile)) -> Result<Parameter> {
    let place = format!("parameters.{name}");
    check_name(&name).map_err(|error| error.at("parameters"))?;
    let taken = NAMES.iter().map(|known| known.text).chain(FUNCTIONS.map(|known| known.0));
    if taken.chain(["pi"]).any(|known| known == name) {
        let problem = format!("{} means something else in laws already", quoted(&name));
        return Err(Error::invalid(place, problem).mend("give the parameter another name"));
    }
    let unit = Unit::parse(&file.unit)
        .map_err(|mistake| mistake.in_text(&file.unit, &format!("{place}.unit")))?;
    let null = match file.null {
        Null::Scalar(value) => vec![value],
        Null::Vector(values) => values.to_vec(),
    };
    let bounds = file.bounds.unwrap_or(WIDEST);
    let [low, high] = bounds;
    if low >= high {
        let problem = format!("{} isn't below {}", limit(low), limit(high));
        return Err(
            Error::invalid(format!("{place}.bounds"), problem).mend("the least comes first")
        );
    }
    if bounds.iter().chain(&file.scale).any(|number| number.abs() > LARGEST) {
        let problem = format!("holds a number beyond {}", limit(LARGEST));
        return Err(Error::invalid(place, problem).mend("no quantity of a collision is so large"));
    }
    if let Some(outside) = null.iter().find(|value| !(low..=high).contains(value)) {
        let (low, high) = (limit(low), limit(high));
        let problem = format!("{} is outside the bounds, {low} to {high}", limit(*outside));
        let mend = "without the effect the model is the base model: let the bounds hold the null";
        return Err(Error::invalid(format!("{place}.null"), problem).mend(mend));
    }
    let scale = file.scale.unwrap_or_else(|| default_scale(&null, file.bounds));
    if scale <= 0.0 {
        let error =
            Error::invalid(format!("{place}.scale"), format!("{} isn't above 0", limit(scale)));
        return Err(error.mend("write a typical size"));
    }
    if null.len() == 1 && file.frame != Frame::World {
        let error = Error::invalid(format!("{place}.frame"), "only a vector has a frame");
        return Err(error.mend("leave it out, or write three numbers as `null`"));
    }
    let (frame, typical, scan) = (file.frame, file.typical, file.scan);
    Ok(Parameter { name, unit, null, bounds, scale, frame, typical, scan })
}

/// A hundredth of the way to the nearer bound that isn't at the null itself.
fn default_scale(null: &[f64], bounds: Option<[f64; 2]>) -> f64 {
    let Some(bounds) = bounds else {
        return 1.0;
    };
    let ways = null.iter().flat_map(|value| bounds.map(|bound| (bound - value).abs()));
    let nearest = ways.filter(|&way| way > 0.0).fold(f64::INFINITY, f64::min);
    nearest / 100.0
}

/// The parameters as laws see them: one after the other, behind the inputs.
pub(super) fn known_parameters(parameters: &[Parameter]) -> Vec<KnownParameter<'_>> {
    let mut register = INPUTS;
    let mut known = Vec::new();
    for parameter in parameters {
        let is_vector = parameter.null.len() == 3;
        known.push(KnownParameter {
            name: &parameter.name,
            register,
            shape: if is_vector { Shape::Vector } else { Shape::Scalar },
            dimension: parameter.unit.dimension(),
        });
        register += if is_vector { 3 } else { 1 };
    }
    known
}
