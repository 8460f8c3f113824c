//! `smash import`: tables of poses to a scene.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde_json::json;
use smash::Scene;
use smash::files::{Output, display_name, print_bytes, read_text};
use smash::import::{ImportOptions, LengthUnit, QuaternionOrder, Table, import_csv};
use smash::scene::Shape;

/// Makes a scene of poses in CSV, whose units you state
///
/// Columns by their header: frame or time (in s); x, y, z; qw, qx, qy, qz (body to world) where
/// measured. Several bodies: a column `body`, or columns a_x, a_y, …, or one file for each body.
#[derive(clap::Args)]
pub struct Arguments {
    /// CSV files; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The scene to write; `-` is standard output
    #[arg(short, long, value_name = "SCENE")]
    output: PathBuf,
    /// The unit of all lengths: in the files, the shapes and the plane
    #[arg(long)]
    length_unit: LengthUnit,
    /// The direction against gravity: x, y, z, -x, -y, -z, or three numbers
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, value_parser = parse_up)]
    up: [f64; 3],
    /// Gravity in m/s²
    #[arg(long, default_value_t = 9.81, allow_negative_numbers = true)]
    gravity: f64,
    /// Frames per second, for files with a column `frame`
    #[arg(long, allow_negative_numbers = true)]
    fps: Option<f64>,
    /// The order of columns q0 to q3
    #[arg(long, value_name = "ORDER")]
    quaternion: Option<QuaternionOrder>,
    /// A body that is a box, with its edge lengths
    #[arg(long = "box", value_name = "NAME=SX,SY,SZ", value_parser = parse_box)]
    boxes: Vec<(String, Shape)>,
    /// A body that is a ball, with its radius
    #[arg(long = "sphere", value_name = "NAME=RADIUS", value_parser = parse_sphere)]
    spheres: Vec<(String, Shape)>,
    /// The body collides with a level floor at this height along up
    #[arg(long, value_name = "HEIGHT", allow_hyphen_values = true, conflicts_with = "plane")]
    floor: Option<f64>,
    /// The body collides with the plane normal·p = height
    #[arg(long, value_name = "NX,NY,NZ,H", allow_hyphen_values = true, value_parser = parse_numbers::<4>)]
    plane: Option<[f64; 4]>,
    /// The scene's name; by default that of the first file
    #[arg(long)]
    name: Option<String>,
    /// Print a summary as JSON
    #[arg(long)]
    json: bool,
}

/// Writes the scene, and says what is in it.
pub fn run(arguments: &Arguments) -> smash::Result<()> {
    let inputs: Vec<&Path> = arguments.files.iter().map(PathBuf::as_path).collect();
    let output = Output::check(&arguments.output, &inputs)?;
    super::refuse_json_beside(&output, arguments.json)?;
    let mut texts = Vec::new();
    for path in &arguments.files {
        texts.push((display_name(path, "standard input"), read_text(path)?));
    }
    let tables: Vec<Table> = texts.iter().map(|(file, text)| Table { file, text }).collect();
    let import = import_csv(&tables, &arguments.options())?;
    let scene = import.check()?;
    super::warn(scene.warnings());
    output.write(import.scene_file.to_json().as_bytes())?;
    if output.is_standard_output() {
        return Ok(());
    }
    print_bytes(summary(&scene, output.path(), arguments.json).as_bytes())
}

impl Arguments {
    fn options(&self) -> ImportOptions {
        let plane = self.plane.map(|[x, y, z, height]| ([x, y, z], height));
        let first = self.files.first().filter(|path| *path != Path::new("-"));
        let stem = first.and_then(|path| path.file_stem());
        let stem = stem.map(|stem| stem.to_string_lossy().into_owned());
        ImportOptions {
            name: self.name.clone().or(stem).unwrap_or_default(),
            length_unit: self.length_unit,
            quaternion: self.quaternion,
            fps: self.fps,
            up: self.up,
            gravity_m_s2: self.gravity,
            shapes: [self.boxes.as_slice(), &self.spheres].concat(),
            plane: plane.or(self.floor.map(|height| (self.up, height))),
        }
    }
}

fn summary(scene: &Scene, path: &Path, as_json: bool) -> String {
    let bodies = scene.bodies().iter();
    if as_json {
        let bodies: Vec<_> = bodies
            .map(|body| json!({"name": body.name, "observations": body.observations.len()}))
            .collect();
        let warnings: Vec<_> = scene.warnings().iter().map(|one| &one.text).collect();
        let summary =
            json!({"scene": path.display().to_string(), "bodies": bodies, "warnings": warnings});
        return format!("{summary}\n");
    }
    let bodies = bodies.map(|body| format!("{} ({} poses)", body.name, body.observations.len()));
    format!("{}: {}\n", path.display(), bodies.collect::<Vec<_>>().join(", "))
}

fn parse_up(text: &str) -> Result<[f64; 3], String> {
    let (axis, sign) = text.strip_prefix('-').map_or((text, 1.0), |axis| (axis, -1.0));
    match axis {
        "x" => Ok([sign, 0.0, 0.0]),
        "y" => Ok([0.0, sign, 0.0]),
        "z" => Ok([0.0, 0.0, sign]),
        _ => parse_numbers(text).map_err(|problem| {
            format!("{problem}; write x, y, z, -x, -y, -z, or three numbers such as 0,0,1")
        }),
    }
}

fn parse_box(text: &str) -> Result<(String, Shape), String> {
    let (name, size) = named(text)?;
    Ok((name, Shape::Box { size: parse_numbers(size)? }))
}

fn parse_sphere(text: &str) -> Result<(String, Shape), String> {
    let (name, radius) = named(text)?;
    let [radius] = parse_numbers(radius)?;
    Ok((name, Shape::Sphere { radius }))
}

fn named(text: &str) -> Result<(String, &str), String> {
    let (name, value) = text.split_once('=').ok_or("write NAME=…")?;
    Ok((name.to_owned(), value))
}

fn parse_numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let numbers: Result<Vec<f64>, _> =
        text.split(',').map(|one| f64::from_str(one.trim())).collect();
    let numbers = numbers.map_err(|_| match N {
        1 => "not a number".to_owned(),
        _ => format!("not {N} numbers with commas between them"),
    })?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| format!("{N} needed, but {count} given"))
}
