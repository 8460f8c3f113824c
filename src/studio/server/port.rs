//! The port of a session: the same each time, so that a browser finds again what it keeps for the page.

/// Beyond those that Linux gives away by itself; elsewhere another program may have one, and then any that
/// is free is taken.
const FIRST: u16 = 61_000;

/// The port for the session with this number, in hexadecimal digits.
pub(super) fn usual(session: &str) -> u16 {
    let number = u64::from_str_radix(session, 16).unwrap_or_default() >> 32;
    let count = u64::from(u16::MAX - FIRST) + 1;
    FIRST + (number % count) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_session_has_one_port_and_another_one_another() {
        let ports = ["00000001aaaaaaaa", "00000001aaaaaaaa", "ffffffffaaaaaaaa"].map(usual);
        assert!(ports[0] == ports[1] && ports[1] != ports[2]);
        assert!(ports.iter().all(|port| *port >= FIRST));
    }
}
