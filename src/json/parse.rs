//! JSON text to a tree, without the ambiguities that JSON allows.

use std::cell::Cell;
use std::collections::HashSet;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error as _, MapAccess, SeqAccess, Visitor};
use serde_json::Number;

use crate::words::{quoted, shortened};
use crate::{Error, ErrorKind, Result};

/// More values than any file of ours holds; a file of nothing but zeros would fill the memory.
const MOST_VALUES: usize = 5_000_000;

/// A JSON value; an object's keys are distinct and in the file's order.
#[derive(Debug)]
pub(super) enum Tree {
    Null,
    Bool(bool),
    Number(Number),
    Text(String),
    List(Vec<Tree>),
    Object(Vec<(String, Tree)>),
}

/// Parses `text`; a leading byte-order mark, which some editors write, is skipped.
///
/// # Errors
/// The text isn't JSON, has one key twice in an object, or is nested too deeply; with line and
/// column.
pub(super) fn parse(text: &str) -> Result<Tree> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut source = serde_json::Deserializer::from_str(text);
    tree_of(&mut source)
        .and_then(|tree| source.end().map(|()| tree))
        .map_err(|error| explained(&error, text))
}

/// The tree that `source` holds.
pub(super) fn tree_of<'de, D: Deserializer<'de>>(source: D) -> std::result::Result<Tree, D::Error> {
    Values { count: &Cell::new(0) }.deserialize(source)
}

/// Builds the tree, and counts its values.
#[derive(Clone, Copy)]
struct Values<'a> {
    count: &'a Cell<usize>,
}

impl<'de> DeserializeSeed<'de> for Values<'_> {
    type Value = Tree;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> std::result::Result<Tree, D::Error> {
        self.count.set(self.count.get() + 1);
        if self.count.get() > MOST_VALUES {
            return Err(D::Error::custom(format!("more than {MOST_VALUES} values")));
        }
        source.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Values<'_> {
    type Value = Tree;

    fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> std::result::Result<Tree, E> {
        Ok(Tree::Null)
    }

    fn visit_bool<E>(self, value: bool) -> std::result::Result<Tree, E> {
        Ok(Tree::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> std::result::Result<Tree, E> {
        Ok(Tree::Number(value.into()))
    }

    fn visit_u64<E>(self, value: u64) -> std::result::Result<Tree, E> {
        Ok(Tree::Number(value.into()))
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> std::result::Result<Tree, E> {
        Number::from_f64(value).map(Tree::Number).ok_or_else(|| E::custom("number out of range"))
    }

    fn visit_str<E>(self, value: &str) -> std::result::Result<Tree, E> {
        Ok(Tree::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> std::result::Result<Tree, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = list.next_element_seed(self)? {
            items.push(item);
        }
        Ok(Tree::List(items))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Tree, A::Error> {
        let mut seen = HashSet::new();
        let mut fields = Vec::new();
        while let Some(key) = map.next_key::<String>()? {
            if !seen.insert(key.clone()) {
                return Err(A::Error::custom(format!("the key {} again", quoted(&key))));
            }
            fields.push((key, map.next_value_seed(self)?));
        }
        Ok(Tree::Object(fields))
    }
}

/// The parser's words, with the text that it stumbled over and a mend.
fn explained(error: &serde_json::Error, text: &str) -> Error {
    let place = format!("line {}, column {}", error.line(), error.column());
    let said = error.to_string();
    let end = format!(" at line {} column {}", error.line(), error.column());
    let said = said.strip_suffix(&end).unwrap_or(&said);
    let word = word_at(text, error.line(), error.column());
    let not_finite = ["nan", "inf", "-inf", "-nan"];
    let bare_number = not_finite.iter().any(|one| word.to_lowercase().starts_with(one));
    let (problem, mend) = if text.trim().is_empty() {
        ("is empty".into(), "was it saved? it should hold JSON")
    } else if error.is_eof() {
        ("the text ends too early".into(), "the file seems to be cut short: save or copy it again")
    } else if bare_number {
        (
            format!("{} is no JSON number", quoted(word)),
            "write a finite number; leave an `orientation` out that wasn't measured",
        )
    } else if said.starts_with("the key") {
        (format!("{said} in the same object"), "keep one of the two")
    } else if said.starts_with("more than") {
        (format!("the file holds {said}"), "keep the poses around the collision")
    } else if said.starts_with("recursion limit") {
        ("is nested deeper than 127 levels".into(), "the files of smash need fewer than 10")
    } else if said.starts_with("number out of range") {
        ("the number is too large".into(), "write a finite number in SI units")
    } else if said.starts_with("trailing characters") {
        (
            format!("{} follows the end of the JSON", quoted(word)),
            "keep one JSON object in the file",
        )
    } else {
        (
            format!("isn't JSON: {said}, at {}", quoted(word)),
            "look at the commas, quotes and brackets just before this place",
        )
    };
    Error::new(ErrorKind::Parse, problem).at(place).mend(mend)
}

/// The word in `text` around a place that the parser named (from 1, the column in bytes).
fn word_at(text: &str, line: usize, column: usize) -> &str {
    let line = text.split('\n').nth(line.saturating_sub(1)).unwrap_or("");
    let mut at = column.saturating_sub(1).min(line.len());
    while !line.is_char_boundary(at) {
        at -= 1;
    }
    let between = |c: char| c.is_whitespace() || ",:[]{}\"".contains(c);
    let start = line[..at]
        .rfind(between)
        .map_or(0, |found| found + line[found..].chars().next().map_or(1, char::len_utf8));
    let length = line[at..].find(between).unwrap_or(line.len() - at);
    let word = &line[start..at + length];
    if word.is_empty() { first_char(&line[at..]) } else { word }
}

fn first_char(text: &str) -> &str {
    text.chars().next().map_or("", |c| &text[..c.len_utf8()])
}

impl Tree {
    /// The value of an object's field.
    pub(super) fn field(&self, name: &str) -> Option<&Tree> {
        let Tree::Object(fields) = self else {
            return None;
        };
        fields.iter().find(|(key, _)| key == name).map(|(_, value)| value)
    }

    /// The value as a message shows it: whole if short, else its kind.
    pub(super) fn shown(&self) -> String {
        match self {
            Tree::Null => "null".into(),
            Tree::Bool(value) => value.to_string(),
            Tree::Number(number) => number.to_string(),
            Tree::Text(text) => format!("\"{}\"", shortened(text)),
            Tree::List(items) => format!("a list of {}", items.len()),
            Tree::Object(_) => "an object".into(),
        }
    }
}
