//! Who doesn't know the address, or comes from elsewhere, gets nothing.

use super::Running;

const SCENE: &str = "thrown_ball_drag.json";
const ACT: &str = r#"{"do": "add", "effect": "quadratic_drag@ball"}"#;

#[test]
fn a_wrong_address_says_what_to_do_and_nothing_else() {
    let studio = Running::of(SCENE);
    let token = studio.base.trim_matches('/').to_string();
    assert_eq!(token.len(), 32);
    assert!(token.chars().all(|c| c.is_ascii_hexdigit()));
    let host = format!("127.0.0.1:{}", studio.port);
    let told = studio.get("no/such/path").body;
    assert!(told.contains("open the address that it printed"), "{told}");
    let wrong = [
        "/".to_string(),
        format!("/{}", "0".repeat(32)),
        format!("/{}/", "0".repeat(32)),
        format!("/{}/api/state", &token[..31]),
        format!("/{token}0/api/state"),
        format!("/{}/api/state", token.to_uppercase()),
        format!("//{token}/api/state"),
        format!("/api/state?token={token}"),
        "/robots.txt".to_string(),
        "/../../../../etc/passwd".to_string(),
        format!("/%2e%2e/{token}/api/state"),
        "*".to_string(),
    ];
    for target in &wrong {
        for method in ["GET", "POST", "OPTIONS", "PUT"] {
            let answer = studio.raw(method, target, &[("Host", &host), ("X-Smash", "1")], ACT);
            // In capitals it is another token, unless it has no letters.
            if !target.starts_with(&studio.base) {
                assert!(matches!(answer.status, 400 | 404), "{method} {target}: {answer:?}");
                // Whether the token was near, or right and the path wrong, isn't told.
                let is_same = answer.status == 400 || answer.body == told;
                assert!(is_same, "{method} {target}: {answer:?}");
            }
        }
    }
    assert_eq!(studio.state()["current"], 0);
}

/// Under the token there are the routes, and nothing else: no path leads to a file.
#[test]
fn path_tricks_lead_nowhere() {
    let studio = Running::of(SCENE);
    for path in [
        "..",
        "../..",
        "../../etc/passwd",
        "%2e%2e/%2e%2e/etc/passwd",
        "..%2f..%2fetc%2fpasswd",
        "api/../api/state",
        "api/%2e%2e/state",
        "api/state/",
        "api//state",
        "api/state%00",
        "api/state/../../../etc/passwd",
        "thrown_ball_drag.json",
        "thrown_ball_drag.session.json",
        "api",
        "API/STATE",
        "{path}",
        "\\..\\..\\etc\\passwd",
    ] {
        let answer = studio.get(path);
        assert!(matches!(answer.status, 400 | 404), "{path}: {answer:?}");
        assert!(!answer.body.contains("root:") && !answer.body.contains("smash.scene"), "{path}");
    }
    // What goes behind the path changes nothing.
    assert_eq!(studio.get("api/state?file=/etc/passwd").json()["schema"], "smash.studio/1");
}

#[test]
fn another_host_is_refused() {
    let studio = Running::of(SCENE);
    let port = studio.port;
    let target = format!("{}api/state", studio.base);
    for host in [
        "evil.example",
        &format!("evil.example:{port}"),
        "127.0.0.1",
        &format!("127.0.0.1:{}", port - 1),
        &format!("127.0.0.1.evil.example:{port}"),
        &format!("localhost.:{port}"),
        &format!("[::1]:{port}"),
        &format!("0.0.0.0:{port}"),
        "",
    ] {
        let answer = studio.raw("GET", &target, &[("Host", host)], "");
        assert!(matches!(answer.status, 400 | 421), "{host}: {answer:?}");
        if answer.status == 421 {
            let mend = answer.value()["error"]["mend"].clone();
            assert!(mend.as_str().unwrap().contains("the address that smash printed"), "{host}");
        }
    }
    let own = format!("127.0.0.1:{port}");
    let none = studio.raw("GET", &target, &[], "");
    assert!(matches!(none.status, 400 | 421), "{none:?}");
    let two = studio.raw("GET", &target, &[("Host", &own), ("Host", "evil.example")], "");
    assert!(matches!(two.status, 400 | 421), "{two:?}");
    let full = format!("http://evil.example:{port}{target}");
    assert_eq!(studio.raw("GET", &full, &[("Host", &own)], "").status, 421);
    for host in [own, format!("localhost:{port}")] {
        assert_eq!(studio.raw("GET", &target, &[("Host", &host)], "").status, 200, "{host}");
    }
}

