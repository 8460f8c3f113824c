//! `smash schema`: the JSON Schema of a file.

use std::path::PathBuf;

use smash::files::Output;
use smash::{SchemaKind, schema};

/// Prints the JSON Schema of a kind of file
#[derive(clap::Args)]
pub struct Arguments {
    /// The kind of file
    kind: SchemaKind,
    /// Where to write it; `-` is standard output
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    output: PathBuf,
    /// Accepted as everywhere; a schema is JSON anyhow
    #[arg(long)]
    json: bool,
}

/// Writes the schema.
pub fn run(arguments: &Arguments) -> smash::Result<()> {
    Output::check(&arguments.output, &[])?.write(schema(arguments.kind).as_bytes())
}
