//! What can be wrong with a value in a well-formed file.

use std::fmt;

use serde::de::{self, Expected, Unexpected};

use crate::words::{did_you_mean, shortened};
use crate::{Error, ErrorKind};

/// A broken expectation, in parts that a message can be made of.
#[derive(Debug)]
pub(super) enum Fault {
    UnknownField {
        name: String,
        known: &'static [&'static str],
    },
    UnknownWord {
        word: String,
        known: &'static [&'static str],
    },
    MissingField(&'static str),
    Wrong {
        found: String,
        expected: String,
    },
    /// A word stands alone that needs a value.
    LacksValue,
    Custom(String),
}

/// Words that stand with a value, as one writes them.
const EXAMPLES: [(&str, &str); 5] = [
    ("gaussian", "{\"gaussian\": {\"position\": 0.002, \"orientation\": 0.01}}"),
    ("uniform", "{\"uniform\": 0.05}"),
    ("frames", "{\"frames\": [0, 9, 18, 36, 45, 54]}"),
    ("times", "{\"times\": [0, 0.1, 0.2, 0.4, 0.5, 0.6]}"),
    ("regular", "{\"regular\": {\"interval\": 9, \"frame_count\": 90}}"),
];

impl Fault {
    /// The same fault, where `word` was found without the value that belongs to it.
    pub(super) fn of_word(self, word: &str) -> Fault {
        let Fault::LacksValue = self else {
            return self;
        };
        let example = EXAMPLES.iter().find(|(known, _)| *known == word);
        let example = example.map_or(String::new(), |(_, text)| format!(", such as {text},"));
        Fault::Wrong {
            found: format!("\"{}\" without its value", shortened(word)),
            expected: format!("the word with its value{example}"),
        }
    }

    /// The message, for the value at `place`.
    pub(super) fn into_error(self, place: String) -> Error {
        let (problem, mend) = match self {
            // The path leads to the field itself.
            Fault::UnknownField { name, known } => {
                ("is an unknown field".into(), did_you_mean(&name, known))
            }
            Fault::UnknownWord { word, known } => (
                format!("is \"{}\", which is unknown", shortened(&word)),
                did_you_mean(&word, known),
            ),
            Fault::MissingField(name) => {
                (format!("the field `{name}` is missing"), format!("add `{name}`"))
            }
            Fault::Wrong { found, expected } => {
                (format!("is {found}"), format!("write {expected} here"))
            }
            Fault::LacksValue => ("lacks its value".into(), "write the word with its value".into()),
            Fault::Custom(text) => {
                let (problem, mend) = text.split_once("; ").unwrap_or((&text, ""));
                (problem.to_owned(), mend.to_owned())
            }
        };
        let error = Error::new(ErrorKind::Invalid, problem);
        let error = if place.is_empty() { error } else { error.at(place) };
        if mend.is_empty() { error } else { error.mend(mend) }
    }
}

/// Serde's phrases for Rust's types, in the words of JSON.
fn in_words(expected: &dyn Expected) -> String {
    let text = expected.to_string();
    match text.as_str() {
        "f64" | "f32" => "a number".into(),
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more,".into(),
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number".into(),
        "a boolean" => "true or false".into(),
        "a string" => "a text in double quotes".into(),
        "a sequence" => "a list".into(),
        "unit" => "null".into(),
        "a map" => "an object".into(),
        other => match other.strip_prefix("an array of length ") {
            Some(length) => format!("a list of {length} numbers"),
            None => other.to_owned(),
        },
    }
}

fn found(value: Unexpected<'_>) -> String {
    match value {
        Unexpected::Bool(value) => value.to_string(),
        Unexpected::Unsigned(value) => value.to_string(),
        Unexpected::Signed(value) => value.to_string(),
        Unexpected::Float(value) => value.to_string(),
        Unexpected::Str(text) => format!("\"{}\"", shortened(text)),
        Unexpected::Unit => "null".into(),
        Unexpected::Seq => "a list".into(),
        Unexpected::Map => "an object".into(),
        other => other.to_string(),
    }
}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(text: T) -> Self {
        Fault::Custom(text.to_string())
    }

    fn invalid_type(value: Unexpected<'_>, expected: &dyn Expected) -> Self {
        if value == Unexpected::UnitVariant {
            return Fault::LacksValue;
        }
        Fault::Wrong { found: found(value), expected: in_words(expected) }
    }

    fn invalid_value(value: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Fault::Wrong { found: found(value), expected: in_words(expected) }
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Fault::Wrong { found: format!("a list of {length}"), expected: in_words(expected) }
    }

    fn unknown_variant(word: &str, known: &'static [&'static str]) -> Self {
        Fault::UnknownWord { word: word.into(), known }
    }

    fn unknown_field(name: &str, known: &'static [&'static str]) -> Self {
        Fault::UnknownField { name: name.into(), known }
    }

    fn missing_field(name: &'static str) -> Self {
        Fault::MissingField(name)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{self:?}")
    }
}

impl std::error::Error for Fault {}
