//! The instants at which a body is seen, as the specification asks for them.

use super::{Sampling, SimulationSpec};
use crate::scene::bounds::{LEAST_POSES, MOST_OBSERVATIONS};
use crate::words::counted;
use crate::{Error, Result};

/// When a body is seen, and how the scene writes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    pub time_s: f64,
    /// The frame number, where the specification counts in frames.
    pub frame: Option<f64>,
}

/// The instants at which body `index` is seen, in order.
pub(super) fn instants(spec: &SimulationSpec, index: usize) -> Result<Vec<Instant>> {
    let own = spec.bodies[index].observations.as_ref();
    let place =
        if own.is_some() { format!("bodies[{index}].observations") } else { "observations".into() };
    let sampling = own.unwrap_or(&spec.observations);
    let instants = match sampling {
        Sampling::Times(times) => {
            check_order(&format!("{place}.times"), times)?;
            times.iter().map(|&time_s| Instant { time_s, frame: None }).collect()
        }
        Sampling::Frames(frames) => {
            check_order(&format!("{place}.frames"), frames)?;
            at_frames(spec, frames.iter().copied())?
        }
        Sampling::Regular(regular) => {
            let place = format!("{place}.regular");
            check_count(&format!("{place}.frame_count"), regular.frame_count as usize)?;
            for (field, value) in [("interval", Some(regular.interval)), ("gap", regular.gap)] {
                if value == Some(0) {
                    return Err(Error::invalid(format!("{place}.{field}"), "is 0")
                        .mend("give 1 or more frames"));
                }
            }
            let collision_frame = spec.collision.time * fps(spec)?;
            let numbers = regular.frame_numbers(collision_frame);
            at_frames(spec, numbers.into_iter().map(f64::from))?
        }
    };
    check_sides(&place, spec, index, &instants)?;
    Ok(instants)
}

fn fps(spec: &SimulationSpec) -> Result<f64> {
    spec.fps.ok_or_else(|| {
        Error::invalid("fps", "is missing, but observations count in frames")
            .mend("add `fps`, the frames per second, or observe at `times`")
    })
}

fn at_frames(spec: &SimulationSpec, frames: impl Iterator<Item = f64>) -> Result<Vec<Instant>> {
    let fps = fps(spec)?;
    Ok(frames.map(|frame| Instant { time_s: frame / fps, frame: Some(frame) }).collect())
}

fn check_count(place: &str, count: usize) -> Result<()> {
    if count <= MOST_OBSERVATIONS {
        return Ok(());
    }
    Err(Error::invalid(place, format!("asks for {count} frames"))
        .mend(format!("give {MOST_OBSERVATIONS} or fewer")))
}

fn check_order(place: &str, values: &[f64]) -> Result<()> {
    check_count(place, values.len())?;
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(index) => Err(Error::invalid(
            format!("{place}[{}]", index + 1),
            format!("{} doesn't come after {}", values[index + 1], values[index]),
        )
        .mend("list them in order, each once")),
    }
}

fn check_sides(
    place: &str,
    spec: &SimulationSpec,
    index: usize,
    instants: &[Instant],
) -> Result<()> {
    let collision_s = spec.collision.time;
    let before = instants.iter().filter(|instant| instant.time_s < collision_s).count();
    let after = instants.iter().filter(|instant| instant.time_s > collision_s).count();
    if before >= LEAST_POSES && after >= LEAST_POSES {
        return Ok(());
    }
    let name = &spec.bodies[index].name;
    let problem = format!(
        "see `{name}` {} before the collision at {collision_s} s and {} after",
        counted(before, "time"),
        counted(after, "time")
    );
    Err(Error::invalid(place, problem).mend(format!("give {LEAST_POSES} or more on each side")))
}
