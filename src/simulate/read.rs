//! Specifications from files, truths to files.

use std::path::Path;

use super::{SIMULATION_SCHEMA, SimulationSpec, TRUTH_SCHEMA, Truth};
use crate::Result;
use crate::files::{display_name, read_text};
use crate::json::{decode, pretty};
use crate::reconstruct::check_numbers;

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
    /// Reads the truth `path` (`-` is standard input).
    ///
    /// # Errors
    /// The file can't be read, isn't JSON, is no `smash.truth/1`, or holds a number beyond reason; with
    /// place, value and mend.
    pub fn read(path: impl AsRef<Path>) -> Result<Truth> {
        let path = path.as_ref();
        let name = display_name(path, "standard input");
        let truth: Truth = decode(&read_text(path)?, &name, TRUTH_SCHEMA)?;
        let tree = serde_json::to_value(&truth).expect("it was a JSON tree before");
        check_numbers("", &tree, "simulate the scene again")
            .map_err(|error| error.in_file(name))?;
        Ok(truth)
    }

    /// The truth's text as JSON.
    pub fn to_json(&self) -> String {
        pretty(self)
    }
}
