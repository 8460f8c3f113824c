//! Effects from files.

use std::path::Path;

use super::check::{KnownParameter, Scope as LawScope};
use super::compile::compile;
use super::file::{EffectFile, Null, ParameterFile};
use super::functions::FUNCTIONS;
use super::mistake::Mistake;
use super::names::{INPUTS, NAMES, Shape};
use super::parse::{Expression, Kind, is_name, name_problem, parse};
use super::trial::try_out;
use super::unit::Unit;
use super::{Effect, Hook, Need, Parameter, Program, Scope};
use crate::files::{display_name, read_text_up_to};
use crate::json::decode_toml;
use crate::words::{limit, quoted};
use crate::{Error, ErrorKind, Result};

/// An effect is a page of text; more than this was never written by hand.
const LARGEST_FILE_BYTES: u64 = 64 << 10;

/// More unknowns than any scene could determine.
const MOST_PARAMETERS: usize = 32;

/// The bounds of a parameter whose file states none.
const WIDEST: [f64; 2] = [-1e6, 1e6];

impl Effect {
    /// Reads and checks the effect file `path` (`-` is standard input).
    ///
    /// # Errors
    /// The file can't be read, isn't TOML, or breaks a rule; with field, value and mend, and for a
    /// law a caret under the mistake.
    pub fn read(path: impl AsRef<Path>) -> Result<Effect> {
        let path = path.as_ref();
        let text = read_text_up_to(LARGEST_FILE_BYTES, path, "an effect is a page of text")?;
        Effect::parse(&text, &display_name(path, "standard input"))
    }

    /// Reads and checks an effect from `text`; `origin` is only for messages.
    ///
    /// # Errors
    /// The text isn't TOML or breaks a rule; with field, value and mend.
    pub fn parse(text: &str, origin: &str) -> Result<Effect> {
        if text.len() as u64 > LARGEST_FILE_BYTES {
            let problem = format!("is larger than {} KiB", LARGEST_FILE_BYTES >> 10);
            let error = Error::new(ErrorKind::Read, problem).in_file(origin);
            return Err(error.mend("an effect is a page of text"));
        }
        let file = decode_toml(text, origin)?;
        let effect = Effect::from_file(file).and_then(|effect| {
            try_out(&effect)?;
            Ok(effect)
        });
        effect.map_err(|error| error.in_file(origin))
    }

    fn from_file(file: EffectFile) -> Result<Effect> {
        if !is_name(&file.name) {
            let mend = "use letters, digits and `_`, at most 40, and start with a letter";
            return Err(Error::invalid("name", name_problem(&file.name)).mend(mend));
        }
        let count = file.parameters.len();
        if count == 0 || count > MOST_PARAMETERS {
            let problem = format!("an effect has 1 to {MOST_PARAMETERS} parameters, not {count}");
            let mend = "a parameter is what turns the effect off, at its null value";
            return Err(Error::invalid("parameters", problem).mend(mend));
        }
        let parameters = file.parameters.into_iter().map(parameter).collect::<Result<Vec<_>>>()?;
        let sources = file.law.stated();
        check_hooks(&sources, file.scope)?;
        let known = known_parameters(&parameters);
        let mut used = Vec::new();
        let mut laws = Vec::new();
        for (hook, text) in &sources {
            let place = format!("law.{hook}");
            let tree = parse(text).map_err(|mistake| mistake.in_text(text, &place))?;
            let program =
                law(&tree, *hook, &known).map_err(|mistake| mistake.in_text(text, &place))?;
            names_in(&tree, &mut used);
            laws.push((*hook, program));
        }
        if let Some(idle) = known.iter().find(|one| !used.contains(&one.name)) {
            let place = format!("parameters.{}", idle.name);
            let error = Error::invalid(place, "isn't used by any law");
            return Err(error.mend("use it, or take it out"));
        }
        let needs = all_needs(file.needs, &laws, &used);
        Ok(Effect {
            name: file.name,
            title: file.title,
            scope: file.scope,
            needs,
            parameters,
            laws,
            sources: sources.into_iter().collect(),
            help: file.help,
        })
    }
}

