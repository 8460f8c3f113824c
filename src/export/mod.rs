//! A result's motion for other programs: a film in 3D, or a table.
//!
//! ```text
//! result ──► motion, frame by frame ─┬─► gltf: solids and keys
//!  (its setting, states at the       └─► csv: a row a frame
//!   collision, effects)
//! ```

mod csv;
mod frames;
mod gltf;

pub use csv::csv;
pub use gltf::gltf;
