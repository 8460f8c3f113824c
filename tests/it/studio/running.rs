//! A studio that runs as a child process, and a client that sends what it is told.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

const SMASH: &str = env!("CARGO_BIN_EXE_smash");
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A studio; it ends with this.
pub struct Running {
    child: Child,
    pub folder: TempDir,
    pub port: u16,
    /// `/TOKEN/`.
    pub base: String,
    scene: String,
}

/// What a server says.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    /// Names in small letters.
    pub headers: Vec<(String, String)>,
    pub body: String,
}

impl Running {
    /// Of a copy of one of the repository's scenes.
    pub fn of(scene: &str) -> Running {
        let folder = tempfile::tempdir().unwrap();
        std::fs::copy(format!("{ROOT}/scenes/{scene}"), folder.path().join(scene)).unwrap();
        Running::in_folder(folder, scene)
    }

    /// Of the scene of this name in `folder`.
    pub fn in_folder(folder: TempDir, scene: &str) -> Running {
        let mut child = command(&folder, scene).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let told: Value = serde_json::from_str(&line).unwrap();
        let address = told["address"].as_str().unwrap();
        let (host, base) = address.strip_prefix("http://").unwrap().split_once('/').unwrap();
        let port = host.strip_prefix("127.0.0.1:").unwrap().parse().unwrap();
        Running { child, folder, port, base: format!("/{base}"), scene: scene.to_string() }
    }

    /// Killed, with no time to do anything; the folder is left.
    pub fn killed(mut self) -> TempDir {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        std::mem::replace(&mut self.folder, tempfile::tempdir().unwrap())
    }

    /// Killed and started again.
    pub fn again(self) -> Running {
        let scene = self.scene.clone();
        Running::in_folder(self.killed(), &scene)
    }

    /// What it prints when it is started now, and fails.
    pub fn refusal(folder: TempDir, scene: &str) -> String {
        let output = command(&folder, scene).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        assert_eq!(output.stdout, b"");
        String::from_utf8(output.stderr).unwrap()
    }

    /// What a second one on the same session prints; it fails.
    pub fn second(&self) -> String {
        let output = command(&self.folder, &self.scene).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        String::from_utf8(output.stderr).unwrap()
    }

    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// Whether it ended, and how.
    pub fn ended(&mut self) -> Option<i32> {
        self.child.wait().unwrap().code()
    }

    pub fn session_path(&self) -> PathBuf {
        let stem = self.scene.strip_suffix(".json").unwrap();
        self.folder.path().join(format!("{stem}.session.json"))
    }

    pub fn get(&self, path: &str) -> Answer {
        self.request("GET", path, &[], "")
    }

    pub fn post(&self, path: &str, body: &str) -> Answer {
        self.request("POST", path, &[("X-Smash", "1")], body)
    }

    /// As a well-behaved client asks.
    pub fn request(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &str,
    ) -> Answer {
        let host = format!("127.0.0.1:{}", self.port);
        let all = [&[("Host", host.as_str())], headers].concat();
        self.raw(method, &format!("{}{path}", self.base), &all, body)
    }

    /// With nothing added but the body's length.
    pub fn raw(&self, method: &str, target: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        let mut text = format!("{method} {target} HTTP/1.1\r\nConnection: close\r\n");
        for (name, value) in headers {
            text += &format!("{name}: {value}\r\n");
        }
        text += &format!("Content-Length: {}\r\n\r\n{body}", body.len());
        self.sent(text.as_bytes())
    }

    /// Bytes, and all that comes back until the server ends.
    pub fn sent(&self, bytes: &[u8]) -> Answer {
        let mut stream = self.connected();
        // A server may have enough before all is sent.
        let _ = stream.write_all(bytes);
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        Answer::read(&String::from_utf8(answer).unwrap())
    }

    pub fn connected(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(120))).unwrap();
        stream
    }

    pub fn state(&self) -> Value {
        self.get("api/state").json()
    }

    /// Does it, and returns the state.
    pub fn act(&self, action: Value) -> Value {
        self.post("api/act", &action.to_string()).json()
    }

    /// What it is refused with.
    pub fn refused(&self, action: Value) -> Value {
        let before = self.state();
        let answer = self.post("api/act", &action.to_string());
        assert!((400..500).contains(&answer.status), "{action}: {answer:?}");
        assert_eq!(self.state(), before, "{action} changed something");
        let error = answer.value()["error"].clone();
        assert!(error["problem"].is_string(), "{action}: {error}");
        error
    }

    pub fn add(&self, effect: &str) -> Value {
        self.act(json!({"do": "add", "effect": effect}))
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Answer {
    fn read(text: &str) -> Answer {
        let Some((head, body)) = text.split_once("\r\n\r\n") else {
            return Answer { status: 0, headers: Vec::new(), body: text.to_string() };
        };
        let mut lines = head.lines();
        let status = lines.next().unwrap().split(' ').nth(1).unwrap().parse().unwrap();
        let header = |line: &str| {
            let (name, value) = line.split_once(": ").unwrap();
            (name.to_lowercase(), value.to_string())
        };
        Answer { status, headers: lines.map(header).collect(), body: body.to_string() }
    }

    pub fn header(&self, name: &str) -> Option<&str> {
        self.headers.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    pub fn value(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// Of an answer that is no refusal.
    pub fn json(&self) -> Value {
        assert_eq!(self.status, 200, "{self:?}");
        self.value()
    }
}

fn command(folder: &TempDir, scene: &str) -> Command {
    let mut command = Command::new(SMASH);
    command.args(["studio", scene, "--json", "--no-open"]).current_dir(folder.path());
    command.stdin(Stdio::null());
    command
}
