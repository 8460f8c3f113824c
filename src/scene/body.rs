//! The rules of bodies, their shapes and poses.

use super::bounds::{MOST_OBSERVATIONS, POSITION_M, SIZE_M, TIME_S};
use super::values::{
    check_noise_scale, check_range, needed, position, refuse, unit_quaternion, unit_vector,
};
use super::{
    BodyFile, DynamicBody, Observation, ObservationFile, Shape, StaticPlane, Warning, order,
};
use crate::{Error, Result};

/// The static body at `place`.
pub(super) fn static_plane(place: &str, body: BodyFile) -> Result<StaticPlane> {
    refuse(place, "shape", body.shape.is_some(), "a static body is a plane")?;
    refuse(place, "observations", body.observations.is_some(), "a static body doesn't move")?;
    plane(place, body.name, body.normal, body.height)
}

/// The plane of the static body at `place`, in a scene or a specification.
pub(crate) fn plane(
    place: &str,
    name: String,
    normal: Option<[f64; 3]>,
    height: Option<f64>,
) -> Result<StaticPlane> {
    let why = "a static body is the plane normal·p = height";
    let normal = needed(place, "normal", normal, why)?;
    let height_m = needed(place, "height", height, why)?;
    check_range(&format!("{place}.height"), height_m, &POSITION_M, "give the height in m")?;
    let normal_in_world = unit_vector(&format!("{place}.normal"), normal)?;
    Ok(StaticPlane { name, normal_in_world, height_m })
}

/// The dynamic body at `place`, its poses in order of time.
pub(super) fn dynamic_body(
    place: &str,
    body: BodyFile,
    fps: Option<f64>,
    warnings: &mut Vec<Warning>,
) -> Result<DynamicBody> {
    let shape = solid(place, body.shape, body.normal, body.height)?;
    let files = needed(place, "observations", body.observations, "a dynamic body has poses")?;
    let place = format!("{place}.observations");
    if files.len() > MOST_OBSERVATIONS {
        let problem = format!("holds {} observations", files.len());
        return Err(Error::invalid(place, problem)
            .mend(format!("keep {MOST_OBSERVATIONS} or fewer, around the collision")));
    }
    let mut observations = Vec::with_capacity(files.len());
    for (index, file) in files.iter().enumerate() {
        observations.push(observation(&format!("{place}[{index}]"), file, fps)?);
    }
    let observations = order::sorted(&body.name, &place, observations, warnings)?;
    Ok(DynamicBody { name: body.name, shape, observations })
}

/// The shape of the dynamic body at `place`, in a scene or a specification, which has nothing of
/// a plane.
pub(crate) fn solid(
    place: &str,
    shape: Option<Shape>,
    normal: Option<[f64; 3]>,
    height: Option<f64>,
) -> Result<Shape> {
    let only_static = "only a body with `\"static\": true` has it";
    refuse(place, "normal", normal.is_some(), only_static)?;
    refuse(place, "height", height.is_some(), only_static)?;
    let shape = needed(place, "shape", shape, "a dynamic body has a shape")?;
    let mend = "give lengths in m, above 0";
    match shape {
        Shape::Box { size } => {
            for (axis, &edge) in size.iter().enumerate() {
                check_range(&format!("{place}.shape.size[{axis}]"), edge, &SIZE_M, mend)?;
            }
        }
        Shape::Sphere { radius } => {
            check_range(&format!("{place}.shape.radius"), radius, &SIZE_M, mend)?;
        }
    }
    Ok(shape)
}

fn observation(place: &str, file: &ObservationFile, fps: Option<f64>) -> Result<Observation> {
    let time_s = match (file.frame, file.time, fps) {
        (Some(_), Some(_), _) => {
            return Err(
                Error::invalid(place, "has both `frame` and `time`").mend("keep one of them")
            );
        }
        (None, None, _) => {
            return Err(Error::invalid(place, "has neither `frame` nor `time`")
                .mend("add the frame number, or the time in s"));
        }
        (Some(_), None, None) => {
            return Err(Error::invalid(place, "gives a `frame`, but the scene has no `fps`")
                .mend("add `fps`, the frames per second, at the top of the scene"));
        }
        (None, Some(time), _) => {
            check_range(&format!("{place}.time"), time, &TIME_S, "give the time in s")?;
            time
        }
        (Some(frame), None, Some(fps)) => {
            let frames = TIME_S.start() * fps..=TIME_S.end() * fps;
            let mend = "number the frames from the start of the recording";
            check_range(&format!("{place}.frame"), frame, &frames, mend)?;
            frame / fps
        }
    };
    let world_from_body = match file.orientation {
        Some(wxyz) => Some(unit_quaternion(&format!("{place}.orientation"), wxyz)?),
        None => None,
    };
    let position_in_world = position(&format!("{place}.position"), file.position)?;
    let noise_scale = file.noise_scale.unwrap_or(1.0);
    check_noise_scale(&format!("{place}.noise_scale"), noise_scale)?;
    Ok(Observation { time_s, position_in_world, world_from_body, noise_scale })
}
