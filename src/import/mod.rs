//! Poses from other programs' files to a scene.
//!
//! A table says numbers, not units: whoever imports it states the unit of length, the direction
//! of up, and the shapes. Nothing is guessed.

mod columns;
mod csv;
mod origin;

use std::sync::Arc;

use csv::Pose;
use origin::Origin;

use crate::files::shell_word;
use crate::scene::{BodyFile, SCENE_SCHEMA, SceneFile, Shape};
use crate::words::{did_you_mean, quoted};
use crate::{Error, Result};

/// The name of the static body that [`ImportOptions::plane`] makes.
pub const PLANE_NAME: &str = "floor";

/// The bodies that move in a collision.
const MOST_BODIES: usize = 2;

/// What a table of poses doesn't say.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportOptions {
    /// The scene's name.
    pub name: String,
    /// The unit of all lengths: in the tables, the shapes and the plane.
    pub length_unit: LengthUnit,
    /// The order of the columns `q0` to `q3`, which don't say it themselves.
    pub quaternion: Option<QuaternionOrder>,
    /// Frames per second, for tables with a column `frame`.
    pub fps: Option<f64>,
    /// Unit vector against gravity, in the tables' axes.
    pub up: [f64; 3],
    /// Gravity in m/s².
    pub gravity_m_s2: f64,
    /// The shape of each body by its name, in the unit of length.
    pub shapes: Vec<(String, Shape)>,
    /// The plane normal·p = height that a single body collides with: unit normal, and height in
    /// the unit of length.
    pub plane: Option<([f64; 3], f64)>,
}

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum LengthUnit {
    /// Metre
    #[value(name = "m")]
    Metre,
    /// Centimetre
    #[value(name = "cm")]
    Centimetre,
    /// Millimetre
    #[value(name = "mm")]
    Millimetre,
    /// Inch, 25.4 mm
    #[value(name = "in")]
    Inch,
    /// Foot, 0.3048 m
    #[value(name = "ft")]
    Foot,
}

impl LengthUnit {
    /// The unit in m.
    pub fn in_metres(self) -> f64 {
        match self {
            LengthUnit::Metre => 1.0,
            LengthUnit::Centimetre => 0.01,
            LengthUnit::Millimetre => 0.001,
            LengthUnit::Inch => 0.0254,
            LengthUnit::Foot => 0.3048,
        }
    }
}

/// The order of a quaternion's four numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum QuaternionOrder {
    /// The scalar first
    Wxyz,
    /// The scalar last
    Xyzw,
}

/// A table of poses: the file's name, for messages and for a body without a name, and its text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Table<'a> {
    /// The file's name.
    pub file: &'a str,
    /// The file's text: CSV with a header.
    pub text: &'a str,
}

/// A scene made of tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Import {
    /// The scene, its rules not checked yet.
    pub scene_file: SceneFile,
    /// Where each body's observations stand.
    origins: Vec<Vec<Origin>>,
}

/// Makes a scene of `tables` in CSV with a header; the order of bodies is that of their first
/// appearance. Its rules are checked by [`Import::check`].
///
/// Columns: `frame` or `time` (s); `x`, `y`, `z`; `qw`, `qx`, `qy`, `qz` (or `q0` to `q3`), which
/// map the body to the world. Several bodies share a table by a column `body`, or by columns
/// such as `a_x`; else a table is one body, named after its file. Empty cells weren't measured.
///
/// # Errors
/// A table that can't be understood, with line and column; more bodies than can collide; a body
/// without shape or the reverse.
pub fn import_csv(tables: &[Table<'_>], options: &ImportOptions) -> Result<Import> {
    let mut origins: Vec<Vec<Origin>> = Vec::new();
    let mut bodies: Vec<BodyFile> = Vec::new();
    let unit = options.length_unit.in_metres();
    for table in tables {
        let poses = csv::read(table, default_name(tables, table, options), options)?;
        let file: Arc<str> = table.file.into();
        for Pose { body: name, line, mut observation } in poses {
            observation.position = observation.position.map(|coordinate| coordinate * unit);
            let origin = Origin { file: Arc::clone(&file), line };
            let index = match bodies.iter().position(|body| body.name == name) {
                Some(index) => index,
                None if bodies.len() == MOST_BODIES => return Err(third_body(&name, &origin)),
                None => {
                    bodies.push(BodyFile { name, ..BodyFile::default() });
                    origins.push(Vec::new());
                    bodies.len() - 1
                }
            };
            bodies[index].observations.get_or_insert_default().push(observation);
            origins[index].push(origin);
        }
    }
    give_shapes(&mut bodies, options)?;
    bodies.extend(options.plane.map(|(normal, height)| BodyFile {
        name: PLANE_NAME.into(),
        is_static: Some(true),
        normal: Some(normal),
        height: Some(height * unit),
        ..BodyFile::default()
    }));
    let scene_file = SceneFile {
        schema: SCENE_SCHEMA.into(),
        name: options.name.clone(),
        fps: options.fps,
        up: options.up,
        gravity: options.gravity_m_s2,
        noise: None,
        camera: None,
        source: None,
        bodies,
    };
    Ok(Import { scene_file, origins })
}

fn third_body(name: &str, origin: &Origin) -> Error {
    let problem = format!("{} is one body too many", quoted(name));
    Error::invalid(format!("line {}", origin.line), problem)
        .in_file(&*origin.file)
        .mend(format!("keep the {MOST_BODIES} bodies that collide"))
}

/// The body of a table that names none: the only shape, if there is one; else the file's name.
fn default_name<'a>(
    tables: &[Table<'_>],
    table: &Table<'a>,
    options: &'a ImportOptions,
) -> &'a str {
    if let ([_], [(name, _)]) = (tables, options.shapes.as_slice()) {
        return name;
    }
    let stem = std::path::Path::new(table.file).file_stem();
    stem.and_then(|stem| stem.to_str()).unwrap_or(table.file)
}

fn give_shapes(bodies: &mut [BodyFile], options: &ImportOptions) -> Result<()> {
    let unit = options.length_unit.in_metres();
    for (name, shape) in &options.shapes {
        let Some(body) = bodies.iter_mut().find(|body| body.name == *name) else {
            let known: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
            let problem = format!("no body is called {}", quoted(name));
            return Err(Error::invalid("shapes", problem).mend(did_you_mean(name, &known)));
        };
        let scaled = match *shape {
            Shape::Box { size } => Shape::Box { size: size.map(|edge| edge * unit) },
            Shape::Sphere { radius } => Shape::Sphere { radius: radius * unit },
        };
        if body.shape.replace(scaled).is_some() {
            let problem = format!("the body {} has two shapes", quoted(name));
            return Err(Error::invalid("shapes", problem).mend("keep one of them"));
        }
    }
    match bodies.iter().find(|body| body.shape.is_none()) {
        None => Ok(()),
        Some(BodyFile { name, .. }) => {
            let problem = format!("the body {} has no shape", quoted(name));
            Err(Error::invalid("shapes", problem).mend(format!(
                "add `--box {name}=SX,SY,SZ` or `--sphere {name}=RADIUS`, in the unit of length",
                name = shell_word(name)
            )))
        }
    }
}
