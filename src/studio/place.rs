//! Where in the text of a law an error is: errors name fields, an editor needs lines and columns.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::Error;

/// A place in a text, as a browser counts: lines and columns from 1, in UTF-16 units.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) line: usize,
    pub(super) column: usize,
    pub(super) length: usize,
}

impl Place {
    /// Where in `text`, the TOML of an effect, `error` is; its first line if it isn't said.
    pub(super) fn of(text: &str, error: &Error) -> Place {
        let whole_line = || 0..text.find('\n').unwrap_or(text.len());
        let place = error.place().unwrap_or_default();
        let found = of_parser(text, place).or_else(|| of_field(text, place, error.span()));
        Place::of_span(text, found.unwrap_or_else(whole_line))
    }

    fn of_span(text: &str, span: Range<usize>) -> Place {
        let units = |text: &str| text.encode_utf16().count();
        let start = floor(text, span.start);
        let line_start = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |at| start + at);
        let end = floor(text, span.end).clamp(start, line_end);
        Place {
            line: 1 + text[..start].matches('\n').count(),
            column: 1 + units(&text[line_start..start]),
            length: units(&text[start..end]).max(1),
        }
    }
}

/// The nearest character's start at or before a byte.
fn floor(text: &str, byte: usize) -> usize {
    (0..=byte.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0)
}

/// The parser's `line 3, column 5`, counted in characters.
fn of_parser(text: &str, place: &str) -> Option<Range<usize>> {
    let (line, column) = place.strip_prefix("line ")?.split_once(", column ")?;
    let (line, column): (usize, usize) = (line.parse().ok()?, column.parse().ok()?);
    let lines = text.split_inclusive('\n');
    let start: usize = lines.take(line - 1).map(str::len).sum();
    let characters = text[start..].char_indices().map(|(at, _)| start + at);
    let at = characters.take_while(|&at| at < text.len()).nth(column - 1).unwrap_or(text.len());
    Some(at..at + 1)
}

/// The field at a path such as `law.acceleration`, and in it, if it is a text, the part `within`.
fn of_field(text: &str, path: &str, within: Option<&Range<usize>>) -> Option<Range<usize>> {
    let document = DeTable::parse(text).ok()?;
    let mut table = document.get_ref();
    let mut found = None;
    for name in path.split('.').filter(|name| !name.is_empty()) {
        let name = name.split('[').next().unwrap_or(name);
        let Some((key, value)) = table.iter().find(|(key, _)| key.get_ref() == name) else { break };
        found = Some(span_of(key.span(), value));
        match (value.get_ref(), within) {
            (DeValue::Table(inner), _) => table = inner,
            (DeValue::String(_), Some(within)) => {
                let literal = &text[value.span()];
                let at = |decoded| value.span().start + raw_offset(literal, decoded);
                return Some(at(within.start)..at(within.end));
            }
            _ => break,
        }
    }
    found
}

/// A field with its value, or the name of a table, which may be all over the text.
fn span_of(key: Range<usize>, value: &Spanned<DeValue<'_>>) -> Range<usize> {
    match value.get_ref() {
        DeValue::Table(_) => key,
        _ => key.start..value.span().end,
    }
}

/// Where in a TOML string, with its quotes, the byte `decoded` of its content is.
fn raw_offset(literal: &str, decoded: usize) -> usize {
    let is_basic = literal.starts_with('"');
    let is_long = literal.starts_with("\"\"\"") || literal.starts_with("'''");
    let mut raw = if is_long { 3 } else { 1 };
    if is_long {
        // The first line break doesn't count.
        let rest = &literal[raw..];
        raw += if rest.starts_with("\r\n") { 2 } else { usize::from(rest.starts_with('\n')) };
    }
    if !is_basic {
        return raw + decoded;
    }
    let mut seen = 0;
    while seen < decoded {
        let (length, bytes) = piece(&literal[raw..]);
        if length == 0 {
            break;
        }
        raw += length;
        seen += bytes;
    }
    raw
}

/// The first character or escape of a basic string's inside: how long it is, and of how many bytes
/// what it stands for.
fn piece(rest: &str) -> (usize, usize) {
    let mut characters = rest.chars();
    match (characters.next(), characters.next()) {
        (Some('\\'), Some(kind)) => {
            let digits = match kind {
                'x' => 2,
                'u' => 4,
                'U' => 8,
                // Joined lines: all white space is left out.
                white if white.is_whitespace() => {
                    let inside = rest[1..].trim_start().len();
                    return (rest.len() - inside, 0);
                }
                _ => return (1 + kind.len_utf8(), 1),
            };
            let code = rest.get(2..2 + digits).and_then(|code| u32::from_str_radix(code, 16).ok());
            (2 + digits, code.and_then(char::from_u32).map_or(1, char::len_utf8))
        }
        (Some(plain), _) => (plain.len_utf8(), plain.len_utf8()),
        (None, _) => (0, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The part of each literal that stands for the content's `k * v`.
    #[test]
    fn places_in_strings_are_found_in_every_way_to_write_them() {
        let literals = [
            r#""-k * v""#,
            "'-k * v'",
            "\"\"\"-k * v\"\"\"",
            "\"\"\"\n-k * v\"\"\"",
            "'''\n-k * v'''",
            r#""\u002Dk * v""#,
            r#""\U0000002Dk * v""#,
            "\"\"\"\\\n    -k * v\"\"\"",
        ];
        for literal in literals {
            let (start, end) = (raw_offset(literal, 1), raw_offset(literal, 6));
            assert_eq!(&literal[start..end], "k * v", "{literal}");
        }
    }

    #[test]
    fn columns_are_counted_as_browsers_do() {
        let text = "a = 1\n# 🎈ä\nb = '🎈x'\r\n";
        let place = |span: Range<usize>| {
            let Place { line, column, length } = Place::of_span(text, span);
            (line, column, length)
        };
        let x = text.find('x').unwrap();
        assert_eq!(place(x..x + 1), (3, 8, 1));
        assert_eq!(place(x - 4..x), (3, 6, 2));
        // Within a character, behind the end, over several lines.
        assert_eq!(place(x - 2..x), (3, 6, 2));
        assert_eq!(place(999..1_000).2, 1);
        assert_eq!(place(0..text.len()), (1, 1, 5));
    }
}
