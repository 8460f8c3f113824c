//! Where a session is saved: whole, after each act.

use std::path::{Path, PathBuf};

use super::LARGEST_SESSION_BYTES;
use super::lock::Lock;
use crate::files::{Output, read_text_up_to, sha256};
use crate::{Error, ErrorKind, Result};

/// The session's file, and what was in it when it was read or written last.
#[derive(Debug)]
pub(super) struct Save {
    output: Output,
    name: String,
    /// SHA-256 of the file as it was seen last; `None` where it wasn't there.
    known: Option<String>,
    /// Only this studio writes it.
    _lock: Lock,
}

impl Save {
    /// The file at `session`, or beside the scene.
    ///
    /// # Errors
    /// It couldn't be written, another studio has it, or a scene from standard input has none beside it.
    pub(super) fn open(scene: &Path, session: Option<&Path>) -> Result<Save> {
        let path = match session {
            Some(path) if path == Path::new("-") => {
                return Err(Error::new(ErrorKind::Write, "a session can't be saved there")
                    .in_file("(standard output)")
                    .mend("name a file: --session FILE"));
            }
            Some(path) => path.to_path_buf(),
            None => beside(scene)?,
        };
        let output = Output::check(&path, &[scene])?;
        let lock = Lock::take(&output)?;
        Ok(Save { output, name: path.display().to_string(), known: None, _lock: lock })
    }

    /// The file's whole path.
    pub(super) fn path(&self) -> &Path {
        self.output.target()
    }

    /// How the file is called.
    pub(super) fn name(&self) -> &str {
        &self.name
    }
}

impl Save {
    /// What was saved before; `None` if nothing was.
    ///
    /// # Errors
    /// The file can't be read, or is too large.
    pub(super) fn read(&mut self) -> Result<Option<String>> {
        let text = self.on_disk()?;
        self.known = text.as_deref().map(sha256);
        Ok(text)
    }

    /// Saves `text` instead of what was there.
    ///
    /// # Errors
    /// The file can't be written, or somebody else has changed it; then it stays as it is.
    pub(super) fn write(&mut self, text: &str) -> Result<()> {
        let found = self.on_disk()?.as_deref().map(sha256);
        // Other studios are locked out; an editor or a copy may have been here since.
        // One that was removed is made again: nothing is lost by that.
        if found.is_some() && found != self.known {
            return Err(Error::new(ErrorKind::Write, "another program has changed it; it was left as it is")
                .in_file(&self.name)
                .mend("keep one studio for each session: start this one again to go on from what is saved"));
        }
        self.output.write(text.as_bytes())?;
        self.known = Some(sha256(text));
        Ok(())
    }

    fn on_disk(&self) -> Result<Option<String>> {
        let path = self.output.path();
        if !path.exists() {
            return Ok(None);
        }
        let limit = LARGEST_SESSION_BYTES as u64;
        read_text_up_to(limit, path, "name another session: --session FILE").map(Some)
    }
}

/// `NAME.session.json` beside `NAME.json`.
fn beside(scene: &Path) -> Result<PathBuf> {
    match scene.file_stem() {
        Some(stem) if scene != Path::new("-") => {
            let mut name = stem.to_os_string();
            name.push(".session.json");
            Ok(scene.with_file_name(name))
        }
        _ => Err(Error::new(ErrorKind::Write, "a session has no place beside it")
            .in_file("(standard input)")
            .mend("name one: --session FILE")),
    }
}
