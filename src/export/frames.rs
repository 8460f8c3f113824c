//! A result's motion at the frames of a film.

use std::ops::RangeInclusive;

use crate::motion::{BodyMotion, Motion, Track, sampled};
use crate::scene::bounds::FPS;
use crate::scene::values::check_range;
use crate::words::rounded;
use crate::{Error, Reconstruction, Result, Scene};

/// The frame rate where neither the caller nor the scene states one.
const USUAL_FPS: f64 = 60.0;
/// A limit of work and of memory: half a minute at 10 000 frames a second.
const MOST_FRAMES: f64 = 3e5;
/// Times nearer than this part of a frame are one frame: the rounding of frame / fps.
const SAME_FRAME: f64 = 1e-6;
/// Coordinates in m: far beyond a scene's own bound, and well within single precision.
const COORDINATES_M: RangeInclusive<f64> = -1e12..=1e12;

/// A result's motion, and the scene that it is in.
pub(super) struct Film {
    /// The result's scene, without poses.
    pub(super) scene: Scene,
    /// Frames a second.
    pub(super) fps: f64,
    /// The time of the first frame, s.
    pub(super) first_s: f64,
    /// Each body at its frames: every 1/fps from the film's first, at its own first and last pose,
    /// and at the collision on both sides.
    pub(super) motion: Motion,
}

/// The motion in `result` at `fps` frames a second; at the scene's own rate for `None`, or 60.
///
/// # Errors
/// The result has no setting or no collision time, the frames are too many, or the motion can't be
/// followed.
pub(super) fn film(result: &Reconstruction, fps: Option<f64>) -> Result<Film> {
    let Some(scene) = result.own_scene()? else {
        return Err(Error::invalid("setting", "is missing: what moved, and when, isn't known")
            .mend("reconstruct the scene again: older versions left it out"));
    };
    let fps = fps.or(scene.fps()).unwrap_or(USUAL_FPS);
    check_range("fps", fps, &FPS, "give the frames a second")?;
    let times = || scene.bodies().iter().flat_map(|body| &body.observations).map(|o| o.time_s);
    let first_s = times().fold(f64::INFINITY, f64::min);
    let last_s = times().fold(f64::NEG_INFINITY, f64::max);
    let frames = (last_s - first_s) * fps;
    if frames > MOST_FRAMES {
        let problem = format!(
            "{fps} a second from {} s to {} s are {frames:.0} frames",
            rounded(first_s),
            rounded(last_s)
        );
        return Err(Error::invalid("fps", problem)
            .mend(format!("ask for fewer frames a second: {MOST_FRAMES} are the most")));
    }
    let grid = |from_s: f64, to_s: f64| frame_times(first_s, fps, from_s, to_s);
    let Some(motion) = sampled(&scene, result, grid)? else {
        let reason = result.collision_time.reason.as_deref().unwrap_or("no reason is given");
        return Err(Error::invalid("collision_time.value", format!("is null: {reason}"))
            .mend("without it there is no motion: annotate more poses, nearer to the collision"));
    };
    for (index, body) in motion.bodies.iter().enumerate() {
        let mut coordinates = tracks(body).flat_map(|track| &track.positions).flatten();
        // A NaN is in no range.
        if let Some(far) = coordinates.find(|x| !COORDINATES_M.contains(*x)) {
            let problem = format!("flies to {far:e} m");
            return Err(Error::invalid(format!("bodies[{index}]"), problem)
                .mend("check its velocities, in m/s, and the result's effects"));
        }
    }
    Ok(Film { scene, fps, first_s, motion })
}

/// Both sides of a body's way, in order of time.
pub(super) fn tracks(body: &BodyMotion) -> impl Iterator<Item = &Track> {
    [&body.before, &body.after].into_iter()
}

/// Both ends, and the frames between them, counted from `origin_s`.
fn frame_times(origin_s: f64, fps: f64, from_s: f64, to_s: f64) -> Vec<f64> {
    let first = ((from_s - origin_s) * fps + SAME_FRAME).floor() as u64 + 1;
    let last = ((to_s - origin_s) * fps - SAME_FRAME).ceil() as u64;
    let frames = (first..last).map(|frame| (origin_s * fps + frame as f64) / fps);
    std::iter::once(from_s).chain(frames).chain((to_s > from_s).then_some(to_s)).collect()
}
