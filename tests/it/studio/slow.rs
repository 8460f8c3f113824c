//! Broken, huge and dawdling requests: each costs little, and none ends the server.

use std::io::{Read, Write};
use std::net::Shutdown;

use serde_json::json;

use super::Running;

const SCENE: &str = "thrown_ball_drag.json";

#[test]
fn broken_requests_are_answered_or_dropped() {
    let studio = Running::of(SCENE);
    let head = format!(
        "POST {}api/act HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Smash: 1\r\nConnection: close\r\n",
        studio.base, studio.port
    );
    let cases: Vec<Vec<u8>> = vec![
        b"\r\n\r\n".to_vec(),
        b"nonsense\r\n\r\n".to_vec(),
        b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03".to_vec(),
        b"GET / HTTP/9.9\r\n\r\n".to_vec(),
        b"GET /\x00 HTTP/1.1\r\n\r\n".to_vec(),
        format!("{head}Content-Length: x\r\n\r\n{{}}").into_bytes(),
        format!("{head}Content-Length: 5\r\nContent-Length: 6\r\n\r\n{{}}").into_bytes(),
        format!("{head}Content-Length: -1\r\n\r\n{{}}").into_bytes(),
        format!("{head}Transfer-Encoding: chunked\r\n\r\nzz\r\n").into_bytes(),
        format!("{head}Transfer-Encoding: chunked\r\nContent-Length: 3\r\n\r\n0\r\n\r\n")
            .into_bytes(),
        format!("{head}X: {}\r\n\r\n", "y".repeat(100_000)).into_bytes(),
        format!("{head}{}\r\n", "A: b\r\n".repeat(5_000)).into_bytes(),
        [format!("{head}Content-Length: 4\r\n\r\n").as_bytes(), b"\xff\xfe\x00\x01"].concat(),
    ];
    for case in cases {
        let mut stream = studio.connected();
        let _ = stream.write_all(&case);
        let _ = stream.shutdown(Shutdown::Write);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        let answer = String::from_utf8_lossy(&answer);
        let start = String::from_utf8_lossy(&case[..case.len().min(40)]).into_owned();
        assert!(
            answer.is_empty()
                || answer.starts_with("HTTP/1.1 4")
                || answer.starts_with("HTTP/1.0 4"),
            "{start:?}: {answer}"
        );
    }
    assert_eq!(studio.state()["current"], 0);
}

#[test]
fn json_that_is_none_gets_a_place_and_a_mend() {
    let studio = Running::of(SCENE);
    let deep = "[".repeat(100_000);
    for body in [
        "",
        "{",
        "{}",
        "null",
        "nul",
        "[1, 2",
        "{\"do\": \"add\", \"do\": \"undo\"}",
        "\"add\"",
        "1e999",
        deep.as_str(),
    ] {
        for path in ["api/act", "api/law", "api/session"] {
            let answer = studio.post(path, body);
            assert!(matches!(answer.status, 400 | 409), "{path}: {answer:?}");
            assert!(answer.value()["error"]["problem"].is_string(), "{path}: {answer:?}");
        }
    }
    assert_eq!(studio.state()["revision"], 1);
}

#[test]
fn huge_bodies_are_refused() {
    let studio = Running::of(SCENE);
    for (path, limit) in [("api/act", 512 << 10), ("api/law", 1 << 20), ("api/session", 8 << 20)] {
        let answer = studio.post(path, &" ".repeat(limit + 1));
        // A server that doesn't read to the end may break off before it is heard.
        assert!(matches!(answer.status, 413 | 0), "{path}: {}", answer.status);
        let announced = format!(
            "POST {}{path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Smash: 1\r\nConnection: close\r\nContent-Length: 99999999999\r\n\r\n{{}}",
            studio.base, studio.port
        );
        assert_eq!(studio.sent(announced.as_bytes()).status, 413, "{path}");
    }
    // Within the limit of bytes, but no law.
    let draft = json!({"draft": "x".repeat(257 << 10)}).to_string();
    let answer = studio.post("api/law", &draft);
    assert_eq!((answer.status, &answer.value()["error"]["place"]), (409, &json!("draft")));
    let draft = json!({"draft": "x".repeat(255 << 10)}).to_string();
    assert_eq!(studio.post("api/law", &draft).json()["effect"], json!(null));
}

