//! The port of a session: the same each time, so that a browser finds again what it keeps for the page.

use std::path::Path;

use crate::files::sha256;

/// Beyond those that systems give away by themselves.
const FIRST: u16 = 61_000;

/// The port for the session at `path`.
pub(super) fn usual(path: &Path) -> u16 {
    let digest = sha256(&path.to_string_lossy());
    let number = u32::from_str_radix(&digest[..8], 16).unwrap_or_default();
    let count = u32::from(u16::MAX - FIRST) + 1;
    FIRST + (number % count) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_has_one_port_and_another_one_another() {
        let ports = ["/a/x.session.json", "/a/x.session.json", "/b/x.session.json"]
            .map(|path| usual(Path::new(path)));
        assert!(ports[0] == ports[1] && ports[1] != ports[2]);
        assert!(ports.iter().all(|port| *port >= FIRST));
    }
}
