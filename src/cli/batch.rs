//! `smash batch`: many scenes.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use smash::batch::{Batch, CSV_TABLE, JSON_LINES_TABLE, reconstruct_all};
use smash::files::print_bytes;
use smash::{Error, ErrorKind, Result};

use super::method::Method;
use super::progress::ProgressLine;

/// Reconstructs many scenes on all cores, and makes one table of all
///
/// Each scene gets a NAME.result.json in the folder, named after its file, or after its folder and
/// file where two share a name; results.csv and results.jsonl hold one row a scene. Start it again
/// after an interruption, or with more scenes: a result is kept if it was made from the same
/// content, with the same options and versions, and scenes that failed are tried again. Exit code
/// 1 if a scene failed; where an input isn't there, nothing is done. The environment variable RAYON_NUM_THREADS takes fewer cores.
#[derive(Args)]
pub struct Arguments {
    /// Scenes (smash.scene/1), or folders: their *.json that are scenes
    #[arg(required = true)]
    scenes: Vec<PathBuf>,
    /// Where to write the results; made if need be
    #[arg(short, long, value_name = "FOLDER")]
    output: PathBuf,
    #[command(flatten)]
    method: Method,
    /// Print the summary as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Reconstructs all, tells, and fails if a scene did.
pub fn run(arguments: &Arguments) -> Result<()> {
    let (folder, options) = (&arguments.output, arguments.method.options()?);
    let progress = ProgressLine::of_batch();
    let batch =
        reconstruct_all(&arguments.scenes, folder, &options, &|step| progress.show_batch(step))?;
    progress.clear();
    let told = if arguments.json { in_json(&batch, folder) } else { in_words(&batch, folder) };
    print_bytes(told.as_bytes())?;
    check_complete(&batch, folder)
}

/// A table that lacks scenes must not pass for a whole one.
fn check_complete(batch: &Batch, folder: &Path) -> Result<()> {
    let Some(first) = batch.failed().next() else { return Ok(()) };
    let (failed, of) = (batch.failed().count(), batch.rows.len());
    let first = first.error.as_deref().unwrap_or(&first.file);
    let problem = format!("{failed} of {of} scenes failed, first {first}");
    let mend = "mend them, or leave them out, and run it again: the other results are kept";
    Err(Error::new(ErrorKind::Solve, problem)
        .in_file(folder.join(CSV_TABLE).display().to_string())
        .mend(mend))
}

fn in_words(batch: &Batch, folder: &Path) -> String {
    let mut text = String::new();
    // Writing to a string can't fail.
    let _ = write_summary(&mut text, batch, folder);
    text
}

fn write_summary(out: &mut String, batch: &Batch, folder: &Path) -> std::fmt::Result {
    let failed = batch.failed().count();
    let flagged = batch.rows.iter().filter(|row| !row.flags.is_empty()).count();
    writeln!(out, "  scenes          {}", batch.rows.len())?;
    writeln!(out, "  reconstructed   {}", batch.rows.len() - batch.kept - failed)?;
    writeln!(out, "  kept            {}", batch.kept)?;
    writeln!(out, "  failed          {failed}")?;
    writeln!(out, "  flagged         {flagged}")?;
    if let [first, others @ ..] = batch.not_scenes.as_slice() {
        write!(out, "\nNot scenes, left out: {}", first.display())?;
        match others.len() {
            0 => writeln!(out)?,
            more => writeln!(out, " and {more} more")?,
        }
    }
    let result = folder.join("NAME.result.json");
    writeln!(out, "\nWritten")?;
    writeln!(out, "  {}", folder.join(CSV_TABLE).display())?;
    writeln!(out, "  {}", folder.join(JSON_LINES_TABLE).display())?;
    writeln!(out, "  {}    for each scene that didn't fail", result.display())
}

fn in_json(batch: &Batch, folder: &Path) -> String {
    let failed = batch.failed().count();
    let text = |path: &Path| path.display().to_string();
    let not_scenes: Vec<String> = batch.not_scenes.iter().map(|path| text(path)).collect();
    let tables = [CSV_TABLE, JSON_LINES_TABLE].map(|name| text(&folder.join(name)));
    let summary = json!({
        "scenes": batch.rows.len(),
        "reconstructed": batch.rows.len() - batch.kept - failed,
        "kept": batch.kept,
        "failed": failed,
        "not_scenes": not_scenes,
        "tables": tables,
    });
    format!("{summary:#}\n")
}
