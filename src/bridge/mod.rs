//! The bridges to C++, one for each preset: data in, data out.

#[cfg(test)]
pub(crate) mod flight_reference;
pub(crate) mod paper;
pub(crate) mod refined;
