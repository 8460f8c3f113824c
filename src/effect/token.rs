//! An expression's text to words, numbers and signs.

use std::ops::Range;

use super::mistake::Mistake;
use crate::words::quoted;

/// Laws are short; what is longer was generated, and would cost memory and stack.
const MOST_TOKENS: usize = 1000;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Kind<'a> {
    Number(f64),
    Name(&'a str),
    Sign(char),
    End,
}

#[derive(Debug, Clone)]
pub(super) struct Token<'a> {
    pub kind: Kind<'a>,
    pub span: Range<usize>,
}

/// The tokens of `text`, with [`Kind::End`] as the last.
pub(super) fn tokens(text: &str) -> Result<Vec<Token<'_>>, Mistake> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        let rest = &text[at..];
        if character.is_whitespace() {
            at += character.len_utf8();
            continue;
        }
        let is_number = |c: char| c.is_ascii_digit();
        let (kind, length) =
            if is_number(character) || character == '.' && rest[1..].starts_with(is_number) {
                number(rest, at)?
            } else if character.is_ascii_alphabetic() || character == '_' {
                let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
                let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
                (Kind::Name(&rest[..length]), length)
            } else if "+-*/^()[],.".contains(character) && !rest.starts_with("**") {
                (Kind::Sign(character), 1)
            } else {
                return Err(stranger(character, rest, at));
            };
        tokens.push(Token { kind, span: at..at + length });
        at += length;
        if tokens.len() > MOST_TOKENS {
            let problem = format!("is longer than {MOST_TOKENS} words and signs");
            return Err(Mistake::new(at - length..at, problem, "write a shorter law"));
        }
    }
    tokens.push(Token { kind: Kind::End, span: text.len()..text.len() });
    Ok(tokens)
}

/// The number at the start of `rest`, and its length.
fn number(rest: &str, at: usize) -> Result<(Kind<'_>, usize), Mistake> {
    let digits = |from: usize| {
        let is_part = |c: char| c.is_ascii_digit() || c == '.';
        from + rest[from..].find(|c| !is_part(c)).unwrap_or(rest.len() - from)
    };
    let mut length = digits(0);
    if let Some(exponent) = rest[length..].strip_prefix(['e', 'E']) {
        let sign = usize::from(exponent.starts_with(['+', '-']));
        if exponent[sign..].starts_with(|c: char| c.is_ascii_digit()) {
            length = digits(length + 1 + sign);
        }
    }
    match rest[..length].parse::<f64>() {
        Ok(value) if value.is_finite() => Ok((Kind::Number(value), length)),
        _ => {
            let problem = format!("{} is no number", quoted(&rest[..length]));
            Err(Mistake::new(at..at + length, problem, "write it as 0.15 or 1.5e-3"))
        }
    }
}

/// A character that has no place here, and what was probably meant by it.
fn stranger(character: char, rest: &str, at: usize) -> Mistake {
    let (found, mend) = match character {
        '*' => ("**", "write `^` for a power"),
        '²' => ("²", "write `^2`"),
        '³' => ("³", "write `^3`"),
        '·' | '×' => (&rest[..character.len_utf8()], "write `*`, or dot(a, b), cross(a, b)"),
        '−' | '–' => (&rest[..character.len_utf8()], "write `-`"),
        '|' => ("|", "write norm(v) or abs(x)"),
        '=' => ("=", "write only what the hook is to be, without its name"),
        other => (&rest[..other.len_utf8()], "use names, numbers, + - * / ^ and brackets"),
    };
    Mistake::new(at..at + found.len(), format!("{} has no meaning here", quoted(found)), mend)
}
