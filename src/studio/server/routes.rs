//! Which request asks for what.

use std::sync::Arc;

use axum::body::Body;
use axum::extract::State;
use axum::http::StatusCode;
use axum::response::{Redirect, Response};
use axum::routing::{get, post};
use axum::{Router, middleware};
use serde::Deserialize;
use serde_json::json;

use super::body::text;
use super::gate::{Gate, gate};
use super::reply::{download, error, json_of, nothing_here, own_fault, page, refused};
use super::token::Token;
use crate::Result;
use crate::json::decode_part;
use crate::studio::file::{LARGEST_SESSION_BYTES, LONGEST_DRAFT_BYTES};
use crate::studio::{Action, Studio};

/// A law within JSON, where a character may take six, and the words around it.
const LARGEST_ACTION_BYTES: usize = 2 * LONGEST_DRAFT_BYTES;

/// A draft, and the one that it takes the place of.
const LARGEST_LAW_BYTES: usize = 2 * LARGEST_ACTION_BYTES;

type Shared = State<Arc<Studio>>;

/// The studio's routes, all behind the gate and under the token.
pub(super) fn router(studio: Arc<Studio>, port: u16, token: Token) -> Router {
    // What the page asks for is relative to `/TOKEN/`.
    let page = format!("/{}/", token.text());
    let at = |path: &str| format!("/{}/{path}", token.text());
    Router::new()
        .route(&at(""), get(whole_page))
        .route(&at("api/state"), get(state))
        .route(&at("api/revision"), get(revision))
        .route(&at("api/act"), post(act))
        .route(&at("api/law"), post(law))
        .route(&at("api/diagnosis"), get(diagnosis))
        .route(&at("api/report"), get(report))
        .route(&at("api/session"), get(session).post(open_session))
        .route(page.trim_end_matches('/'), get(Redirect::permanent(&page)))
        .fallback(async || nothing_here())
        .method_not_allowed_fallback(async || {
            let problem = "this can't be asked for in this way";
            let mend = "use GET, or POST for acts, laws and sessions";
            refused(StatusCode::METHOD_NOT_ALLOWED, problem, mend)
        })
        .with_state(studio)
        .layer(middleware::from_fn_with_state(Gate { port, token: token.clone() }, gate))
}

async fn whole_page(studio: Shared) -> Response {
    let made = |studio: &Studio| crate::report::page(&studio.state());
    answered(studio, made, page).await
}

async fn state(studio: Shared) -> Response {
    answered(studio, |studio| Ok(studio.state()), |state| json_of(&state)).await
}

/// Long films make large states: whether there is a newer one is cheap to ask.
async fn revision(State(studio): Shared) -> Response {
    json_of(&json!({"revision": studio.revision()}))
}

async fn act(studio: Shared, body: Body) -> Response {
    let action = match read(body, LARGEST_ACTION_BYTES, Action::parse).await {
        Ok(action) => action,
        Err(response) => return *response,
    };
    let acted = move |studio: &Studio| studio.act(action);
    answered(studio, acted, |state| json_of(&state)).await
}

/// What is being typed.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Typed {
    draft: String,
    /// The draft that it takes the place of, and no other.
    instead_of: Option<String>,
}

async fn law(studio: Shared, body: Body) -> Response {
    let typed: Typed = match read(body, LARGEST_LAW_BYTES, decode_part).await {
        Ok(typed) => typed,
        Err(response) => return *response,
    };
    let checked =
        move |studio: &Studio| studio.check_law(&typed.draft, typed.instead_of.as_deref());
    answered(studio, checked, |check| json_of(&check)).await
}

async fn diagnosis(studio: Shared) -> Response {
    answered(studio, Studio::diagnosis, |found| json_of(&found)).await
}

async fn report(studio: Shared) -> Response {
    let made = |studio: &Studio| Ok((file_name(studio, "report.html"), studio.report_page()?));
    let kept = |(name, html): (String, String)| download("text/html; charset=utf-8", &name, html);
    answered(studio, made, kept).await
}

