//! Many scenes, one after another on each core.
//!
//! ```text
//! files, folders ──► inputs ──► each scene on its own ──► NAME.result.json
//!                    (names)     └ kept, if its result stands     │
//!                                                                 ▼
//!                                    all rows, in order ──► results.csv, results.jsonl
//! ```
//!
//! The files in the folder depend on the scenes, the options and the versions of smash and Ceres
//! alone: not on the number of threads, nor on how often the batch was killed and started again.

mod inputs;
mod record;
mod table;

pub use record::Provenance;
pub use table::{Row, Status};

use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::files::{OutputFolder, display_name, read_text, write_together};
use crate::reconstruct::{Options, reconstruct};
use crate::{Result, Scene};
use inputs::Input;
use record::Record;

/// The table of all scenes, for a spreadsheet.
pub const CSV_TABLE: &str = "results.csv";
/// The same table, one JSON object a line.
pub const JSON_LINES_TABLE: &str = "results.jsonl";

/// What came of a batch.
#[derive(Debug, Clone, PartialEq)]
pub struct Batch {
    /// One row a scene, in the order of the inputs.
    pub rows: Vec<Row>,
    /// How many of the results stood already, from an earlier run.
    pub kept: usize,
    /// JSON files in the folders that are no scenes.
    pub not_scenes: Vec<PathBuf>,
}

impl Batch {
    /// The scenes that failed.
    pub fn failed(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.status == Status::Failed)
    }
}

/// How far a batch is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BatchProgress {
    /// So many scenes were found; each is told of when it is done with, in any order.
    Found(usize),
    /// One of them is done with.
    Done(Outcome),
}

/// What came of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Its result stood already.
    Kept,
    /// It was reconstructed.
    Reconstructed,
    /// It is no scene, or has no usable solution.
    Failed,
}

/// Reconstructs the scenes in `inputs`, on all threads of the current rayon pool, and writes one
/// result a scene and a table of all to `folder`. Tells `progress` of each scene, from any thread.
///
/// An input is a scene file, or a folder, which stands for the `*.json` in it that are scenes, by
/// name. A result `NAME.result.json` is named after its scene's file; if two share that name, all
/// are named by folder and file (`FOLDER_NAME`), and so on. Other files in `folder` are left alone,
/// also results of scenes that aren't among the inputs any more.
///
/// A result is kept if it says ([`Provenance`]) that it was made from the same content, with the
/// same options and versions. A scene that fails has a row with the message and no result, doesn't
/// stop the rest, and is tried again by the next run. Only one batch at a time may write to a folder.
///
/// # Errors
/// An input isn't there, a folder can't be read or holds no scene, two inputs can't be told apart by
/// name, an input would be overwritten, or `folder` can't be written to.
///
/// # Example
/// ```no_run
/// use std::path::Path;
/// let options = smash::Options::default();
/// let batch = smash::batch::reconstruct_all(&["scenes"], Path::new("results"), &options, &|_| {})?;
/// for row in &batch.rows {
///     println!("{}: m_b/m_a = {:?}", row.name, row.mass_ratio);
/// }
/// # Ok::<(), smash::Error>(())
/// ```
pub fn reconstruct_all(
    inputs: &[impl AsRef<Path>],
    folder: &Path,
    options: &Options,
    progress: &(dyn Fn(BatchProgress) + Sync),
) -> Result<Batch> {
    let found = inputs::find(inputs)?;
    let folder = OutputFolder::open(folder)?;
    inputs::refuse_to_overwrite(&found.scenes, &folder)?;
    let (csv_table, json_lines_table) =
        (folder.output(CSV_TABLE)?, folder.output(JSON_LINES_TABLE)?);
    progress(BatchProgress::Found(found.scenes.len()));
    let done: Vec<(Row, Outcome)> = found
        .scenes
        .par_iter()
        .map(|input| {
            let (row, outcome) = finish(input, &folder, options)?;
            progress(BatchProgress::Done(outcome));
            Ok((row, outcome))
        })
        .collect::<Result<_>>()?;
    let kept = done.iter().filter(|(_, outcome)| *outcome == Outcome::Kept).count();
    let rows: Vec<Row> = done.into_iter().map(|(row, _)| row).collect();
    let (csv, json_lines) = (table::csv(&rows), table::json_lines(&rows));
    write_together(&[(&csv_table, csv.as_bytes()), (&json_lines_table, json_lines.as_bytes())])?;
    Ok(Batch { rows, kept, not_scenes: found.not_scenes })
}

/// The row of a scene whose result is in the folder when this returns, or that failed.
///
/// # Errors
/// The folder can't be written to.
fn finish(input: &Input, folder: &OutputFolder, options: &Options) -> Result<(Row, Outcome)> {
    let file = display_name(&input.path, "standard input");
    let text = match read_text(&input.path) {
        Ok(text) => text,
        // Its content isn't known to be another: a result from an earlier run stays.
        Err(error) => return Ok((Row::failed(input, &error), Outcome::Failed)),
    };
    let provenance = Provenance::of(&text, options);
    let name = input.result_name();
    let earlier = Record::read(&folder.path_of(&name));
    if let Some(record) = earlier.as_ref().filter(|record| record.provenance == provenance) {
        return Ok((Row::done(input, &record.result), Outcome::Kept));
    }
    match Scene::parse(&text, &file).and_then(|scene| reconstruct(&scene, options)) {
        Ok(result) => {
            let record = Record::new(result, provenance);
            folder.output(&name)?.write(record.to_json().as_bytes())?;
            Ok((Row::done(input, &record.result), Outcome::Reconstructed))
        }
        Err(error) => {
            if earlier.is_some() {
                // It stands for another content, or for other options.
                folder.remove(&name)?;
            }
            Ok((Row::failed(input, &error.in_file(file)), Outcome::Failed))
        }
    }
}
