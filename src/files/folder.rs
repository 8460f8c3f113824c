//! A folder to write to, file by file.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::Output;
use super::output::{TEMPORARY, beside, failure};
use crate::{Error, ErrorKind, Result};

/// A folder that takes new files, for one program at a time.
#[derive(Debug)]
pub struct OutputFolder {
    path: PathBuf,
}

impl OutputFolder {
    /// Makes the folder `path` if need be, checks that it can be written to, and clears away the
    /// temporary files that a killed program left there.
    ///
    /// # Errors
    /// The path is a file or a standard stream, or the folder can't be made or written to.
    pub fn open(path: &Path) -> Result<OutputFolder> {
        let no_folder = path == Path::new("-") || (path.exists() && !path.is_dir());
        if no_folder {
            return Err(Error::new(ErrorKind::Write, "isn't a folder")
                .in_file(path.display().to_string())
                .mend("name a folder, or a new one: it is made"));
        }
        let folder = OutputFolder { path: path.into() };
        let unusable = |error: io::Error| failure(path, None, &error);
        fs::create_dir_all(path).map_err(unusable)?;
        for entry in fs::read_dir(path).map_err(unusable)?.flatten() {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            if name.starts_with(TEMPORARY.0) && name.ends_with(TEMPORARY.1) {
                // Another's rubbish that can't be removed does no harm.
                let _ = fs::remove_file(entry.path());
            }
        }
        // A temporary file, made and dropped, shows now what would else fail after the work.
        beside(&path.join("any")).map_err(unusable)?;
        Ok(folder)
    }

    /// Where a file of this name is, or will be.
    pub fn path_of(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// The place of the file `name`, checked as [`Output::check`] does.
    ///
    /// # Errors
    /// The name is a folder's or a read-only file's, or the folder went away.
    pub fn output(&self, name: &str) -> Result<Output> {
        Output::check(&self.path_of(name), &[])
    }

    /// Removes the file `name`, if it is there.
    ///
    /// # Errors
    /// It is there and can't be removed.
    pub fn remove(&self, name: &str) -> Result<()> {
        let path = self.path_of(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(failure(&path, None, &error))
            }
            _ => Ok(()),
        }
    }
}
