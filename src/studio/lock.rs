//! One studio for each session: a lock beside the session's file, which ends with the program however
//! that ends.

use std::fs::{File, TryLockError};
use std::path::{Path, PathBuf};

use crate::files::{Output, is_same_file_as, plain};
use crate::{Error, ErrorKind, Result};

/// A session that is this studio's alone, as long as this is there.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    /// Closed, it is free.
    _file: File,
}

impl Lock {
    /// Takes the session of the file `output`.
    ///
    /// # Errors
    /// Another studio has it.
    pub(super) fn take(output: &Output) -> Result<Lock> {
        let path = beside(output.target());
        loop {
            // Never emptied: it may be a link to somebody's file.
            let opened = File::options().write(true).create(true).truncate(false).open(&path);
            let file = opened.map_err(|error| {
                Error::new(ErrorKind::Write, format!("can't be made: {}", plain(&error)))
                    .in_file(path.display().to_string())
                    .mend("choose another place for the session: --session FILE")
            })?;
            match file.try_lock() {
                Err(TryLockError::WouldBlock) => {
                    return Err(Error::new(ErrorKind::Write, "is open in another studio")
                        .in_file(output.path().display().to_string())
                        .mend("use that one, or end it; or name another session: --session FILE"));
                }
                // Where files can't be locked, an act still refuses to overwrite another studio's.
                Err(TryLockError::Error(_)) | Ok(()) => {}
            }
            // Its last owner may just have removed it.
            if is_same_file_as(&file, &path) {
                return Ok(Lock { path, _file: file });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // One that stays does no harm; a file of somebody's with something in it isn't ours.
        if std::fs::metadata(&self.path).is_ok_and(|found| found.len() == 0) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// `.NAME.lock` beside NAME.
fn beside(path: &Path) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".lock");
    path.with_file_name(name)
}
