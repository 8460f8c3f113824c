//! The bridges to C++, one for each preset: data in, data out.

pub(crate) mod paper;
pub(crate) mod refined;
