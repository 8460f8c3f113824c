//! The user's browser.

use std::process::{Child, Command, Stdio};
use std::thread::{sleep, spawn};
use std::time::{Duration, Instant};

/// What opens a file or an address as a double click does.
const OPENER: &[&str] = if cfg!(target_os = "macos") {
    &["open"]
} else if cfg!(windows) {
    &["cmd", "/C", "start", ""]
} else {
    &["xdg-open"]
};
/// An opener that finds no browser says so sooner; one that found it may last as long as the browser.
const PATIENCE: Duration = Duration::from_secs(3);

/// Shows a page, a file or an address, without waiting for what comes of it.
pub fn open(page: &str) {
    if let Some(mut child) = started(page) {
        // Whoever doesn't ask how it ended keeps it as a zombie.
        spawn(move || child.wait());
    }
}

/// Shows a page, and tells whether that was possible, as far as some seconds can tell.
pub fn is_opened(page: &str) -> bool {
    let Some(mut child) = started(page) else { return false };
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        match child.try_wait() {
            Ok(Some(status)) => return status.success(),
            Ok(None) => sleep(Duration::from_millis(20)),
            Err(_) => return false,
        }
    }
    true
}

fn started(page: &str) -> Option<Child> {
    let mut command = Command::new(OPENER[0]);
    command.args(&OPENER[1..]).arg(page);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().ok()
}
