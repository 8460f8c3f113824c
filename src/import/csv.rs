//! The rows of a table to poses.

use super::columns::{Columns, Group};
use super::{ImportOptions, Table};
use crate::scene::ObservationFile;
use crate::words::{counted, quoted};
use crate::{Error, ErrorKind, Result};

/// A body's pose in a table.
pub(super) struct Pose {
    pub body: String,
    pub line: usize,
    pub observation: ObservationFile,
}

/// The poses of all bodies of a table, row by row, in the table's unit of length; bodies that
/// neither row nor column names are called `default_name`.
pub(super) fn read(
    table: &Table<'_>,
    default_name: &str,
    options: &ImportOptions,
) -> Result<Vec<Pose>> {
    poses(table.text, default_name, options).map_err(|error| error.in_file(table.file))
}

fn poses(text: &str, default_name: &str, options: &ImportOptions) -> Result<Vec<Pose>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(no_rows());
    }
    let mut lines = Lines { text, byte: 0, line: 1 };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let header: Vec<String> = reader
        .headers()
        .map_err(|error| malformed(&error, &mut lines))?
        .iter()
        .map(lower)
        .collect();
    let columns = Columns::of(&header, options)?;
    let mut poses = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| malformed(&error, &mut lines))?;
        let row = Row { line: lines.of(record.position()), record, header: &header };
        for group in &columns.groups {
            let Some(observation) = row.pose(&columns, group)? else {
                continue;
            };
            let named = columns.body.map(|column| row.record[column].to_owned());
            let name = named.or_else(|| group.body.clone());
            let body = name.unwrap_or_else(|| default_name.to_owned());
            poses.push(Pose { body, line: row.line, observation });
        }
    }
    if poses.is_empty() {
        return Err(no_rows());
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
    line: usize,
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
        Ok(Some(ObservationFile { frame, time, position, orientation, noise_scale: None }))
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

/// Counts lines. The reader's own count stops short of line breaks that it skips later: the `\n`
/// of `\r\n`, and empty lines.
struct Lines<'a> {
    text: &'a str,
    /// Up to here lines are counted.
    byte: usize,
    line: usize,
}

impl Lines<'_> {
    /// The line, from 1, of a row that starts at or behind `position`; rows only go forwards.
    fn of(&mut self, position: Option<&csv::Position>) -> usize {
        let bytes = self.text.as_bytes();
        let is_break = |byte: &u8| matches!(byte, b'\r' | b'\n');
        let at = position.map_or(0, |at| at.byte() as usize).clamp(self.byte, bytes.len());
        let start = at + bytes[at..].iter().take_while(|byte| is_break(byte)).count();
        for index in self.byte..start {
            let is_end = match bytes[index] {
                b'\n' => true,
                b'\r' => bytes.get(index + 1) != Some(&b'\n'),
                _ => false,
            };
            self.line += usize::from(is_end);
        }
        self.byte = start;
        self.line
    }
}

fn no_rows() -> Error {
    Error::new(ErrorKind::Parse, "has no rows with poses")
        .mend("save the table with a header and a row for each pose")
}

fn malformed(error: &csv::Error, lines: &mut Lines<'_>) -> Error {
    let (place, problem) = match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let cells = counted(*len as usize, "cell");
            let line = lines.of(pos.as_ref());
            (format!("line {line}"), format!("has {cells}, but the header has {expected_len}"))
        }
        _ => ("table".into(), error.to_string()),
    };
    Error::new(ErrorKind::Parse, problem).at(place).mend("look for missing or additional commas")
}