async fn session(studio: Shared) -> Response {
    let made = |studio: &Studio| Ok((file_name(studio, "session.json"), studio.session_json()?));
    let kept = |(name, json): (String, String)| download("application/json", &name, json);
    answered(studio, made, kept).await
}

async fn open_session(studio: Shared, body: Body) -> Response {
    let text = match text(body, LARGEST_SESSION_BYTES).await {
        Ok(text) => text,
        Err(response) => return *response,
    };
    let opened = move |studio: &Studio| studio.open_session(&text);
    answered(studio, opened, |state| json_of(&state)).await
}

/// What `read` makes of the body.
async fn read<T>(
    body: Body,
    limit: usize,
    read: impl FnOnce(&str) -> Result<T>,
) -> std::result::Result<T, Box<Response>> {
    let text = text(body, limit).await?;
    read(&text).map_err(|wrong| Box::new(error(StatusCode::BAD_REQUEST, &wrong)))
}

/// Asks the studio on a thread of its own, where a panic ends nothing else.
async fn answered<T: Send + 'static>(
    State(studio): Shared,
    ask: impl FnOnce(&Studio) -> Result<T> + Send + 'static,
    reply: impl FnOnce(T) -> Response + Send + 'static,
) -> Response {
    let asked = tokio::task::spawn_blocking(move || match ask(&studio) {
        Ok(answer) => reply(answer),
        Err(wrong) => error(StatusCode::CONFLICT, &wrong),
    });
    asked.await.unwrap_or_else(|_| own_fault())
}

/// `NAME.KIND` after the session's file.
fn file_name(studio: &Studio, kind: &str) -> String {
    let path = std::path::Path::new(studio.session_file());
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let stem = name.strip_suffix(".session.json").or(name.strip_suffix(".json"));
    format!("{}.{kind}", stem.unwrap_or(&name))
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::mpsc;
    use std::time::Duration;

    use axum::http::StatusCode;

    use super::*;
    use crate::{Error, ErrorKind};

    /// An act is answered while a diagnosis is still on its way; that of the variant which was left is
    /// dropped.
    #[test]
    fn no_act_waits_for_a_diagnosis() {
        let folder = tempfile::tempdir().unwrap();
        let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/thrown_ball_drag.json");
        let session = folder.path().join("session.json");
        let studio = Arc::new(Studio::open(Path::new(scene), Some(&session)).unwrap());
        let (begin, begun) = mpsc::channel();
        let (release, released) = mpsc::channel();
        let held = move |studio: &Studio| {
            studio.diagnosis_by(move |_, _, _| {
                begin.send(()).unwrap();
                // It ends by itself only if the act waits for it.
                let is_done = released.recv_timeout(Duration::from_secs(120)).is_ok();
                assert!(is_done, "the act waits");
                Err(Error::new(ErrorKind::Solve, "held"))
            })
        };
        let runtime = tokio::runtime::Runtime::new().unwrap();
        let (acted, diagnosed) = runtime.block_on(async {
            let diagnosed = answered(State(studio.clone()), held, |found| json_of(&found));
            let diagnosed = tokio::spawn(diagnosed);
            tokio::task::spawn_blocking(move || begun.recv().unwrap()).await.unwrap();
            let add = Action::parse(r#"{"do": "add", "effect": "quadratic_drag@ball"}"#).unwrap();
            let act = move |studio: &Studio| studio.act(add);
            let acted = answered(State(studio), act, |state| json_of(&state)).await;
            release.send(()).unwrap();
            let diagnosed = diagnosed.await.unwrap();
            (
                acted.status(),
                (diagnosed.status(), text(diagnosed.into_body(), 1 << 10).await.unwrap()),
            )
        });
        assert_eq!(acted, StatusCode::OK);
        assert_eq!(diagnosed, (StatusCode::OK, "null".to_owned()));
    }
}
