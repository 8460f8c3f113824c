//! Reading and writing whole files: an output appears complete or not at all.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crate::{Error, ErrorKind, Result};

/// The largest input that is read, in bytes; beyond it memory, not physics, would set the limit.
pub const LARGEST_INPUT_BYTES: u64 = 64 << 20;

/// The name that a message uses for `path`; `-` is a standard stream.
pub fn display_name(path: &Path, stream: &str) -> String {
    if path == Path::new("-") { format!("({stream})") } else { path.display().to_string() }
}

/// Reads the text of `path`, or of standard input for `-`.
///
/// # Errors
/// The file can't be read, is larger than [`LARGEST_INPUT_BYTES`], or isn't UTF-8.
pub fn read_text(path: &Path) -> Result<String> {
    let name = display_name(path, "standard input");
    let unreadable = |error: io::Error| {
        Error::new(ErrorKind::Read, format!("can't be read: {}", plain(&error)))
            .in_file(&name)
            .mend("check the path and its permissions")
    };
    let source: Box<dyn Read> = if path == Path::new("-") {
        Box::new(io::stdin().lock())
    } else {
        Box::new(File::open(path).map_err(unreadable)?)
    };
    let mut bytes = Vec::new();
    source.take(LARGEST_INPUT_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > LARGEST_INPUT_BYTES {
        let problem = format!("is larger than {} MiB", LARGEST_INPUT_BYTES >> 20);
        return Err(Error::new(ErrorKind::Read, problem)
            .in_file(&name)
            .mend("keep the poses around the collision, or every n-th of them"));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Error::new(ErrorKind::Parse, format!("byte {at} isn't UTF-8 text"))
            .in_file(&name)
            .mend("save the file as UTF-8")
    })
}

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
    File,
}

impl Output {
    /// Checks that `path` can become an output: not a folder, and in a folder that exists.
    /// `-` is standard output.
    ///
    /// # Errors
    /// The path is a folder, or its folder doesn't exist or can't be written to.
    pub fn check(path: &Path) -> Result<Output> {
        let refuse = |problem: String, mend: &str| {
            Error::new(ErrorKind::Write, problem).in_file(path.display().to_string()).mend(mend)
        };
        let kind = if path == Path::new("-") {
            OutputKind::StandardOutput
        } else {
            match fs::metadata(path) {
                Ok(meta) if meta.is_dir() => {
                    return Err(refuse("is a folder".into(), "name a file in it"));
                }
                Ok(meta) if !meta.is_file() => OutputKind::Stream,
                Ok(meta) if meta.permissions().readonly() => {
                    return Err(refuse(
                        "is read-only".into(),
                        "choose another name, or make the file writable",
                    ));
                }
                _ => OutputKind::File,
            }
        };
        let output = Output { path: path.to_path_buf(), kind };
        if let OutputKind::File = output.kind {
            // A temporary file, made and dropped, shows now what would else fail after the work.
            output.temporary()?;
        }
        Ok(output)
    }

    /// Writes all of `bytes`, or leaves what was there before.
    ///
    /// # Errors
    /// The disk is full, a pipe is closed, or the folder went away.
    pub fn write(&self, bytes: &[u8]) -> Result<()> {
        let fail = |error: io::Error| self.failure(&error);
        match self.kind {
            OutputKind::StandardOutput => print_bytes(bytes),
            OutputKind::Stream => {
                let mut stream = File::options().write(true).open(&self.path).map_err(fail)?;
                stream.write_all(bytes).map_err(fail)
            }
            OutputKind::File => {
                let mut beside = self.temporary()?;
                beside.write_all(bytes).map_err(fail)?;
                beside.as_file().sync_all().map_err(fail)?;
                beside.persist(&self.path).map_err(|error| self.failure(&error.error))?;
                Ok(())
            }
        }
    }

    /// Whether this is standard output, which then carries data and no talk.
    pub fn is_standard_output(&self) -> bool {
        matches!(self.kind, OutputKind::StandardOutput)
    }

    /// The path as the user named it.
    pub fn path(&self) -> &Path {
        &self.path
    }

    fn temporary(&self) -> Result<tempfile::NamedTempFile> {
        let folder = match self.path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".smash-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // As an ordinary new file: the user's umask decides.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        builder.tempfile_in(folder).map_err(|error| self.failure(&error))
    }

    fn failure(&self, error: &io::Error) -> Error {
        let mend = match error.kind() {
            io::ErrorKind::NotFound => "make the folder first, or choose another",
            io::ErrorKind::StorageFull => {
                "free some space, or write elsewhere; nothing was changed"
            }
            _ => "choose another place, or check its permissions",
        };
        Error::new(ErrorKind::Write, format!("can't be written: {}", plain(error)))
            .in_file(self.path.display().to_string())
            .mend(mend)
    }
}

/// Writes to standard output without the panic of `println!` on a closed pipe.
///
/// # Errors
/// The stream is closed or full.
pub fn print_bytes(bytes: &[u8]) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(|error| {
        Error::new(ErrorKind::Write, format!("can't be written: {}", plain(&error)))
            .in_file("(standard output)")
            .mend("keep the reading end open, or write to a file with -o")
    })
}

/// The system's words without its error number.
fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let cut = text.find(" (os error").unwrap_or(text.len());
    let mut chars = text[..cut].chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}
