//! The meaning of a table's columns, from its header.

use super::{ImportOptions, QuaternionOrder};
use crate::words::{did_you_mean, listed, quoted};
use crate::{Error, Result};

/// Coordinates of a pose, as columns are called.
const POSITION: [&str; 3] = ["x", "y", "z"];
const QUATERNION: [&str; 4] = ["qw", "qx", "qy", "qz"];
const UNNAMED_QUATERNION: [&str; 4] = ["q0", "q1", "q2", "q3"];

/// Far more than two bodies need; the checks compare each column with each.
const MOST_COLUMNS: usize = 1000;

/// Where to find what in a row.
pub(super) struct Columns {
    pub time: usize,
    /// Whether `time` holds frame numbers.
    pub is_frame: bool,
    /// The column that names the body of a row.
    pub body: Option<usize>,
    pub groups: Vec<Group>,
}

/// The columns of one pose.
pub(super) struct Group {
    /// The body, if the columns' prefix names it.
    pub body: Option<String>,
    pub position: [usize; 3],
    /// In the order w, x, y, z.
    pub quaternion: Option<[usize; 4]>,
}

impl Columns {
    /// # Errors
    /// A column that is unknown, missing, double, or whose meaning the options don't settle.
    pub(super) fn of(header: &[String], options: &ImportOptions) -> Result<Columns> {
        check_names(header)?;
        let find = |name: &str| header.iter().position(|column| column == name);
        let (time, is_frame) = match (find("frame"), find("time"), options.fps) {
            (Some(_), Some(_), _) => {
                return Err(wrong("has both `frame` and `time`", "keep one of the two columns"));
            }
            (None, None, _) => {
                return Err(wrong("has neither `frame` nor `time`", "name the column of times"));
            }
            (Some(_), None, None) => {
                return Err(wrong("numbers frames", "state the frames per second: `--fps 60`"));
            }
            (Some(frame), None, Some(_)) => (frame, true),
            (None, Some(time), _) => (time, false),
        };
        let body = find("body");
        let mut prefixes: Vec<Option<&str>> = Vec::new();
        for column in header {
            if let Some((prefix, _)) = coordinate(column)
                && !prefixes.contains(&prefix)
            {
                prefixes.push(prefix);
            }
        }
        if prefixes.is_empty() {
            return Err(wrong("has no positions", "name their columns x, y, z (or a_x, a_y, a_z)"));
        }
        if prefixes.contains(&None) && prefixes.len() > 1 || body.is_some() && prefixes != [None] {
            let mend = "use a column `body`, or a prefix in all columns of poses, such as a_x";
            return Err(wrong("names bodies in two ways", mend));
        }
        let groups = prefixes.into_iter().map(|prefix| Group::of(prefix, header, options));
        Ok(Columns { time, is_frame, body, groups: groups.collect::<Result<_>>()? })
    }
}

impl Group {
    fn of(prefix: Option<&str>, header: &[String], options: &ImportOptions) -> Result<Group> {
        let find = |name: &&str| header.iter().position(|c| coordinate(c) == Some((prefix, name)));
        let position = all(POSITION, find)
            .ok_or_else(|| wrong("lacks coordinates of the position", "name them x, y, z"))?;
        let has_any = |names: [&str; 4]| names.iter().any(|name| find(name).is_some());
        let quaternion = match (has_any(QUATERNION), has_any(UNNAMED_QUATERNION)) {
            (false, false) => None,
            (true, true) => {
                return Err(wrong("has two quaternions", "keep qw, qx, qy, qz"));
            }
            (true, false) => Some(all(QUATERNION, find).ok_or_else(incomplete)?),
            (false, true) => {
                let [first, second, third, fourth] =
                    all(UNNAMED_QUATERNION, find).ok_or_else(incomplete)?;
                Some(match options.quaternion {
                    Some(QuaternionOrder::Wxyz) => [first, second, third, fourth],
                    Some(QuaternionOrder::Xyzw) => [fourth, first, second, third],
                    None => {
                        let mend = "state it: `--quaternion wxyz` or `--quaternion xyzw`";
                        return Err(wrong("doesn't say the order of q0 to q3", mend));
                    }
                })
            }
        };
        Ok(Group { body: prefix.map(str::to_owned), position, quaternion })
    }
}

fn check_names(header: &[String]) -> Result<()> {
    let known = [&["frame", "time", "body"][..], &POSITION, &QUATERNION].concat();
    if let [only] = header
        && only.contains([';', '\t'])
    {
        let mend = "save it with commas between the columns and points in the numbers";
        return Err(wrong("has a single column: it isn't separated by commas", mend));
    }
    if header.len() > MOST_COLUMNS {
        let problem = format!("has {} columns", header.len());
        return Err(wrong(problem, "keep those of frame or time, body, position and quaternion"));
    }
    for (index, column) in header.iter().enumerate() {
        if header[..index].contains(column) {
            let problem = format!("has the column {} twice", quoted(column));
            return Err(wrong(problem, "keep one of the two"));
        }
        if !known.contains(&column.as_str()) && coordinate(column).is_none() {
            let problem = format!("has the unknown column {}", quoted(column));
            let mend = did_you_mean(column, &known);
            return Err(wrong(problem, format!("rename or remove it; {mend}")));
        }
    }
    Ok(())
}

/// The body (if prefixed) and the coordinate that a column holds.
fn coordinate(column: &str) -> Option<(Option<&str>, &str)> {
    let (prefix, name) = match column.rsplit_once('_') {
        Some((prefix, name)) if !prefix.is_empty() => (Some(prefix), name),
        _ => (None, column),
    };
    let names = POSITION.iter().chain(&QUATERNION).chain(&UNNAMED_QUATERNION);
    names.into_iter().any(|one| *one == name).then_some((prefix, name))
}

fn all<const N: usize>(
    names: [&str; N],
    find: impl Fn(&&str) -> Option<usize>,
) -> Option<[usize; N]> {
    let found = names.map(|name| find(&name));
    found.iter().all(Option::is_some).then(|| found.map(Option::unwrap_or_default))
}

fn incomplete() -> Error {
    let names = listed(&QUATERNION);
    wrong("has an incomplete quaternion", format!("give all four, {names}, or none"))
}

fn wrong(problem: impl Into<String>, mend: impl Into<String>) -> Error {
    Error::invalid("header", problem).mend(mend)
}
