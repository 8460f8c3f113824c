//! Where a path leads to, whatever it is called.

use std::fs::{self, File, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// The folder that `path` stands in.
pub(crate) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Where a write to `path` ends: links are followed, also to a file that isn't there yet.
pub(super) fn resolved(path: &Path) -> io::Result<PathBuf> {
    match (fs::canonicalize(path), fs::read_link(path)) {
        (Err(error), Ok(link)) if error.kind() == io::ErrorKind::NotFound => {
            resolved(&folder_of(path).join(link))
        }
        (Err(error), Err(_)) if error.kind() == io::ErrorKind::NotFound => {
            let name = path.file_name().ok_or(error)?;
            Ok(fs::canonicalize(folder_of(path))?.join(name))
        }
        (found, _) => found,
    }
}

/// Whether two paths lead to one file: by links of either kind, or by another spelling.
pub(super) fn is_same_file(one: &Path, other: &Path) -> bool {
    match (fs::metadata(one), fs::metadata(other)) {
        (Ok(of_one), Ok(of_other)) if cfg!(unix) => identity(&of_one) == identity(&of_other),
        _ => matches!((resolved(one), resolved(other)), (Ok(one), Ok(other)) if one == other),
    }
}

/// What tells a file from all others: its device and its number there.
#[cfg(unix)]
fn identity(meta: &Metadata) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((meta.dev(), meta.ino()))
}

/// Whether `path` still leads to the open file.
pub(crate) fn is_same_file_as(file: &File, path: &Path) -> bool {
    match (file.metadata(), fs::metadata(path)) {
        (Ok(of_file), Ok(of_path)) => identity(&of_file) == identity(&of_path),
        _ => false,
    }
}

#[cfg(not(unix))]
fn identity(_: &Metadata) -> Option<(u64, u64)> {
    None
}
