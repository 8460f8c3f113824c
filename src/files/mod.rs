//! Reading and writing whole files: an output appears complete or not at all.

mod digest;
mod folder;
mod output;
mod place;

pub(crate) use digest::sha256;
pub use folder::OutputFolder;
pub use output::{Output, check_distinct, write_together};
pub(crate) use place::{folder_of, is_same_file_as};

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use crate::{Error, ErrorKind, Result};

/// The largest input that is read, in bytes; beyond it memory, not physics, would set the limit.
pub const LARGEST_INPUT_BYTES: u64 = 64 << 20;

/// The name that a message uses for `path`; `-` is a standard stream.
pub fn display_name(path: &Path, stream: &str) -> String {
    if path == Path::new("-") { format!("({stream})") } else { path.display().to_string() }
}

/// `text` as one word of a shell's command line, for commands that a message proposes.
pub fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./+,:=@%".contains(c);
    // A leading hyphen would make it an option.
    let folder = if text.starts_with('-') { "./" } else { "" };
    if !text.is_empty() && text.chars().all(is_plain) {
        format!("{folder}{text}")
    } else {
        format!("'{folder}{}'", text.replace('\'', r"'\''"))
    }
}

/// `text` as a cell of a table: after an apostrophe where a spreadsheet would compute it, such as `=a`.
/// Numbers are no texts: -1 stays what it is.
pub(crate) fn spreadsheet_text(text: &str) -> String {
    match text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        true => format!("'{text}"),
        false => text.to_string(),
    }
}

/// Reads the text of `path`, or of standard input for `-`.
///
/// # Errors
/// The file can't be read, is larger than [`LARGEST_INPUT_BYTES`], or isn't UTF-8.
pub fn read_text(path: &Path) -> Result<String> {
    let mend = "keep the poses around the collision, or every n-th of them";
    read_text_up_to(LARGEST_INPUT_BYTES, path, mend)
}

/// Reads the text of `path`, or of standard input for `-`, if it has at most `limit` bytes; else
/// `mend` says what to do.
pub(crate) fn read_text_up_to(limit: u64, path: &Path, mend: &str) -> Result<String> {
    let name = display_name(path, "standard input");
    if path.is_dir() {
        let error = Error::new(ErrorKind::Read, "is a folder").in_file(&name);
        return Err(error.mend("name a file in it"));
    }
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
    source.take(limit + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if bytes.len() as u64 > limit {
        let problem = format!("is larger than {} KiB", limit >> 10);
        return Err(Error::new(ErrorKind::Read, problem).in_file(&name).mend(mend));
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        Error::new(ErrorKind::Parse, format!("byte {at} isn't UTF-8 text"))
            .in_file(&name)
            .mend("save the file as UTF-8")
    })
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
pub(crate) fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let cut = text.find(" (os error").unwrap_or(text.len());
    let mut chars = text[..cut].chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}
