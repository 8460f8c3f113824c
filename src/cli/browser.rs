//! The user's browser.

use std::io;
use std::process::{Command, Stdio};

/// What opens a file or an address as a double click does.
const OPENER: &[&str] = if cfg!(target_os = "macos") {
    &["open"]
} else if cfg!(windows) {
    &["cmd", "/C", "start", ""]
} else {
    &["xdg-open"]
};

/// Shows a page, a file or an address, without waiting for its end.
///
/// # Errors
/// There is nothing that opens it.
pub fn open(page: &str) -> io::Result<()> {
    let mut command = Command::new(OPENER[0]);
    command.args(&OPENER[1..]).arg(page);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn()?;
    // Whoever doesn't ask how it ended keeps it as a zombie.
    std::thread::spawn(move || child.wait());
    Ok(())
}
