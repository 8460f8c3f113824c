//! The page, with its data in it.

use serde::Serialize;
use smash_page::PAGE;

use crate::{Error, ErrorKind, Result};

/// Where the data go.
const MARKER: &str = "\"SMASH_DATA\"";

/// Whether this build has the page in it.
pub fn has_page() -> bool {
    PAGE.is_some()
}

/// Refuses to go on where there is no page: before anything is computed for it.
///
/// # Errors
/// This build has no page, since there was no Node when it was built.
pub fn require_page() -> Result<()> {
    if has_page() { Ok(()) } else { Err(no_page()) }
}

/// The page that shows `data`: a [`super::Report`], or a studio's state.
///
/// # Errors
/// This build has no page, since there was no Node when it was built.
pub fn page(data: &impl Serialize) -> Result<String> {
    let Some((head, tail)) = PAGE.and_then(|page| page.split_once(MARKER)) else {
        return Err(no_page());
    };
    let json = serde_json::to_string(data).expect("plain numbers and strings have a JSON form");
    // Within a script element only `<` could end it.
    Ok([head, &json.replace('<', "\\u003c"), tail].concat())
}

fn no_page() -> Error {
    Error::new(ErrorKind::Write, "this smash was built without its page").mend(
        "install Node (on Debian: `sudo apt-get install nodejs npm`, or `./setup`), and build \
         smash again",
    )
}
