//! The one error type: what is wrong, where, and how to mend it.

use std::fmt;
use std::ops::Range;

/// Shorthand for this crate's results.
pub type Result<T> = std::result::Result<T, Error>;

/// The class of an [`Error`], for programs that react differently to each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A file can't be read.
    Read,
    /// A file isn't well-formed (JSON, CSV).
    Parse,
    /// A file is well-formed, but its content breaks a rule.
    Invalid,
    /// An output can't be written.
    Write,
    /// The optimiser found no usable solution.
    Solve,
}

/// An error that carries its cure.
///
/// It prints as `file: place: problem` and, on a second line, `hint: mend`. Parts that aren't
/// known are left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Error {
    kind: ErrorKind,
    file: Option<String>,
    place: Option<String>,
    problem: String,
    mend: Option<String>,
    /// Boxed, so that results stay small.
    span: Option<Box<Range<usize>>>,
}

impl Error {
    /// An error of `kind` with the `problem` in words.
    pub fn new(kind: ErrorKind, problem: impl Into<String>) -> Self {
        Error { kind, file: None, place: None, problem: problem.into(), mend: None, span: None }
    }

    /// A broken rule; the most frequent kind.
    pub fn invalid(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Error::new(ErrorKind::Invalid, problem).at(place)
    }

    /// Adds where in the file: body, observation, field; or line and column.
    #[must_use]
    pub fn at(mut self, place: impl Into<String>) -> Self {
        self.place = Some(place.into());
        self
    }

    /// Adds what the user can do about it.
    #[must_use]
    pub fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = Some(mend.into());
        self
    }

    /// Adds the file's name, unless one is known already.
    #[must_use]
    pub fn in_file(mut self, file: impl Into<String>) -> Self {
        self.file.get_or_insert_with(|| file.into());
        self
    }

    /// Adds where in the text at the place, in bytes.
    #[must_use]
    pub(crate) fn spanning(mut self, span: Range<usize>) -> Self {
        self.span = Some(Box::new(span));
        self
    }

    /// Says the problem in other words.
    #[must_use]
    pub(crate) fn problem_in_words(mut self, problem: String) -> Self {
        self.problem = problem;
        self
    }

    /// The class of this error.
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The file, if known.
    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    /// Where in the file, if known.
    pub fn place(&self) -> Option<&str> {
        self.place.as_deref()
    }

    /// What is wrong, without file and place.
    pub fn problem(&self) -> &str {
        &self.problem
    }

    /// Where in the text at the place, in bytes, if known; the problem's further lines then show it.
    pub(crate) fn span(&self) -> Option<&Range<usize>> {
        self.span.as_deref()
    }

    /// How to mend it, if known.
    pub fn hint(&self) -> Option<&str> {
        self.mend.as_deref()
    }
}

impl fmt::Display for Error {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(out, "{file}: ")?;
        }
        if let Some(place) = &self.place {
            // People count from 1, JSON's readers from 0.
            let base = if place.contains('[') { " (counted from 0)" } else { "" };
            write!(out, "{place}{base}: ")?;
        }
        write!(out, "{}", self.problem)?;
        match &self.mend {
            Some(mend) => write!(out, "\n  hint: {mend}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for Error {}
