//! Reconstructs how two rigid bodies collided, from a few annotated poses.
//!
//! ```text
//! scene ──► reconstruct ──► result        simulate ──► scene
//! (json,     (segment search,  (numbers     (the same dynamics
//!  csv)       phases 1 to 3)    and flags)   run forwards)
//! ```

pub mod files;
pub mod rigid_body;
pub mod scene;
pub mod simulate;

mod error;

pub use error::{Error, ErrorKind, Result};
pub use scene::Scene;
