//! A table of the sampled motion: a row for each body and frame.

use super::frames::film;
use crate::files::spreadsheet_text;
use crate::motion::Track;
use crate::{Reconstruction, Result};

const HEADER: [&str; 16] = [
    "time_s",
    "body",
    "segment",
    "position_x_m",
    "position_y_m",
    "position_z_m",
    "orientation_w",
    "orientation_x",
    "orientation_y",
    "orientation_z",
    "velocity_x_m_s",
    "velocity_y_m_s",
    "velocity_z_m_s",
    "spin_x_rad_s",
    "spin_y_rad_s",
    "spin_z_rad_s",
];

/// The motion in `result` as a table, `fps` rows a second (at the scene's own rate for `None`, or 60):
/// body after body, each in order of time, from its first pose to its last.
///
/// Times are the scene's. The collision has two rows a body, `before` and `after`: one pose, two
/// velocities. What the result doesn't tell is empty. Positions are those of the annotated point,
/// velocities those of the centre of mass; all in the world. Before a name that a spreadsheet would
/// compute, such as `=a`, stands an apostrophe.
///
/// # Errors
/// The result has no setting or no collision time, the frames are too many, or the motion can't be
/// followed.
///
/// # Example
/// ```no_run
/// let result = smash::Reconstruction::read("result.json")?;
/// print!("{}", smash::export::csv(&result, Some(240.0))?);
/// # Ok::<(), smash::Error>(())
/// ```
pub fn csv(result: &Reconstruction, fps: Option<f64>) -> Result<String> {
    let film = film(result, fps)?;
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let mut write = |cells: Vec<String>| {
        writer.write_record(cells).expect("memory takes every row, and all are of one length");
    };
    write(HEADER.map(String::from).into());
    for body in &film.motion.bodies {
        for (segment, track) in [("before", &body.before), ("after", &body.after)] {
            for frame in 0..track.times.len() {
                let mut cells = vec![
                    track.times[frame].to_string(),
                    spreadsheet_text(&body.name),
                    segment.into(),
                ];
                cells.extend(numbers(track, frame));
                write(cells);
            }
        }
    }
    let bytes = writer.into_inner().expect("memory takes every row");
    Ok(String::from_utf8(bytes).expect("every cell is text"))
}

/// Position, orientation, velocity and spin; empty where they aren't known.
fn numbers(track: &Track, frame: usize) -> impl Iterator<Item = String> {
    fn cells<const N: usize>(values: Option<[f64; N]>) -> impl Iterator<Item = String> {
        let cell = move |index: usize| values.map_or(String::new(), |all| all[index].to_string());
        (0..N).map(cell)
    }
    cells(Some(track.positions[frame]))
        .chain(cells(track.orientations.as_ref().map(|all| all[frame])))
        .chain(cells(Some(track.velocities[frame])))
        .chain(cells(track.spins.as_ref().map(|all| all[frame])))
}
