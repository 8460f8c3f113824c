//! From files and folders to scenes with a name each.

use std::collections::HashSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

use rayon::prelude::*;

use super::{CSV_TABLE, JSON_LINES_TABLE};
use crate::files::{OutputFolder, folder_of, plain, read_text};
use crate::json::is_of_another_kind;
use crate::scene::SCENE_SCHEMA;
use crate::{Error, ErrorKind, Result};

/// A scene's file, and what its result is called.
pub(super) struct Input {
    pub(super) name: String,
    /// As the user named it, or the folder that it is in.
    pub(super) path: PathBuf,
    /// In a folder without links: the same file has the same one.
    place: PathBuf,
}

/// What the user's inputs hold.
pub(super) struct Found {
    pub(super) scenes: Vec<Input>,
    pub(super) not_scenes: Vec<PathBuf>,
}

impl Input {
    pub(super) fn result_name(&self) -> String {
        format!("{}.result.json", self.name)
    }
}

/// The scenes in `inputs`, in their order, each once.
///
/// # Errors
/// An input isn't there, a folder can't be read or holds no scene, or two inputs can't be told apart by
/// name.
pub(super) fn find(inputs: &[impl AsRef<Path>]) -> Result<Found> {
    refuse_missing(inputs)?;
    let mut found = Found { scenes: Vec::new(), not_scenes: Vec::new() };
    let mut places = HashSet::new();
    for input in inputs.iter().map(AsRef::as_ref) {
        let paths = if input.is_dir() {
            let (not_scenes, scenes) = scenes_in(input)?;
            found.not_scenes.extend(not_scenes);
            scenes
        } else {
            vec![input.to_path_buf()]
        };
        for path in paths {
            let place = place(&path);
            if places.insert(place.clone()) {
                found.scenes.push(Input { name: String::new(), path, place });
            }
        }
    }
    name(&mut found.scenes)?;
    Ok(found)
}

/// A name that leads nowhere is a slip of the finger, or a disk that isn't mounted: better told before
/// an hour of work than after it.
fn refuse_missing(inputs: &[impl AsRef<Path>]) -> Result<()> {
    let is_missing =
        |path: &&Path| *path != Path::new("-") && matches!(path.try_exists(), Ok(false));
    let missing: Vec<&Path> = inputs.iter().map(AsRef::as_ref).filter(is_missing).collect();
    let (first, others) = match missing.as_slice() {
        [] => return Ok(()),
        [first] => (first, String::new()),
        [first, second] => (first, format!(", nor is {}", second.display())),
        [first, rest @ ..] => (first, format!(", nor are {} others", rest.len())),
    };
    Err(Error::new(ErrorKind::Read, format!("isn't there{others}"))
        .in_file(first.display().to_string())
        .mend("check the path: nothing was done"))
}

/// The folder's JSON files by name: those that are no scenes, and the others. One that can't be
/// read, or isn't JSON in good order, may have been meant as a scene.
fn scenes_in(folder: &Path) -> Result<(Vec<PathBuf>, Vec<PathBuf>)> {
    let refuse = |problem: String| {
        Error::new(ErrorKind::Read, problem).in_file(folder.display().to_string())
    };
    let entries = fs::read_dir(folder).and_then(Iterator::collect::<std::io::Result<Vec<_>>>);
    let entries = entries.map_err(|error| refuse(format!("can't be read: {}", plain(&error))))?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "json") && path.is_file());
    paths.sort();
    let (not_scenes, scenes): (Vec<_>, Vec<_>) = paths.into_par_iter().partition(|path| {
        read_text(path).is_ok_and(|text| is_of_another_kind(&text, SCENE_SCHEMA))
    });
    if scenes.is_empty() {
        let mend = format!(
            "name a folder with *.json files whose `schema` is `{SCENE_SCHEMA}`, not one above it"
        );
        return Err(refuse("holds no scene".into()).mend(mend));
    }
    Ok((not_scenes, scenes))
}

/// The file's own name in its folder, whatever way leads to that.
fn place(path: &Path) -> PathBuf {
    let folder = folder_of(path);
    // A folder that isn't there has no other name; reading the file will say so.
    let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.into());
    folder.join(path.file_name().unwrap_or_default())
}

/// Names all scenes by their file; if two share a name, all by folder and file; and so on.
fn name(scenes: &mut [Input]) -> Result<()> {
    let deepest = scenes.iter().map(|input| input.place.components().count()).max().unwrap_or(0);
    for depth in 1.. {
        for input in scenes.iter_mut() {
            input.name = name_of(&input.place, depth);
        }
        match clash(scenes) {
            None => break,
            Some(_) if depth < deepest => {}
            Some(input) => {
                let problem = "the name of its result would be that of another scene's";
                return Err(Error::new(ErrorKind::Read, problem)
                    .in_file(input.path.display().to_string())
                    .mend("rename one of the two"));
            }
        }
    }
    Ok(())
}

/// The last `depth` parts of the path, without `.json`.
fn name_of(place: &Path, depth: usize) -> String {
    let parts = place.components().rev().filter_map(|part| match part {
        Component::Normal(part) => Some(part.to_string_lossy()),
        _ => None,
    });
    let mut parts: Vec<_> = parts.take(depth).collect();
    parts.reverse();
    let name = parts.join("_");
    name.strip_suffix(".json").unwrap_or(&name).to_string()
}

/// A scene whose name an earlier one has.
fn clash(scenes: &[Input]) -> Option<&Input> {
    let mut names = HashSet::new();
    // Some file systems take capital and small letters for the same.
    scenes.iter().find(|input| !names.insert(input.name.to_lowercase()))
}

/// Checks that no file of the batch would take the place of a scene.
pub(super) fn refuse_to_overwrite(scenes: &[Input], folder: &OutputFolder) -> Result<()> {
    let tables = [CSV_TABLE, JSON_LINES_TABLE].map(String::from);
    let names = scenes.iter().map(Input::result_name).chain(tables);
    let outputs: HashSet<PathBuf> = names.map(|name| place(&folder.path_of(&name))).collect();
    match scenes.iter().find(|input| outputs.contains(&input.place)) {
        None => Ok(()),
        Some(input) => Err(Error::new(ErrorKind::Write, "is an input: a result would replace it")
            .in_file(input.path.display().to_string())
            .mend("choose another folder for the results")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neither the root nor a slash may get into the name of a file.
    #[test]
    fn a_name_ends_at_the_root() {
        let names = [1, 2, 3, 9].map(|depth| name_of(Path::new("/day/1/scene.json"), depth));
        assert_eq!(names, ["scene", "1_scene", "day_1_scene", "day_1_scene"]);
    }
}
