//! Surfaces in two tones, so that a turn is seen whatever the axis.

use std::f64::consts::{PI, TAU};

use serde_json::{Value, json};

use super::buffer::{Buffer, Use};
use crate::scene::Shape;

/// Of a ball, around its z axis and along it.
const SEGMENTS: usize = 24;
const RINGS: usize = 12;
/// Segments of one tone, side by side: three such pairs around the ball.
const STRIPE: usize = 4;

/// A surface in the body's frame, m.
pub(super) struct Solid {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    /// Corners of triangles, counter-clockwise from outside, by tone.
    tones: [Vec<u16>; 2],
}

impl Solid {
    /// That of `shape`.
    pub(super) fn of(shape: &Shape) -> Solid {
        match *shape {
            Shape::Box { size } => cuboid(size),
            Shape::Sphere { radius } => ball(radius),
        }
    }

    /// A square across y, seen from above; `half_m`: half of its edge.
    pub(super) fn sheet(half_m: f64) -> Solid {
        let half = half_m as f32;
        Solid {
            positions: [[-1, 1], [1, 1], [1, -1], [-1, -1]]
                .map(|[x, z]: [i8; 2]| [f32::from(x) * half, 0.0, f32::from(z) * half])
                .into(),
            normals: vec![[0.0, 1.0, 0.0]; 4],
            tones: [vec![0, 1, 2, 0, 2, 3], Vec::new()],
        }
    }

    /// The mesh, whose tones are the materials from `first_material` on.
    pub(super) fn mesh(&self, name: &str, first_material: usize, buffer: &mut Buffer) -> Value {
        let position = buffer.vectors(&self.positions, Use::Vertices);
        let normal = buffer.vectors(&self.normals, Use::Vertices);
        let tones = self.tones.iter().enumerate().filter(|(_, corners)| !corners.is_empty());
        let primitive = |(tone, corners): (usize, &Vec<u16>)| {
            json!({
                "attributes": {"POSITION": position, "NORMAL": normal},
                "indices": buffer.corners(corners), "material": first_material + tone,
            })
        };
        let primitives: Vec<Value> = tones.map(primitive).collect();
        json!({"name": name, "primitives": primitives})
    }
}

/// Six faces with corners of their own; the three on the axes' positive sides are of the second tone.
fn cuboid(size: [f64; 3]) -> Solid {
    let mut solid = Solid { positions: vec![], normals: vec![], tones: [vec![], vec![]] };
    for (axis, is_positive) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
        let side = if is_positive { 1.0 } else { -1.0 };
        let mut normal = [0.0_f32; 3];
        normal[axis] = side as f32;
        let first = solid.positions.len() as u16;
        // Counter-clockwise from the positive side.
        for [along, across] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            let mut corner = size;
            corner[axis] *= side;
            corner[(axis + 1) % 3] *= along;
            corner[(axis + 2) % 3] *= across;
            solid.positions.push(corner.map(|x| (0.5 * x) as f32));
            solid.normals.push(normal);
        }
        let order = if is_positive { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
        solid.tones[usize::from(is_positive)].extend(order.map(|corner: u16| first + corner));
    }
    solid
}

/// Stripes from pole to pole, that change tone at the equator.
fn ball(radius_m: f64) -> Solid {
    let mut solid = Solid { positions: vec![], normals: vec![], tones: [vec![], vec![]] };
    for (ring, segment) in (0..=RINGS).flat_map(|ring| (0..=SEGMENTS).map(move |s| (ring, s))) {
        let from_pole = PI * ring as f64 / RINGS as f64;
        let around = TAU * segment as f64 / SEGMENTS as f64;
        let out = [from_pole.sin() * around.cos(), from_pole.sin() * around.sin(), from_pole.cos()];
        solid.positions.push(out.map(|x| (radius_m * x) as f32));
        solid.normals.push(out.map(|x| x as f32));
    }
    for (ring, segment) in (0..RINGS).flat_map(|ring| (0..SEGMENTS).map(move |s| (ring, s))) {
        let corner =
            |down: usize, on: usize| ((ring + down) * (SEGMENTS + 1) + segment + on) as u16;
        let tone = &mut solid.tones[(segment / STRIPE + usize::from(2 * ring >= RINGS)) % 2];
        // At a pole one of the two triangles is a line.
        if ring + 1 < RINGS {
            tone.extend([corner(0, 0), corner(1, 0), corner(1, 1)]);
        }
        if ring > 0 {
            tone.extend([corner(0, 0), corner(1, 1), corner(0, 1)]);
        }
    }
    solid
}
