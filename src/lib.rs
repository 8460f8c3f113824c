//! Reconstructs how two rigid bodies collided, from a few annotated poses.
//!
//! ```text
//! scene ──► reconstruct ──► result        simulate ──► scene
//! (json,     (segment search,  (numbers     (the same dynamics
//!  csv)       phases 1 to 3)    and flags)   run forwards)
//! ```

pub mod batch;
pub mod compare;
pub mod diagnose;
pub mod effect;
pub mod export;
pub mod files;
pub mod import;
pub mod improve;
pub mod motion;
pub mod power;
pub mod reconstruct;
pub mod report;
pub mod rigid_body;
pub mod scene;
pub mod simulate;
pub mod studio;

mod bridge;
mod error;
mod json;
mod schema;
mod words;

/// The vectors, quaternions and matrices in this crate's signatures are of this version.
pub use nalgebra;

pub use compare::{Comparison, compare};
pub use diagnose::{Diagnosis, diagnose, diagnose_throws};
pub use error::{Error, ErrorKind, Result};
pub use improve::{Improvement, improve, improve_throws};
pub use motion::motion;
pub use power::{Power, power};
pub use reconstruct::{Options, Reconstruction, reconstruct, reconstruct_with_progress};
pub use scene::Scene;
pub use schema::{SchemaKind, schema};

/// The version of Ceres Solver that this was built with.
pub fn ceres_version() -> String {
    bridge::paper::ffi::ceres_version().unwrap_or_else(|error| error.what().to_string())
}

/// Keeps the log of Ceres Solver off standard error, for the whole process. The library leaves it
/// as it is; a program that talks to a person wants it silent.
pub fn silence_solver_log() {
    // It only sets a number: there is nothing to report.
    let _ = bridge::paper::ffi::silence_ceres_log();
}

/// The README's Rust is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
