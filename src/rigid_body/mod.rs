//! Rigid-body mechanics in the world's frame, shared by all that Rust computes.

mod inertia;

pub use inertia::{omega_in_world, principal_inertia_per_mass};
