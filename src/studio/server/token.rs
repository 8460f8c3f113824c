//! The token: who knows it, may act.

use subtle::ConstantTimeEq;

use crate::{Error, ErrorKind, Result};

/// 128 random bits, as 32 hexadecimal digits.
#[derive(Clone)]
pub(super) struct Token(String);

impl Token {
    /// A new one, from the system's randomness.
    pub(super) fn new() -> Result<Token> {
        let mut bytes = [0; 16];
        getrandom::fill(&mut bytes).map_err(|error| {
            Error::new(ErrorKind::Read, format!("the system has no randomness: {error}"))
                .mend("a studio without a secret address would be open to all programs here")
        })?;
        Ok(Token(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    pub(super) fn text(&self) -> &str {
        &self.0
    }

    /// Whether `guess` is it; how long that takes doesn't tell how much of it is right.
    pub(super) fn is(&self, guess: &str) -> bool {
        self.0.as_bytes().ct_eq(guess.as_bytes()).into()
    }
}

/// A secret has no place in messages.
impl std::fmt::Debug for Token {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str("Token")
    }
}
