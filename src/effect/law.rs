//! A law's text to its program.

use super::check::{KnownParameter, Scope};
use super::compile::compile;
use super::mistake::Mistake;
use super::names::{INPUTS, Shape};
use super::parse::{Expression, Kind};
use super::{Hook, Program};

/// The program of a law, if it is what its hook is to be.
pub(super) fn law(
    tree: &Expression<'_>,
    hook: Hook,
    known: &[KnownParameter<'_>],
) -> Result<Program, Mistake> {
    let value = Scope { hook, parameters: known }.check(tree)?;
    value.fits(hook).map_err(|mistake| with_unit(mistake, tree, hook, known))?;
    let taken: u16 = known.iter().map(|one| if one.shape == Shape::Vector { 3 } else { 1 }).sum();
    Ok(compile(&value, INPUTS + taken))
}

/// If another unit of one parameter would mend the law, says so.
fn with_unit(
    mistake: Mistake,
    tree: &Expression<'_>,
    hook: Hook,
    known: &[KnownParameter<'_>],
) -> Mistake {
    let found = Scope { hook, parameters: known }.check(tree).ok().and_then(|v| v.dimension);
    let Some(found) = found else {
        return mistake;
    };
    for index in 0..known.len() {
        let mut others = known.to_vec();
        let unit = known[index].dimension.times(hook.dimension()).over(found);
        others[index].dimension = unit;
        let value = Scope { hook, parameters: &others }.check(tree);
        if value.is_ok_and(|value| value.fits(hook).is_ok()) {
            let mend =
                format!("if the law is right, the unit of `{}` is {unit}", known[index].name);
            return Mistake { mend, ..mistake };
        }
    }
    mistake
}

/// Adds the names that `tree` holds, of quantities and functions.
pub(super) fn names_in<'a>(tree: &Expression<'a>, names: &mut Vec<&'a str>) {
    match &tree.kind {
        Kind::Number(_) => {}
        Kind::Name(name) => names.push(name),
        Kind::Negative(of) | Kind::Component(of, _) => names_in(of, names),
        Kind::Binary(_, parts) => parts.iter().for_each(|part| names_in(part, names)),
        Kind::Vector(items) => items.iter().for_each(|item| names_in(item, names)),
        Kind::Call { name, arguments, .. } => {
            names.push(name);
            arguments.iter().for_each(|argument| names_in(argument, names));
        }
    }
}
