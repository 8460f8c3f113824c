//! Results that stand alone, and what is made of their motion for other programs.

mod command;
mod csv;
mod gltf;
mod setting;

use std::collections::HashMap;

use smash::{Options, Reconstruction, Scene, reconstruct};

const SCENES: [&str; 5] =
    ["boxes", "uneven_times", "ball_on_floor", "box_on_floor", "thrown_ball_drag"];

fn scene(name: &str) -> Scene {
    Scene::read(format!("{}/scenes/{name}.json", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn result(name: &str) -> Reconstruction {
    reconstruct(&scene(name), &Options::default()).unwrap()
}

/// A row of the table.
#[derive(Debug, Clone)]
struct Row {
    time_s: f64,
    body: String,
    segment: String,
    position: [f64; 3],
    orientation: Option<[f64; 4]>,
    velocity: [f64; 3],
    spin: Option<[f64; 3]>,
}

/// The table, found by the names of its columns.
fn rows(table: &str) -> Vec<Row> {
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    lines
        .map(|cells| {
            let cell: HashMap<&str, &str> = header.iter().copied().zip(cells).collect();
            let numbers = |names: &[String]| -> Option<Vec<f64>> {
                names.iter().map(|name| cell[name.as_str()].parse().ok()).collect()
            };
            let vector = |quantity: &str, unit: &str| {
                numbers(&["x", "y", "z"].map(|axis| format!("{quantity}_{axis}_{unit}")))
                    .map(|values| <[f64; 3]>::try_from(values).unwrap())
            };
            let orientation = numbers(&["w", "x", "y", "z"].map(|c| format!("orientation_{c}")));
            Row {
                time_s: cell["time_s"].parse().unwrap(),
                body: cell["body"].to_string(),
                segment: cell["segment"].to_string(),
                position: vector("position", "m").unwrap(),
                orientation: orientation.map(|wxyz| wxyz.try_into().unwrap()),
                velocity: vector("velocity", "m_s").unwrap(),
                spin: vector("spin", "rad_s"),
            }
        })
        .collect()
}

/// The rows of one body on one side of the collision.
fn track(rows: &[Row], body: &str, segment: &str) -> Vec<Row> {
    rows.iter().filter(|row| row.body == body && row.segment == segment).cloned().collect()
}
