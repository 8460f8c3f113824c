//! All integration tests: one binary, one file a topic.

mod collision;
mod free_rotation;
mod simulate;
