//! The rules of a scene: a [`SceneFile`] that keeps them all becomes a [`Scene`].

use std::ops::RangeInclusive;

use nalgebra::{Quaternion, UnitQuaternion, UnitVector3, Vector3};

use super::bounds::{
    FPS, GRAVITY_M_S2, LONGEST_NAME, MOST_OBSERVATIONS, NOISE, POSITION_M, SIZE_M, TIME_S,
    UNIT_TOLERANCE,
};
use super::{
    BodyFile, DynamicBody, Observation, ObservationFile, SCENE_SCHEMA, Scene, SceneFile, Shape,
    StaticPlane, Warning, gaps, order, warn,
};
use crate::json::check_schema;
use crate::words::{quoted, shortened};
use crate::{Error, Result};

impl Scene {
    /// Checks every rule of `smash.scene/1`, sorts the times and normalises what has unit length.
    ///
    /// # Errors
    /// The first broken rule, with its place, the value found, and a mend.
    pub fn from_file(file: SceneFile) -> Result<Scene> {
        check_schema(&file.schema, SCENE_SCHEMA)?;
        check_name("name", &file.name)?;
        if let Some(fps) = file.fps {
            check_range(
                "fps",
                fps,
                &FPS,
                "give the frames per second of the recording",
            )?;
        }
        check_range(
            "gravity",
            file.gravity,
            &GRAVITY_M_S2,
            "give gravity in m/s², such as 9.81",
        )?;
        let up_in_world = unit_vector("up", file.up)?;
        if let Some(noise) = file.noise {
            check_range(
                "noise.position",
                noise.position,
                &NOISE,
                "give one σ in m, above 0",
            )?;
            let mend = "give one σ in rad, above 0";
            check_range("noise.orientation", noise.orientation, &NOISE, mend)?;
        }
        if let Some(camera) = &file.camera {
            position("camera.position", camera.position)?;
        }
        check_number_of_bodies(&file.bodies)?;

        let mut bodies = Vec::new();
        let mut plane = None;
        let mut warnings = Vec::new();
        for (index, body) in file.bodies.into_iter().enumerate() {
            let place = format!("bodies[{index}]");
            if body.is_static == Some(true) {
                plane = Some(static_plane(&place, body)?);
            } else {
                bodies.push(dynamic_body(&place, body, file.fps, &mut warnings)?);
            }
        }
        gaps::check(&bodies)?;
        let mut scene = Scene {
            name: file.name,
            fps: file.fps,
            up_in_world,
            gravity_m_s2: file.gravity,
            noise: file.noise,
            camera: file.camera,
            source: file.source,
            bodies,
            plane,
            warnings,
        };
        let odd = warn::look(&scene);
        scene.warnings.extend(odd);
        Ok(scene)
    }
}

fn check_number_of_bodies(bodies: &[BodyFile]) -> Result<()> {
    let planes = bodies
        .iter()
        .filter(|body| body.is_static == Some(true))
        .count();
    let wanted = "a scene has 1 or 2 dynamic bodies, or 1 dynamic and 1 static";
    match (bodies.len() - planes, planes) {
        (1 | 2, 0) | (1, 1) => {}
        (0, 0) => return Err(Error::invalid("bodies", "is empty").mend(wanted)),
        (dynamic, planes) => {
            let problem = format!("holds {dynamic} dynamic and {planes} static");
            return Err(Error::invalid("bodies", problem).mend(wanted));
        }
    }
    for (index, body) in bodies.iter().enumerate() {
        let place = format!("bodies[{index}].name");
        check_name(&place, &body.name)?;
        if body.name.is_empty() {
            return Err(Error::invalid(place, "is empty").mend("give the body a name, such as `a`"));
        }
        if bodies[..index].iter().any(|other| other.name == body.name) {
            let problem = format!("{} is the name of two bodies", quoted(&body.name));
            return Err(Error::invalid(place, problem).mend("give each body a name of its own"));
        }
    }
    Ok(())
}

fn check_name(place: &str, name: &str) -> Result<()> {
    let letters = name.chars().count();
    if letters > LONGEST_NAME {
        let problem = format!("{} has {letters} letters", quoted(name));
        return Err(Error::invalid(place, problem)
            .mend(format!("shorten it to {LONGEST_NAME} letters or fewer")));
    }
    if name.chars().any(char::is_control) {
        let problem = format!("{} holds control characters", quoted(name));
        return Err(Error::invalid(place, problem).mend("use letters, digits and spaces"));
    }
    Ok(())
}

fn static_plane(place: &str, body: BodyFile) -> Result<StaticPlane> {
    refuse(
        place,
        "shape",
        body.shape.is_some(),
        "a static body is a plane",
    )?;
    refuse(
        place,
        "observations",
        body.observations.is_some(),
        "a static body doesn't move",
    )?;
    let normal = needed(
        place,
        "normal",
        body.normal,
        "a static body is the plane normal·p = height",
    )?;
    let height = needed(
        place,
        "height",
        body.height,
        "a static body is the plane normal·p = height",
    )?;
    check_range(
        &format!("{place}.height"),
        height,
        &POSITION_M,
        "give the height in m",
    )?;
    Ok(StaticPlane {
        name: body.name,
        normal_in_world: unit_vector(&format!("{place}.normal"), normal)?,
        height_m: height,
    })
}

