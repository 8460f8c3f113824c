//! A request's body, within limits of size and time.

use std::time::Duration;

use axum::body::{Body, HttpBody};
use axum::http::StatusCode;
use axum::response::Response;
use tokio::time::timeout;

use super::reply::refused;

/// For a whole body; on this machine the largest takes a moment.
const LONGEST: Duration = Duration::from_secs(10);

/// The body as text, of at most `limit` bytes.
pub(super) async fn text(body: Body, limit: usize) -> Result<String, Box<Response>> {
    let refuse = |status, problem: &str, mend: &str| Err(Box::new(refused(status, problem, mend)));
    let too_large = || {
        let problem = format!("the request is larger than {} KiB", limit >> 10);
        refuse(StatusCode::PAYLOAD_TOO_LARGE, &problem, "send less")
    };
    if body.size_hint().lower() > limit as u64 {
        return too_large();
    }
    match timeout(LONGEST, axum::body::to_bytes(body, limit)).await {
        Err(_) => refuse(StatusCode::REQUEST_TIMEOUT, "the request didn't end", "send it at once"),
        Ok(Err(_)) => too_large(),
        Ok(Ok(bytes)) => String::from_utf8(bytes.into()).or_else(|_| {
            refuse(StatusCode::BAD_REQUEST, "the request isn't UTF-8 text", "send JSON in UTF-8")
        }),
    }
}
