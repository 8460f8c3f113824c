//! The rows of a table to poses.

use super::columns::{Columns, Group};
use super::{ImportOptions, Table};
use crate::scene::ObservationFile;
use crate::words::quoted;
use crate::{Error, ErrorKind, Result};

/// The poses of all bodies of a table, row by row, in the table's unit of length; bodies that
/// neither row nor column names are called `default_name`.
pub(super) fn read(
    table: &Table<'_>,
    default_name: &str,
    options: &ImportOptions,
) -> Result<Vec<(String, ObservationFile)>> {
    poses(table.text, default_name, options).map_err(|error| error.in_file(table.file))
}

fn poses(
    text: &str,
    default_name: &str,
    options: &ImportOptions,
) -> Result<Vec<(String, ObservationFile)>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let header: Vec<String> = reader.headers().map_err(malformed)?.iter().map(lower).collect();
    let columns = Columns::of(&header, options)?;
    let mut poses = Vec::new();
    for record in reader.records() {
        let record = record.map_err(malformed)?;
        let row =
            Row { line: record.position().map_or(0, |at| at.line()), record, header: &header };
        for group in &columns.groups {
            let Some(pose) = row.pose(&columns, group)? else {
                continue;
            };
            let named = columns.body.map(|column| row.record[column].to_owned());
            let name = named.or_else(|| group.body.clone());
            poses.push((name.unwrap_or_else(|| default_name.to_owned()), pose));
        }
    }
    Ok(poses)
}

/// Column names don't depend on case; the body in a prefix does.
fn lower(column: &str) -> String {
    match column.rsplit_once('_') {
        Some((prefix, name)) => format!("{prefix}_{}", name.to_lowercase()),
        None => column.to_lowercase(),
    }
}

struct Row<'a> {
    line: u64,
    record: csv::StringRecord,
    header: &'a [String],
}

impl Row<'_> {
    /// The pose of a body; `None` if the body wasn't measured in this row.
    fn pose(&self, columns: &Columns, group: &Group) -> Result<Option<ObservationFile>> {
        let orientation = match group.quaternion {
            Some(columns) => self.numbers(columns)?,
            None => None,
        };
        let Some(position) = self.numbers(group.position)? else {
            return match orientation {
                None => Ok(None),
                Some(_) => Err(self.wrong(group.position[0], "is empty", "give the position too")),
            };
        };
        let Some([time]) = self.numbers([columns.time])? else {
            return Err(self.wrong(columns.time, "is empty", "each pose needs its time"));
        };
        let (frame, time) = if columns.is_frame { (Some(time), None) } else { (None, Some(time)) };
        Ok(Some(ObservationFile { frame, time, position, orientation }))
    }

    /// The numbers of some cells; `None` if all of them are empty.
    fn numbers<const N: usize>(&self, columns: [usize; N]) -> Result<Option<[f64; N]>> {
        if columns.iter().all(|&column| self.record[column].is_empty()) {
            return Ok(None);
        }
        let mut numbers = [0.0; N];
        for (number, column) in numbers.iter_mut().zip(columns) {
            let cell = &self.record[column];
            *number = match cell.parse::<f64>() {
                Ok(value) if value.is_finite() => value,
                _ if cell.is_empty() => {
                    let mend = "fill it, or empty the whole pose or orientation";
                    return Err(self.wrong(column, "is empty", mend));
                }
                _ => {
                    let problem = format!("{} is no finite number", quoted(cell));
                    let mend = "write a number such as 0.25; leave empty what wasn't measured";
                    return Err(self.wrong(column, problem, mend));
                }
            };
        }
        Ok(Some(numbers))
    }

    fn wrong(&self, column: usize, problem: impl Into<String>, mend: &str) -> Error {
        let place = format!("line {}, column {}", self.line, quoted(&self.header[column]));
        Error::invalid(place, problem).mend(mend)
    }
}

fn malformed(error: csv::Error) -> Error {
    let (place, problem) = match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            (format!("line {line}"), format!("has {len} cells, but the header has {expected_len}"))
        }
        _ => ("table".into(), error.to_string()),
    };
    Error::new(ErrorKind::Parse, problem).at(place).mend("look for missing or additional commas")
}
