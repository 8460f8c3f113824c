//! Effects from files.

use std::path::Path;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use super::catalogue::check_is_told_apart;
use super::file::EffectFile;
use super::law::{law, names_in};
use super::parameters::{check_name, known_parameters, parameter};
use super::parse::parse;
use super::trial::try_out;
use super::{Effect, Hook, Need, Scope};
use crate::files::{display_name, read_text_up_to};
use crate::json::decode_toml;
use crate::{Error, ErrorKind, Result};

/// An effect is a page of text; more than this was never written by hand.
const LARGEST_FILE_BYTES: u64 = 64 << 10;

/// More unknowns than any scene could determine.
const MOST_PARAMETERS: usize = 32;

impl Effect {
    /// Reads and checks the effect file `path` (`-` is standard input).
    ///
    /// # Errors
    /// The file can't be read, isn't TOML, or breaks a rule; with field, value and mend, and for a
    /// law a caret under the mistake.
    pub fn read(path: impl AsRef<Path>) -> Result<Effect> {
        let path = path.as_ref();
        let text = read_text_up_to(LARGEST_FILE_BYTES, path, "an effect is a page of text")?;
        let name = display_name(path, "standard input");
        let effect = Effect::parse(&text, &name)?;
        check_is_told_apart(&effect).map_err(|error| error.in_file(name.clone()))?;
        Ok(Effect { file: (path != Path::new("-")).then_some(name), ..effect })
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
        Effect::checked(file).map_err(|error| error.in_file(origin))
    }

    fn checked(file: EffectFile) -> Result<Effect> {
        let effect = Effect::from_file(file)?;
        try_out(&effect)?;
        Ok(effect)
    }

    fn from_file(file: EffectFile) -> Result<Effect> {
        check_name(&file.name).map_err(|error| error.at("name"))?;
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
        let needs = all_needs(file.needs, &sources, &used);
        Ok(Effect {
            name: file.name,
            title: file.title,
            scope: file.scope,
            needs,
            parameters,
            laws,
            sources: sources.into_iter().collect(),
            help: file.help,
            file: None,
        })
    }
}

/// From the form of its file, as [`Effect`] serialises; checked like a file.
impl<'de> Deserialize<'de> for Effect {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Effect, D::Error> {
        let file = EffectFile::deserialize(deserializer)?;
        // The reader takes what follows a semicolon for the mend.
        let in_words = |error: Error| error.to_string().replace("\n  hint: ", "; ");
        Effect::checked(file).map_err(|error| D::Error::custom(in_words(error)))
    }
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
    let elsewhere = sources.iter().find(|(hook, _)| !at_contact.contains(hook));
    if let (Scope::Contact, Some((hook, _))) = (scope, elsewhere) {
        let mend = "a contact has `impulse` and `angular_impulse`; else write scope = \"body\"";
        return refuse(*hook, "acts on a body, not on a contact", mend);
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

/// The needs that are stated, and those that hooks and names imply.
fn all_needs(stated: Vec<Need>, sources: &[(Hook, String)], used: &[&str]) -> Vec<Need> {
    let uses = |names: &[&str]| names.iter().any(|name| used.contains(name));
    let has = |hooks: &[Hook]| sources.iter().any(|(hook, _)| hooks.contains(hook));
    // At the contact the normal is known of two bodies too.
    let apart = [Hook::Acceleration, Hook::Torque, Hook::Position, Hook::Orientation];
    let turns = uses(&["w", "L", "rotate", "unrotate"]) || has(&[Hook::Torque, Hook::Inertia]);
    let implied = [
        (Need::Camera, uses(&["camera"])),
        (Need::Plane, uses(&["slip"]) || uses(&["normal"]) && has(&apart)),
        (Need::Orientation, turns),
    ];
    let implied = implied.into_iter().filter(|(_, is_implied)| *is_implied).map(|(need, _)| need);
    let mut needs = Vec::new();
    for need in stated.into_iter().chain(implied) {
        if !needs.contains(&need) {
            needs.push(need);
        }
    }
    needs
}
