//! JSON, and TOML, for people: what is wrong in a file, where, and how to mend it.
//!
//! ```text
//! text ──► parse ──► tree ──► decode ──► a struct of ours        a struct ──► pretty ──► text
//! ```

mod decode;
mod fault;
mod parse;
mod pretty;
mod toml;

pub(crate) use decode::{check_schema, decode, decode_part, decode_toml, is_of_another_kind};
pub(crate) use pretty::pretty;
