//! What leaves the studio as a file, to be kept, and what comes back.

use super::diagnoses::subject;
use super::file::{SESSION_SCHEMA, SessionFile};
use super::state::StudioState;
use super::{Studio, locked};
use crate::{Error, ErrorKind, Result};

impl Studio {
    /// The page of the current variant and those that are compared, to be kept; with the diagnosis, if
    /// it was asked for.
    ///
    /// # Errors
    /// This build has no page.
    pub fn report_page(&self) -> Result<String> {
        let shown = self.shown();
        let mut report = shown.report();
        report.diagnosis = self.diagnoses.known(&subject(&shown.session));
        report.commands = self.commands();
        crate::report::page(&report)
    }

    /// The session's file, as it is saved.
    ///
    /// # Errors
    /// It is too large.
    pub fn session_json(&self) -> Result<String> {
        SessionFile::of(&self.shown().session, &self.identity).to_json()
    }

    /// Adds the variants of a saved session of the same scene, and goes to the one that it shows. What
    /// was there stays; so does the draft, unless it is empty.
    ///
    /// # Errors
    /// It is no session of this scene, a model can't be fitted, or the session can't be saved; nothing
    /// is changed.
    pub fn open_session(&self, text: &str) -> Result<StudioState> {
        let opened = opened_file(text)?.session(&self.scene, &self.identity)?;
        let mut acting = locked(&self.acting);
        let before = self.shown();
        let mut session = before.session.clone();
        session.tree.graft(&opened.tree)?;
        session.check_laws()?;
        if session.draft.trim().is_empty() {
            session.draft = opened.draft;
        }
        let after = self.fitted(&mut acting, session, &before)?;
        let shown = self.show(&mut acting, after)?;
        Ok(self.state_of(&shown))
    }
}

/// A session that somebody chose among files of all kinds.
fn opened_file(text: &str) -> Result<SessionFile> {
    SessionFile::parse(text, "the session").map_err(|error| match error.place() {
        Some("schema") => {
            let problem = format!("{}, no session", error.problem());
            Error::new(ErrorKind::Invalid, problem).in_file("the file").mend(format!(
                "open one that a studio saved (`{SESSION_SCHEMA}`), such as NAME.session.json; a result \
                 is for `smash report SCENE RESULT`"
            ))
        }
        _ => error,
    })
}
