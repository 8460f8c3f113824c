//! The numbers of a film: bytes, and what says how to read them.

use serde_json::{Map, Value, json};

/// Component types (glTF 2.0, 3.6.2.2).
const UNSIGNED_SHORT: u32 = 5123;
const FLOAT: u32 = 5126;

/// What numbers are for, as a buffer view says it (glTF 2.0, 3.6.2.4).
#[derive(Clone, Copy)]
pub(super) enum Use {
    Vertices = 34962,
    Triangles = 34963,
    /// Keys of an animation, which have no target.
    Keys = 0,
}

/// Numbers, each list with a view and an accessor of its own.
#[derive(Default)]
pub(super) struct Buffer {
    pub(super) bytes: Vec<u8>,
    pub(super) views: Vec<Value>,
    pub(super) accessors: Vec<Value>,
}

impl Buffer {
    /// Adds vectors of `N` components; the answer is their accessor.
    pub(super) fn vectors<const N: usize>(&mut self, values: &[[f32; N]], purpose: Use) -> usize {
        let kind = match N {
            1 => "SCALAR",
            3 => "VEC3",
            _ => "VEC4",
        };
        let limit = |choose: fn(f32, f32) -> f32, start: f32| {
            let of_axis = |axis| values.iter().fold(start, |so_far, v| choose(so_far, v[axis]));
            (0..N).map(of_axis).collect::<Vec<f32>>()
        };
        let (least, most) = (limit(f32::min, f32::INFINITY), limit(f32::max, f32::NEG_INFINITY));
        let view = self.view(values.as_flattened().iter().flat_map(|x| x.to_le_bytes()), purpose);
        self.accessor(json!({
            "bufferView": view, "componentType": FLOAT, "count": values.len(), "type": kind,
            "min": least, "max": most,
        }))
    }

    /// Adds corners of triangles; the answer is their accessor.
    pub(super) fn corners(&mut self, corners: &[u16]) -> usize {
        let view = self.view(corners.iter().flat_map(|x| x.to_le_bytes()), Use::Triangles);
        self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_SHORT, "count": corners.len(),
            "type": "SCALAR",
        }))
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, purpose: Use) -> usize {
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = Map::new();
        view.insert("buffer".into(), json!(0));
        view.insert("byteOffset".into(), json!(start));
        view.insert("byteLength".into(), json!(self.bytes.len() - start));
        if !matches!(purpose, Use::Keys) {
            view.insert("target".into(), json!(purpose as u32));
        }
        // The next list begins where numbers of four bytes may.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(Value::Object(view));
        self.views.len() - 1
    }
}
