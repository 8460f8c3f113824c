//! Rigid-body mechanics in the world's frame, shared by all that Rust computes.

mod collision;
mod free_rotation;
mod inertia;
pub(crate) mod quaternion;
mod state;

pub use collision::Contact;
pub use free_rotation::{LARGEST_TURNING_RAD, rotate_freely, turning_bound_rad};
pub use inertia::{omega_in_world, principal_inertia_per_mass};
pub use state::RigidBody;