fn dynamic_body(
    place: &str,
    body: BodyFile,
    fps: Option<f64>,
    warnings: &mut Vec<Warning>,
) -> Result<DynamicBody> {
    let only_static = "only a body with `\"static\": true` has it";
    refuse(place, "normal", body.normal.is_some(), only_static)?;
    refuse(place, "height", body.height.is_some(), only_static)?;
    let shape = needed(place, "shape", body.shape, "a dynamic body has a shape")?;
    check_shape(place, &shape)?;
    let files = needed(
        place,
        "observations",
        body.observations,
        "a dynamic body has poses",
    )?;
    let place = format!("{place}.observations");
    if files.len() > MOST_OBSERVATIONS {
        let problem = format!("holds {} observations", files.len());
        return Err(Error::invalid(place, problem).mend(format!(
            "keep {MOST_OBSERVATIONS} or fewer, around the collision"
        )));
    }
    let mut observations = Vec::with_capacity(files.len());
    for (index, file) in files.iter().enumerate() {
        observations.push(observation(&format!("{place}[{index}]"), file, fps)?);
    }
    let observations = order::sorted(&body.name, &place, observations, warnings)?;
    Ok(DynamicBody {
        name: body.name,
        shape,
        observations,
    })
}

fn check_shape(place: &str, shape: &Shape) -> Result<()> {
    let mend = "give lengths in m, above 0";
    match *shape {
        Shape::Box { size } => size.iter().enumerate().try_for_each(|(axis, &edge)| {
            check_range(&format!("{place}.shape.size[{axis}]"), edge, &SIZE_M, mend)
        }),
        Shape::Sphere { radius } => {
            check_range(&format!("{place}.shape.radius"), radius, &SIZE_M, mend)
        }
    }
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
            return Err(
                Error::invalid(place, "gives a `frame`, but the scene has no `fps`")
                    .mend("add `fps`, the frames per second, at the top of the scene"),
            );
        }
        (None, Some(time), _) => {
            check_range(
                &format!("{place}.time"),
                time,
                &TIME_S,
                "give the time in s",
            )?;
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
    Ok(Observation {
        time_s,
        position_in_world,
        world_from_body,
    })
}

fn position(place: &str, coordinates: [f64; 3]) -> Result<Vector3<f64>> {
    for (axis, &value) in coordinates.iter().enumerate() {
        check_range(
            &format!("{place}[{axis}]"),
            value,
            &POSITION_M,
            "give coordinates in m",
        )?;
    }
    Ok(Vector3::from(coordinates))
}

fn unit_vector(place: &str, coordinates: [f64; 3]) -> Result<UnitVector3<f64>> {
    let length = unit_length(place, &coordinates)?;
    Ok(UnitVector3::new_unchecked(
        Vector3::from(coordinates) / length,
    ))
}

fn unit_quaternion(place: &str, wxyz: [f64; 4]) -> Result<UnitQuaternion<f64>> {
    let length = unit_length(place, &wxyz)?;
    let [w, x, y, z] = wxyz;
    Ok(UnitQuaternion::new_unchecked(
        Quaternion::new(w, x, y, z) / length,
    ))
}

/// The length of what should have length 1; exactly 1 if it is 1 but for rounding, so that what
/// was normalised once stays as it is.
fn unit_length(place: &str, values: &[f64]) -> Result<f64> {
    let length = values.iter().fold(0.0, |sum: f64, value| sum.hypot(*value));
    if (length - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Ok(1.0);
    }
    // Written so that a NaN fails.
    if (length - 1.0).abs() <= UNIT_TOLERANCE {
        return Ok(length);
    }
    let problem = format!("{values:?} has length {length:.6e}, not 1");
    let error = Error::invalid(place, problem);
    Err(if length == 0.0 && values.len() == 4 {
        error.mend("leave `orientation` out if it wasn't measured")
    } else if length.is_normal() && length < 1e100 {
        let unit: Vec<_> = values
            .iter()
            .map(|value| format!("{:.6}", value / length))
            .collect();
        error.mend(format!("divide it by its length: [{}]", unit.join(", ")))
    } else {
        error.mend("give a vector of length 1")
    })
}

fn check_range(place: &str, value: f64, range: &RangeInclusive<f64>, mend: &str) -> Result<()> {
    if range.contains(&value) {
        return Ok(());
    }
    let problem = format!(
        "{value:?} is not within {:e} to {:e}",
        range.start(),
        range.end()
    );
    Err(Error::invalid(place, problem).mend(mend))
}

fn needed<T>(place: &str, field: &str, value: Option<T>, why: &str) -> Result<T> {
    value.ok_or_else(|| {
        Error::invalid(place, format!("the field `{field}` is missing: {why}"))
            .mend(format!("add `{field}`"))
    })
}

fn refuse(place: &str, field: &str, is_there: bool, why: &str) -> Result<()> {
    if is_there {
        return Err(Error::invalid(
            format!("{place}.{field}"),
            format!("is out of place: {why}"),
        )
        .mend(format!("remove `{}`", shortened(field))));
    }
    Ok(())
}
