//! TOML text to the same tree, for the same messages.

use super::parse::{Tree, tree_of};
use crate::words::quoted;
use crate::{Error, ErrorKind, Result};

/// Parses `text` as TOML.
///
/// # Errors
/// The text isn't TOML, has one key twice in a table, or is nested too deeply; with line and
/// column.
pub(super) fn parse_toml(text: &str) -> Result<Tree> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Error::new(ErrorKind::Parse, "is empty").mend("was it saved?"));
    }
    toml::Deserializer::parse(text).and_then(tree_of).map_err(|error| explained(&error, text))
}

/// The parser's words, with the line that it stumbled over and a mend.
fn explained(error: &toml::de::Error, text: &str) -> Error {
    let span = error.span().unwrap_or(0..0);
    let before = text.get(..span.start).unwrap_or(text);
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    let shown = quoted(text.lines().nth(line - 1).unwrap_or("").trim());
    let said = error.message().lines().next().unwrap_or("").trim();
    let (problem, mend) = if said.starts_with("duplicate key") {
        (format!("the same key again, at {shown}"), "keep one of the two")
    } else if said.starts_with("number out of range") {
        let mend = "write a finite number, or leave the field out if it may be left out";
        (format!("a number isn't finite, at {shown}"), mend)
    } else {
        let mend = "text stands between quotes, a law too; lists between [ and ]";
        (format!("isn't TOML: {said}, at {shown}"), mend)
    };
    Error::new(ErrorKind::Parse, problem).at(format!("line {line}, column {column}")).mend(mend)
}