/// More connections than are served at once, none of which asks anything: the first have to leave, and
/// all others are answered while the server still has patience with the rest.
#[test]
fn whoever_asks_nothing_keeps_nobody_out() {
    let studio = Running::of(SCENE);
    let host = format!("Host: 127.0.0.1:{}\r\n", studio.port);
    let head = format!("GET {}api/state HTTP/1.1\r\nConnection: close\r\n", studio.base);
    let act = format!("POST {}api/act HTTP/1.1\r\n{host}X-Smash: 1\r\n", studio.base);
    let begin = |index: usize| {
        let mut stream = studio.connected();
        let half_body = format!("{act}Content-Length: 40\r\n\r\n{{\"do\"");
        let begun = if index.is_multiple_of(2) { &head } else { &half_body };
        stream.write_all(begun.as_bytes()).unwrap();
        stream
    };
    let mut guests: Vec<_> = (0..300).map(begin).collect();
    assert_eq!(studio.state()["current"], 0);
    // Half a request is still no reason to leave, but for the first.
    let patient = &mut guests[200];
    patient.write_all(format!("{host}\r\n").as_bytes()).unwrap();
    let mut answer = String::new();
    patient.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
}

/// Whose request or answer is on its way stays, though all places are taken, as long as there are others
/// who ask nothing.
#[test]
fn whoever_is_slow_with_a_body_is_not_sent_away_for_who_asks_nothing() {
    let studio = Running::of(SCENE);
    let host = format!("Host: 127.0.0.1:{}\r\n", studio.port);
    let body = r#"{"do": "add", "effect": "quadratic_drag@ball"}"#;
    let mut sends = studio.connected();
    let head = format!(
        "POST {}api/act HTTP/1.1\r\n{host}X-Smash: 1\r\nConnection: close\r\nContent-Length: {}\r\n\r\n",
        studio.base,
        body.len()
    );
    sends.write_all(format!("{head}{}", &body[..9]).as_bytes()).unwrap();
    // More than sockets hold, and nobody reads it yet.
    let state = format!("GET {}api/state HTTP/1.1\r\n{host}", studio.base);
    let length = studio.get("api/state").body.len();
    let count = 1 + (16 << 20) / length;
    let asked =
        format!("{state}\r\n").repeat(count - 1) + &format!("{state}Connection: close\r\n\r\n");
    let mut reads = studio.connected();
    reads.write_all(asked.as_bytes()).unwrap();
    let mut first = [0; 8];
    reads.read_exact(&mut first).unwrap();
    let idle: Vec<_> = (0..300).map(|_| studio.connected()).collect();
    assert_eq!(studio.state()["current"], 0);
    sends.write_all(&body.as_bytes()[9..]).unwrap();
    let mut answer = String::new();
    sends.read_to_string(&mut answer).unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    let mut rest = Vec::new();
    let _ = reads.read_to_end(&mut rest);
    let rest = String::from_utf8_lossy(&rest);
    // Whole to the last: each ends as a state does.
    assert_eq!(rest.matches("\"schema\":\"smash.studio/1\"").count(), count);
    assert!(rest.ends_with("}}"), "{}", &rest[rest.len() - 80..]);
    drop(idle);
}

/// Half a head, half a body: after ten seconds the server has no more patience.
#[test]
fn whoever_dawdles_is_sent_away() {
    let studio = Running::of(SCENE);
    let mut half_head = studio.connected();
    half_head
        .write_all(format!("GET {}api/state HTTP/1.1\r\nHost:", studio.base).as_bytes())
        .unwrap();
    let mut half_body = studio.connected();
    let head = format!(
        "POST {}api/act HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Smash: 1\r\nContent-Length: 40\r\n\r\n{{\"do\"",
        studio.base, studio.port
    );
    half_body.write_all(head.as_bytes()).unwrap();
    assert_eq!(studio.state()["current"], 0);
    let mut answers = [String::new(), String::new()];
    let _ = half_head.read_to_string(&mut answers[0]);
    let _ = half_body.read_to_string(&mut answers[1]);
    assert!(answers[0].is_empty() || answers[0].starts_with("HTTP/1.1 408"), "{}", answers[0]);
    assert!(answers[1].starts_with("HTTP/1.1 408"), "{}", answers[1]);
}
