//! What is wrong in an expression, and where.

use std::ops::Range;

use crate::{Error, ErrorKind};

/// The characters of an expression that a message shows around the mistake.
const SHOWN: usize = 72;

/// A broken rule at a place of an expression's text.
#[derive(Debug)]
pub(super) struct Mistake {
    /// In bytes.
    pub span: Range<usize>,
    pub problem: String,
    pub mend: String,
}

impl Mistake {
    pub(super) fn new(
        span: Range<usize>,
        problem: impl Into<String>,
        mend: impl Into<String>,
    ) -> Self {
        Mistake { span, problem: problem.into(), mend: mend.into() }
    }

    /// The error: the problem, the line of `text` with carets under the mistake, the mend.
    pub(super) fn in_text(self, text: &str, place: &str) -> Error {
        let (line, start, length) = window(text, &self.span);
        let carets = format!("{}{}", " ".repeat(start), "^".repeat(length));
        Error::new(ErrorKind::Invalid, format!("{}\n    {line}\n    {carets}", self.problem))
            .at(place)
            .mend(self.mend)
            .spanning(self.span)
    }
}

/// The part of `text` to be shown, and where in it, in characters, the mistake starts and how
/// long it is.
fn window(text: &str, span: &Range<usize>) -> (String, usize, usize) {
    let line_start = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
    let line: Vec<char> = text[line_start..].chars().take_while(|&c| c != '\n').collect();
    let column = text[line_start..span.start].chars().count();
    let length = text[span.clone()].chars().take_while(|&c| c != '\n').count();
    let first = if line.len() <= SHOWN { 0 } else { column.saturating_sub(SHOWN / 2) };
    let last = line.len().min(first + SHOWN);
    // One character of what is shown for each of the text's: the carets must stay below.
    let plain = |&c: &char| if c.is_control() { ' ' } else { c };
    let mut shown: Vec<char> = line[first..last].iter().map(plain).collect();
    if first > 0 {
        shown[0] = '…';
    }
    if last < line.len() {
        shown.push('…');
    }
    let start = column - first;
    let length = length.clamp(1, (shown.len() - start).max(1));
    (shown.into_iter().collect::<String>().trim_end().to_owned(), start, length)
}
