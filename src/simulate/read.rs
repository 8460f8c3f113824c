//! Specifications from files, truths to files.

use std::path::Path;

use super::{SIMULATION_SCHEMA, SimulationSpec, Truth};
use crate::Result;
use crate::files::{display_name, read_text};
use crate::json::{decode, pretty};

impl SimulationSpec {
    /// Reads the specification `path` (`-` is standard input); [`simulate`](super::simulate)
    /// checks it.
    ///
    /// # Errors
    /// The file can't be read, isn't JSON, or has a field that is unknown, missing or of a wrong
    /// type; with place, value and mend.
    pub fn read(path: &Path) -> Result<SimulationSpec> {
        SimulationSpec::parse(&read_text(path)?, &display_name(path, "standard input"))
    }

    /// Reads a specification from `text`; `file_name` is only for messages.
    ///
    /// # Errors
    /// As [`SimulationSpec::read`].
    pub fn parse(text: &str, file_name: &str) -> Result<SimulationSpec> {
        decode(text, file_name, SIMULATION_SCHEMA)
    }

    /// The specification's text as JSON.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}

impl Truth {
    /// The truth's text as JSON.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}
