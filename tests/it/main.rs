//! All integration tests, in one binary: one module a topic. `tests/README.md` says what each
//! kind of test proves.

// A test fails by panicking, in its helpers too.
#![allow(clippy::unwrap_used)]

mod bad_input;
mod batch;
mod browser;
mod collision;
mod compare;
mod demo;
mod docs;
mod doubts;
mod effects;
mod examples;
mod export;
mod free_rotation;
mod import;
mod installation;
mod ledger;
mod motion;
mod power;
mod reconstruct;
mod reconstruct_command;
mod refined;
mod report;
mod residual_structure;
mod scene_flights;
mod scene_rules;
mod scene_warnings;
mod scenes;
mod schema;
mod simulate;
mod simulate_command;
mod simulate_effects;
mod story;
mod studio;
mod with;
