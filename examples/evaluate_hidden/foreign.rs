//! Laws that the catalogue hasn't got: those of `examples/effects/`.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use smash::nalgebra::Vector3;

use crate::strength::{Parameters, direction, fixed, scalar, vector};

/// Their names.
pub const LAWS: [&str; 6] = ["coriolis", "growing_force", "spring", "tether", "thrust", "wind"];

/// The file of a law.
pub fn path(law: &str) -> String {
    format!("{}/examples/effects/{law}.toml", env!("CARGO_MANIFEST_DIR"))
}

/// Whether a person who suspects the law would measure this parameter of it.
pub fn is_measured(law: &str, parameter: &str) -> bool {
    matches!((law, parameter), ("spring" | "tether", "anchor") | ("tether", "length"))
}

/// Random ones for a body whose centre is at `centre` when it collides.
pub fn parameters(law: &str, centre: Vector3<f64>, random: &mut ChaCha8Rng) -> Parameters {
    let distance_m = random.random_range(0.5..2.0);
    let anchor = fixed("anchor", (centre + distance_m * direction(random)).as_slice());
    match law {
        "coriolis" => vec![vector("turning", 0.1 * direction(random))],
        "growing_force" => vec![vector("growth", 0.3 * direction(random))],
        "spring" => vec![scalar("stiffness", 0.2), anchor],
        "tether" => {
            let slack = random.random_range(0.5..1.0);
            vec![scalar("stiffness", 1.0), fixed("length", &[slack * distance_m]), anchor]
        }
        "thrust" => vec![vector("thrust", 0.2 * direction(random))],
        // wind
        _ => {
            let speed_m_s = random.random_range(1.0..5.0);
            vec![scalar("k", 0.02), fixed("wind", (speed_m_s * direction(random)).as_slice())]
        }
    }
}
