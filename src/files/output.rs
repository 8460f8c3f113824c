//! Places to write to: what was there before stays until all of the new is there.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::place::{folder_of, is_same_file, resolved};
use super::{plain, print_bytes};
use crate::{Error, ErrorKind, Result};

/// A place to write to, checked before the work starts.
#[derive(Debug)]
pub struct Output {
    path: PathBuf,
    kind: OutputKind,
}

#[derive(Debug)]
enum OutputKind {
    StandardOutput,
    /// A device or pipe: it can only be written in place.
    Stream,
    /// A file: written beside and renamed.
    File {
        /// Where `path` leads to: renaming would replace a link, not what it points to.
        target: PathBuf,
    },
}

impl Output {
    /// Checks that `path` can become an output: not a folder, in a folder that exists, and none of
    /// the `inputs`. `-` is standard output, or input.
    ///
    /// # Errors
    /// The path is a folder or an input, or its folder doesn't exist or can't be written to.
    pub fn check(path: &Path, inputs: &[&Path]) -> Result<Output> {
        let refuse = |problem: &str, mend: &str| {
            Error::new(ErrorKind::Write, problem).in_file(path.display().to_string()).mend(mend)
        };
        if path == Path::new("-") {
            return Ok(Output { path: path.into(), kind: OutputKind::StandardOutput });
        }
        match fs::metadata(path) {
            Ok(meta) if meta.is_dir() => return Err(refuse("is a folder", "name a file in it")),
            Ok(meta) if !meta.is_file() => {
                return Ok(Output { path: path.into(), kind: OutputKind::Stream });
            }
            Ok(meta) if meta.permissions().readonly() => {
                let mend = "choose another name, or make the file writable";
                return Err(refuse("is read-only", mend));
            }
            _ => {}
        }
        let is_input = |input: &&&Path| **input != Path::new("-") && is_same_file(input, path);
        if inputs.iter().any(|input| is_input(&input)) {
            return Err(refuse("is an input: it would be lost", "choose another name"));
        }
        let target = resolved(path).map_err(|error| failure(path, None, &error))?;
        // A temporary file, made and dropped, shows now what would else fail after the work.
        beside(&target).map_err(|error| failure(path, Some(&target), &error))?;
        Ok(Output { path: path.into(), kind: OutputKind::File { target } })
    }

    /// Writes all of `bytes`, or leaves what was there before.
    ///
    /// # Errors
    /// The disk is full, a pipe is closed, or the folder went away.
    pub fn write(&self, bytes: &[u8]) -> Result<()> {
        write_together(&[(self, bytes)])
    }

    /// Whether this is standard output, which then carries data and no talk.
    pub fn is_standard_output(&self) -> bool {
        matches!(self.kind, OutputKind::StandardOutput)
    }

    /// The path as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where it ends: links are followed.
    pub(crate) fn target(&self) -> &Path {
        match &self.kind {
            OutputKind::File { target } => target,
            OutputKind::StandardOutput | OutputKind::Stream => &self.path,
        }
    }

    fn failure(&self, error: &io::Error) -> Error {
        let target = match &self.kind {
            OutputKind::File { target } => Some(target.as_path()),
            OutputKind::StandardOutput | OutputKind::Stream => None,
        };
        failure(&self.path, target, error)
    }
}

/// Checks that two outputs don't end in the same file or both on standard output.
///
/// # Errors
/// They do.
pub fn check_distinct(one: &Output, other: &Output) -> Result<()> {
    let refuse = |file: String, mend: &str| {
        Err(Error::new(ErrorKind::Write, "two outputs can't share it").in_file(file).mend(mend))
    };
    match (&one.kind, &other.kind) {
        (OutputKind::StandardOutput, OutputKind::StandardOutput) => {
            refuse("(standard output)".into(), "give one of them a file")
        }
        (OutputKind::File { .. }, OutputKind::File { .. })
            if is_same_file(&one.path, &other.path) =>
        {
            refuse(other.path.display().to_string(), "choose another name for one of them")
        }
        _ => Ok(()),
    }
}

/// Writes each output's bytes. All files are complete beside their places before the first takes
/// its place, and after all streams: if one can't be written, no file is changed.
///
/// # Errors
/// As [`Output::write`].
pub fn write_together(parts: &[(&Output, &[u8])]) -> Result<()> {
    let mut staged =
        parts.iter().map(|&(output, bytes)| stage(output, bytes)).collect::<Result<Vec<_>>>()?;
    staged.sort_by_key(|one| matches!(one.content, Content::Beside(..)));
    staged.into_iter().try_for_each(Staged::commit)
}

/// An output that is as good as written.
struct Staged<'a> {
    output: &'a Output,
    content: Content<'a>,
}

enum Content<'a> {
    /// For a stream, which has no beside.
    Bytes(&'a [u8]),
    /// The temporary file and the path that it is to have.
    Beside(NamedTempFile, &'a Path),
}

fn stage<'a>(output: &'a Output, bytes: &'a [u8]) -> Result<Staged<'a>> {
    let content = match &output.kind {
        OutputKind::StandardOutput | OutputKind::Stream => Content::Bytes(bytes),
        OutputKind::File { target } => {
            let file = filled(target, bytes).map_err(|error| output.failure(&error))?;
            Content::Beside(file, target)
        }
    };
    Ok(Staged { output, content })
}

impl Staged<'_> {
    fn commit(self) -> Result<()> {
        let written = match self.content {
            Content::Bytes(bytes) if self.output.is_standard_output() => return print_bytes(bytes),
            Content::Bytes(bytes) => File::options()
                .write(true)
                .open(&self.output.path)
                .and_then(|mut stream| stream.write_all(bytes)),
            Content::Beside(file, target) => {
                file.persist(target).map_err(|error| error.error).map(|_| settle(target))
            }
        };
        written.map_err(|error| self.output.failure(&error))
    }
}

/// Makes the new name last, too, should the power fail now.
fn settle(target: &Path) {
    // Where a folder can't be opened or synchronised, the system sees to it.
    let _ = File::open(folder_of(target)).and_then(|folder| folder.sync_all());
}

/// A temporary file beside `target` that holds `bytes`, with the mode of what it will replace.
fn filled(target: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let mut file = beside(target)?;
    file.write_all(bytes)?;
    if let Ok(meta) = fs::metadata(target) {
        file.as_file().set_permissions(meta.permissions())?;
    }
    file.as_file().sync_all()?;
    Ok(file)
}

/// How the name of a temporary file begins and ends.
pub(super) const TEMPORARY: (&str, &str) = (".smash-", ".tmp");

/// A new temporary file in the folder of `target`.
pub(super) fn beside(target: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY.0).suffix(TEMPORARY.1);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // As an ordinary new file: the user's umask decides.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder_of(target))
}

/// The error for an output at `path`; only a file has a `target`.
pub(super) fn failure(path: &Path, target: Option<&Path>, error: &io::Error) -> Error {
    let folder = folder_of(target.unwrap_or(path));
    let mend = match error.kind() {
        io::ErrorKind::NotFound if folder.is_dir() => {
            "choose another folder: this one takes no new files"
        }
        io::ErrorKind::NotFound => "make the folder first, or choose another",
        io::ErrorKind::StorageFull if target.is_some() => {
            "free some space, or write elsewhere; nothing was changed"
        }
        io::ErrorKind::StorageFull => "free some space, or write elsewhere",
        _ => "choose another place, or check its permissions",
    };
    Error::new(ErrorKind::Write, format!("can't be written: {}", plain(error)))
        .in_file(path.display().to_string())
        .mend(mend)
}