#[test]
fn another_origin_and_a_missing_header_are_refused() {
    let studio = Running::of(SCENE);
    let port = studio.port;
    for origin in [
        "http://evil.example",
        "null",
        "https://127.0.0.1",
        &format!("https://127.0.0.1:{port}"),
        &format!("http://127.0.0.1:{}", port - 1),
        &format!("http://localhost:{port}.evil.example"),
    ] {
        for method in ["GET", "POST"] {
            let path = if method == "GET" { "api/state" } else { "api/act" };
            let answer = studio.request(method, path, &[("X-Smash", "1"), ("Origin", origin)], ACT);
            assert_eq!(answer.status, 403, "{method} from {origin}: {answer:?}");
            assert_eq!(answer.header("access-control-allow-origin"), None);
        }
    }
    for header in [("Content-Type", "text/plain"), ("X-Smash", "0"), ("X-Smash", "")] {
        let answer = studio.request("POST", "api/act", &[header], ACT);
        assert_eq!(answer.status, 403, "{header:?}");
        assert!(answer.value()["error"]["mend"].as_str().unwrap().contains("X-Smash: 1"));
    }
    // A browser asks first; it gets no permission.
    let asked = [("Origin", "http://evil.example"), ("Access-Control-Request-Method", "POST")];
    let answer = studio.request("OPTIONS", "api/act", &asked, "");
    assert_eq!((answer.status, answer.header("access-control-allow-methods")), (403, None));
    assert_eq!(studio.state()["current"], 0, "nothing was done");
    let own = format!("http://localhost:{port}");
    let answer = studio.request("POST", "api/act", &[("X-Smash", "1"), ("Origin", &own)], ACT);
    assert_eq!(answer.json()["current"], 1);
}

#[test]
fn every_answer_has_the_headers_that_shut_others_out() {
    let studio = Running::of(SCENE);
    let wanted = [
        ("content-security-policy", "frame-ancestors 'none'"),
        ("x-content-type-options", "nosniff"),
        ("referrer-policy", "no-referrer"),
        ("cache-control", "no-store"),
        ("cross-origin-resource-policy", "same-origin"),
    ];
    for (path, status) in [("", 200), ("api/state", 200), ("api/session", 200), ("nothing", 404)] {
        let answer = studio.get(path);
        assert_eq!(answer.status, status, "{path}");
        for (name, value) in wanted {
            assert_eq!(answer.header(name), Some(value), "{path}: {name}");
        }
    }
}

/// A wrong way to ask is told apart from a wrong address, and from what may not be asked.
#[test]
fn a_wrong_method_is_told() {
    let studio = Running::of(SCENE);
    for (method, path) in [
        ("PUT", "api/state"),
        ("DELETE", "api/session"),
        ("OPTIONS", "api/act"),
        ("GET", "api/act"),
        ("PUT", ""),
    ] {
        let answer = studio.request(method, path, &[], "");
        assert_eq!(answer.status, 405, "{method} {path}: {answer:?}");
        assert!(answer.header("allow").is_some(), "{method} {path}: {answer:?}");
        assert!(answer.value()["error"]["mend"].is_string(), "{method} {path}");
    }
    assert_eq!(studio.post("api/state", "").status, 405);
}

/// Typed without its last stroke, the address leads to the page, too.
#[test]
fn the_address_without_its_last_stroke_leads_to_the_page() {
    let studio = Running::of(SCENE);
    let host = format!("127.0.0.1:{}", studio.port);
    let answer = studio.raw("GET", studio.base.trim_end_matches('/'), &[("Host", &host)], "");
    assert_eq!((answer.status, answer.header("location")), (308, Some(studio.base.as_str())));
}

/// Only this machine reaches it.
#[test]
fn it_listens_on_the_loopback_address_alone() {
    let studio = Running::of(SCENE);
    let tables = std::fs::read_to_string("/proc/net/tcp").unwrap()
        + &std::fs::read_to_string("/proc/net/tcp6").unwrap_or_default();
    let port = format!(":{:04X}", studio.port);
    let listens = |line: &&str| {
        let mut words = line.split_whitespace();
        words.nth(1).is_some_and(|own| own.ends_with(&port)) && words.nth(1) == Some("0A")
    };
    let own: Vec<&str> = tables.lines().filter(listens).collect();
    assert_eq!(own.len(), 1, "{own:?}");
    assert!(own[0].contains("0100007F:"), "{own:?}");
}

/// Two studios have two addresses; a taken port is said.
#[test]
fn each_studio_has_an_address_of_its_own() {
    let (one, other) = (Running::of(SCENE), Running::of(SCENE));
    assert_ne!(one.base, other.base);
    let folder = tempfile::tempdir().unwrap();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/thrown_ball_drag.json");
    std::fs::copy(scene, folder.path().join(SCENE)).unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_smash"))
        .args(["studio", SCENE, "--port", &one.port.to_string()])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(told.contains("can't be used") && told.contains("hint: leave `--port` out"), "{told}");
}
