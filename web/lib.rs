//! The page of reports and of the studio, as one HTML file. A crate of its own, since its build script
//! then runs when the page changes, and that of the numerics when they do.

/// The page, with a marker where its data go; none where there was no Node to build it with.
pub const PAGE: Option<&str> = include!(concat!(env!("OUT_DIR"), "/page.rs"));
