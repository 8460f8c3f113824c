//! All integration tests, in one binary: one module a topic. `tests/README.md` says what each
//! kind of test proves.

// The helpers of tests are tests too: a panic is how they fail.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod collision;
mod docs;
mod free_rotation;
mod import;
mod installation;
mod scene_rules;
mod scene_warnings;
mod scenes;
mod schema;
mod simulate;
mod simulate_command;
