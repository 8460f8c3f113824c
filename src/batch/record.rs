//! A result that knows what it was made from. Being one file, written whole, it can't be at odds
//! with itself, whenever the program is killed.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::files::{read_text, sha256};
use crate::reconstruct::{Options, Reconstruction};

/// All that a batch's result depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// SHA-256 of the scene file, as `sha256sum` prints it.
    pub scene_sha256: String,
    /// How it was solved: the [`Options`], effects with their laws.
    pub options: serde_json::Value,
    /// The version of this program.
    pub smash: String,
    /// The version of Ceres Solver.
    pub ceres: String,
}

impl Provenance {
    /// That of a result made from the scene file's `text` with `options`, here and now.
    pub(super) fn of(text: &str, options: &Options) -> Provenance {
        Provenance {
            scene_sha256: sha256(text),
            options: serde_json::to_value(options)
                .expect("plain numbers, strings and lists always have a JSON form"),
            smash: env!("CARGO_PKG_VERSION").to_string(),
            ceres: crate::ceres_version(),
        }
    }
}

/// A result's file in a batch: `smash.result/1` with the field `provenance`.
#[derive(Serialize, Deserialize)]
pub(super) struct Record {
    #[serde(flatten)]
    pub(super) result: Reconstruction,
    pub(super) provenance: Provenance,
}

impl Record {
    /// Scenes share the cores: the wall time of a phase says nothing, and would be the only number
    /// to differ from run to run.
    pub(super) fn new(mut result: Reconstruction, provenance: Provenance) -> Record {
        for phase in &mut result.phases {
            phase.seconds = None;
        }
        Record { result, provenance }
    }

    /// The record in the file `path`, if it is one.
    pub(super) fn read(path: &Path) -> Option<Record> {
        serde_json::from_str(&read_text(path).ok()?).ok()
    }

    /// The file's text, with a final newline.
    pub(super) fn to_json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self)
            .expect("plain numbers and strings always have a JSON form");
        text.push('\n');
        text
    }
}
