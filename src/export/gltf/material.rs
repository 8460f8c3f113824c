//! Colours that eyes of every kind tell apart (Okabe and Ito), each with a lighter second tone.

use serde_json::{Value, json};

/// Main and second tone in sRGB, 0 to 255.
type Tones = [[u8; 3]; 2];

/// Of the reference body: bluish green.
const FIRST: Tones = [[0, 158, 115], [178, 226, 213]];
/// Of the other: orange.
const SECOND: Tones = [[230, 159, 0], [248, 226, 179]];
/// Of the plane: grey.
const PLANE: [u8; 3] = [153; 3];

/// Both tones of the body with this number.
pub(super) fn of_body(index: usize, name: &str) -> Vec<Value> {
    let tones = if index == 0 { FIRST } else { SECOND };
    tones.iter().map(|tone| material(name, tone, false)).collect()
}

/// The plane's, which is seen from below, too.
pub(super) fn of_plane(name: &str) -> Value {
    material(name, &PLANE, true)
}

fn material(name: &str, tone: &[u8; 3], double_sided: bool) -> Value {
    let [red, green, blue] = tone.map(linear);
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0.0, "roughnessFactor": 0.8,
        },
        "doubleSided": double_sided,
    })
}

/// The light that a component of sRGB stands for (IEC 61966-2-1).
fn linear(component: u8) -> f64 {
    let share = f64::from(component) / 255.0;
    if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
}