fn parameter((name, file): (String, ParameterFile)) -> Result<Parameter> {
    let place = format!("parameters.{name}");
    if !is_name(&name) {
        let mend = "use letters, digits and `_`, at most 40, and start with a letter";
        return Err(Error::invalid("parameters", name_problem(&name)).mend(mend));
    }
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

/// What hooks need of each other and of the scope.
fn check_hooks(sources: &[(Hook, String)], scope: Scope) -> Result<()> {
    let has = |hook| sources.iter().any(|(stated, _)| *stated == hook);
    let refuse = |hook: Hook, problem: &str, mend: &str| {
        Err(Error::invalid(format!("law.{hook}"), problem).mend(mend))
    };
    if sources.is_empty() {
        let error = Error::invalid("law", "is empty");
        return Err(error.mend("state at least one, such as `acceleration = \"-k * v\"`"));
    }
    let at_contact = [Hook::Impulse, Hook::ImpulsePoint, Hook::AngularImpulse];
    if scope == Scope::Contact {
        if let Some((hook, _)) = sources.iter().find(|(hook, _)| !at_contact.contains(hook)) {
            let mend = "a contact has `impulse` and `angular_impulse`; else write scope = \"body\"";
            return refuse(*hook, "acts on a body, not on a contact", mend);
        }
    }
    let jumps = has(Hook::EventImpulse) || has(Hook::EventAngularImpulse);
    if has(Hook::ImpulsePoint) && !has(Hook::Impulse) {
        return refuse(Hook::ImpulsePoint, "has no impulse that acts there", "add `impulse`");
    }
    if has(Hook::EventTime) && !jumps {
        return refuse(Hook::EventTime, "has nothing that happens then", "add `event_impulse`");
    }
    if jumps && !has(Hook::EventTime) {
        return refuse(Hook::EventTime, "is missing", "say when the event happens");
    }
    Ok(())
}

fn known_parameters(parameters: &[Parameter]) -> Vec<KnownParameter<'_>> {
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

/// The program of a law, if it is what its hook is to be.
fn law(
    tree: &Expression<'_>,
    hook: Hook,
    known: &[KnownParameter<'_>],
) -> std::result::Result<Program, Mistake> {
    let value = LawScope { hook, parameters: known }.check(tree)?;
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
    let found = LawScope { hook, parameters: known }.check(tree).ok().and_then(|v| v.dimension);
    let Some(found) = found else {
        return mistake;
    };
    for index in 0..known.len() {
        let mut others = known.to_vec();
        let unit = known[index].dimension.times(hook.dimension()).over(found);
        others[index].dimension = unit;
        let value = LawScope { hook, parameters: &others }.check(tree);
        if value.is_ok_and(|value| value.fits(hook).is_ok()) {
            let mend =
                format!("if the law is right, the unit of `{}` is {unit}", known[index].name);
            return Mistake { mend, ..mistake };
        }
    }
    mistake
}

/// Adds the names that `tree` holds.
fn names_in<'a>(tree: &Expression<'a>, names: &mut Vec<&'a str>) {
    match &tree.kind {
        Kind::Number(_) => {}
        Kind::Name(name) => names.push(name),
        Kind::Negative(of) | Kind::Component(of, _) => names_in(of, names),
        Kind::Binary(_, parts) => parts.iter().for_each(|part| names_in(part, names)),
        Kind::Call { arguments: items, .. } | Kind::Vector(items) => {
            items.iter().for_each(|item| names_in(item, names));
        }
    }
}

/// The needs that are stated, and those that the names imply.
fn all_needs(mut needs: Vec<Need>, laws: &[(Hook, Program)], used: &[&str]) -> Vec<Need> {
    let flies = |hook: &Hook| {
        matches!(hook, Hook::Acceleration | Hook::Torque | Hook::Position | Hook::Orientation)
    };
    let normal_of_plane = used.contains(&"normal") && laws.iter().any(|(hook, _)| flies(hook));
    let implied = [
        (Need::Camera, used.contains(&"camera")),
        (Need::Plane, used.contains(&"slip") || normal_of_plane),
    ];
    needs.extend(implied.into_iter().filter(|one| one.1).map(|one| one.0));
    let mut distinct = Vec::new();
    for need in needs {
        if !distinct.contains(&need) {
            distinct.push(need);
        }
    }
    distinct
}
