//! The demo's files, which are never put over another's.

use std::fs;
use std::path::Path;

use smash::files::{Output, OutputFolder, shell_word};
use smash::{Error, ErrorKind, Result};

const SPEC: &str = "spec.json";
const SCENE: &str = "scene.json";
const BASE: &str = "base.json";
const BETTER: &str = "better.json";
const REPORT: &str = "report.html";

/// Where the demo's files go.
pub struct DemoFolder {
    /// What was simulated.
    pub spec: Output,
    /// What was seen.
    pub scene: Output,
    /// The base model's result.
    pub base: Output,
    /// The result with what was found.
    pub better: Output,
    /// The page.
    pub report: Output,
}

impl DemoFolder {
    /// The folder `path`, made if need be. `scene`: the demo's scene, by which the demo knows a folder
    /// of its own.
    ///
    /// # Errors
    /// There are files of these names that aren't the demo's, or the folder can't be written to.
    pub fn open(path: &Path, scene: &str) -> Result<DemoFolder> {
        let is_own = fs::read_to_string(path.join(SCENE)).is_ok_and(|text| text == scene);
        let names = [SPEC, SCENE, BASE, BETTER, REPORT];
        if let Some(taken) = names.iter().find(|name| !is_own && path.join(name).exists()) {
            return Err(Error::new(ErrorKind::Write, "isn't the demo's, and would be lost")
                .in_file(path.join(taken).display().to_string())
                .mend("name another folder: `smash demo -o FOLDER`"));
        }
        let folder = OutputFolder::open(path)?;
        Ok(DemoFolder {
            spec: folder.output(SPEC)?,
            scene: folder.output(SCENE)?,
            base: folder.output(BASE)?,
            better: folder.output(BETTER)?,
            report: folder.output(REPORT)?,
        })
    }
}

/// A file as a word of a command.
pub fn word(output: &Output) -> String {
    shell_word(&output.path().to_string_lossy())
}
