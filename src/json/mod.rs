//! JSON for people: what is wrong in a file, where, and how to mend it.
//!
//! ```text
//! text ──► parse ──► tree ──► decode ──► a struct of ours        a struct ──► pretty ──► text
//! ```

mod decode;
mod fault;
mod parse;
mod pretty;

pub(crate) use decode::{check_schema, decode, is_of_another_kind};
pub(crate) use pretty::pretty;
