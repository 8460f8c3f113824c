//! Answers: JSON, files to keep, and errors with their mend.

use axum::http::header::{CONTENT_DISPOSITION, CONTENT_TYPE};
use axum::http::{HeaderValue, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;
use serde_json::json;

use crate::{Error, ErrorKind};

/// A value as JSON.
pub(super) fn json_of(value: &impl Serialize) -> Response {
    match serde_json::to_vec(value) {
        Ok(bytes) => with_type("application/json", bytes),
        Err(_) => own_fault(),
    }
}

/// A page to look at.
pub(super) fn page(html: String) -> Response {
    with_type("text/html; charset=utf-8", html.into_bytes())
}

/// A file to keep.
pub(super) fn download(content_type: &'static str, name: &str, text: String) -> Response {
    let mut response = with_type(content_type, text.into_bytes());
    let disposition = format!("attachment; filename=\"{}\"", plain(name));
    if let Ok(value) = HeaderValue::from_str(&disposition) {
        response.headers_mut().insert(CONTENT_DISPOSITION, value);
    }
    response
}

/// An error of the library.
pub(super) fn error(status: StatusCode, error: &Error) -> Response {
    // Without a place in it, the file itself is the place: which one can't be written, say.
    let place = error.place().or(error.file());
    let told = json!({"place": place, "problem": error.problem(), "mend": error.hint()});
    let mut response = json_of(&json!({"error": told}));
    *response.status_mut() = status;
    response
}

/// An error of the request itself.
pub(super) fn refused(status: StatusCode, problem: &str, mend: &str) -> Response {
    error(status, &Error::new(ErrorKind::Invalid, problem).mend(mend))
}

/// The answer to every address that there isn't, for whoever opens it in a browser. It is the same for
/// all: nothing tells a wrong token from a wrong path.
pub(super) fn nothing_here() -> Response {
    let words = "Nothing is at this address. Each time that `smash studio` is started its page has another \
                 one:\nopen the address that it printed. What was tried in a session is there.\n";
    (StatusCode::NOT_FOUND, with_type("text/plain; charset=utf-8", words.into())).into_response()
}

/// What should never happen, and must not take the server down.
pub(super) fn own_fault() -> Response {
    let mend = "go on, or start the studio again: the session is saved";
    refused(
        StatusCode::INTERNAL_SERVER_ERROR,
        "the studio failed inside; nothing was changed",
        mend,
    )
}

fn with_type(content_type: &'static str, bytes: Vec<u8>) -> Response {
    ([(CONTENT_TYPE, content_type)], bytes).into_response()
}

/// A file's name for a header: what could end it, or isn't everywhere a letter, is `_`.
fn plain(name: &str) -> String {
    let keep = |c: char| if c.is_ascii_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    name.chars().map(keep).collect()
}
