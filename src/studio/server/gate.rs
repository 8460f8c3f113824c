//! What every request must pass, before anything is made of it.
//!
//! A page from elsewhere, in the same browser, can send requests here. It doesn't know the token; its
//! name, made to lead here (DNS rebinding), would stand in `Host`; its `Origin` is its own; and a
//! header of its own (`X-Smash`) a browser sends to another origin only after asking, which is never
//! answered.

use axum::extract::{Request, State};
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, HOST, ORIGIN, REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode};
use axum::middleware::Next;
use axum::response::Response;

use super::reply::{nothing_here, refused};
use super::token::Token;

/// Which requests are let through.
#[derive(Debug, Clone)]
pub(super) struct Gate {
    pub(super) port: u16,
    pub(super) token: Token,
}

/// On all answers, also those that say nothing.
const HEADERS: [(HeaderName, &str); 6] = [
    (CONTENT_SECURITY_POLICY, "frame-ancestors 'none'"),
    (X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (REFERRER_POLICY, "no-referrer"),
    (CACHE_CONTROL, "no-store"),
    (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
    (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
];

/// Lets a request through, or answers it.
pub(super) async fn gate(State(gate): State<Gate>, request: Request, next: Next) -> Response {
    let mut response = match gate.refusal(&request) {
        Some(refusal) => refusal,
        None => next.run(request).await,
    };
    for (name, value) in HEADERS {
        response.headers_mut().insert(name, HeaderValue::from_static(value));
    }
    response
}

impl Gate {
    fn refusal(&self, request: &Request) -> Option<Response> {
        if !self.is_for_this_host(request) {
            return Some(refused(
                StatusCode::MISDIRECTED_REQUEST,
                "the request is for another host",
                "open the address that smash printed, as it stands there",
            ));
        }
        let path = request.uri().path();
        let guess = path.strip_prefix('/').and_then(|rest| rest.split('/').next());
        if !self.token.is(guess.unwrap_or_default()) {
            return Some(nothing_here());
        }
        if !self.is_own_origin(request.headers()) {
            return Some(refused(
                StatusCode::FORBIDDEN,
                "the request is from another page",
                "use the studio's own page",
            ));
        }
        let has_header = request.headers().get("x-smash").is_some_and(|value| value == "1");
        if *request.method() == Method::POST && !has_header {
            return Some(refused(
                StatusCode::FORBIDDEN,
                "the header `X-Smash: 1` is missing",
                "send `X-Smash: 1`",
            ));
        }
        None
    }

    /// Whether the one `Host`, and the address if the request names it in full, is this server.
    fn is_for_this_host(&self, request: &Request) -> bool {
        let mut hosts = request.headers().get_all(HOST).iter();
        let host = hosts.next().is_some_and(|host| self.is_own_name(host.as_bytes()));
        let authority = request.uri().authority();
        host && hosts.next().is_none()
            && authority.is_none_or(|authority| self.is_own_name(authority.as_str().as_bytes()))
    }

    fn is_own_name(&self, name: &[u8]) -> bool {
        self.names().iter().any(|own| own.as_bytes().eq_ignore_ascii_case(name))
    }

    /// Whether no origin is named but this server's own.
    fn is_own_origin(&self, headers: &HeaderMap) -> bool {
        let is_own = |origin: &HeaderValue| {
            let own = self.names().map(|name| format!("http://{name}"));
            own.iter().any(|own| own.as_bytes().eq_ignore_ascii_case(origin.as_bytes()))
        };
        headers.get_all(ORIGIN).iter().all(is_own)
    }

    /// As browsers write them: without the port where it is HTTP's own.
    fn names(&self) -> [String; 2] {
        ["127.0.0.1", "localhost"].map(|name| match self.port {
            80 => name.to_string(),
            port => format!("{name}:{port}"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Browsers leave HTTP's own port out.
    #[test]
    fn port_80_has_no_number() {
        let gate = |port| Gate { port, token: Token::new().unwrap() };
        assert!(gate(80).is_own_name(b"127.0.0.1") && gate(80).is_own_name(b"localhost"));
        assert!(!gate(81).is_own_name(b"127.0.0.1") && gate(81).is_own_name(b"127.0.0.1:81"));
        let from = |origin| HeaderMap::from_iter([(ORIGIN, HeaderValue::from_static(origin))]);
        assert!(gate(80).is_own_origin(&from("http://127.0.0.1")));
        assert!(!gate(81).is_own_origin(&from("http://127.0.0.1")));
    }
}
