//! All scenes of a batch in one table.

use serde::Serialize;
use serde_json::Value;

use super::inputs::Input;
use crate::Error;
use crate::files::spreadsheet_text;
use crate::reconstruct::{ActiveEffect, Flag, Number, ParameterEstimate, Reconstruction};

/// A scene's row; its fields are the columns. SI units; `None` (an empty cell, null) where there is
/// no number, for which the result gives the reason.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Row {
    /// The result's name in the folder, before `.result.json`.
    pub name: String,
    /// The scene's file.
    pub file: String,
    /// Whether there is a result.
    pub status: Status,
    /// m_b / m_a.
    pub mass_ratio: Option<f64>,
    /// Its standard deviation.
    pub mass_ratio_std: Option<f64>,
    /// c.
    pub restitution: Option<f64>,
    /// Its standard deviation.
    pub restitution_std: Option<f64>,
    /// t_c in s.
    pub collision_time: Option<f64>,
    /// Its standard deviation, in s.
    pub collision_time_std: Option<f64>,
    /// Of all position coordinates, in m.
    pub position_rmse: Option<f64>,
    /// Of all components of the rotation vectors, in rad.
    pub orientation_rmse: Option<f64>,
    /// χ² a degree of freedom.
    pub reduced_chi2: Option<f64>,
    /// Effects beyond the base model with their values, such as `quadratic_drag@a:k=0.14`: what
    /// `--with` takes of a catalogue's.
    pub effects: Vec<String>,
    /// What is doubtful.
    pub flags: Vec<Flag>,
    /// Why it failed, and what to do about it, on one line.
    pub error: Option<String>,
}

/// Whether a scene has a result.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Status {
    /// It has one.
    #[default]
    Done,
    /// It has none; the row says why.
    Failed,
}

impl Row {
    pub(super) fn done(input: &Input, result: &Reconstruction) -> Row {
        let mass_ratio = result.mass_ratio.as_ref();
        Row {
            mass_ratio: mass_ratio.and_then(|estimate| estimate.value),
            mass_ratio_std: mass_ratio.and_then(|estimate| estimate.std),
            restitution: result.restitution.value,
            restitution_std: result.restitution.std,
            collision_time: result.collision_time.value,
            collision_time_std: result.collision_time.std,
            position_rmse: Some(result.fit.position_rmse),
            orientation_rmse: result.fit.orientation_rmse,
            reduced_chi2: result.fit.reduced_chi2,
            effects: result.effects.iter().map(with_values).collect(),
            flags: result.flags.clone(),
            ..Row::of(input)
        }
    }

    pub(super) fn failed(input: &Input, error: &Error) -> Row {
        let error = Some(error.to_string().replace("\n  hint: ", "; hint: "));
        Row { status: Status::Failed, error, ..Row::of(input) }
    }

    fn of(input: &Input) -> Row {
        let file = input.path.display().to_string();
        Row { name: input.name.clone(), file, ..Row::default() }
    }
}

fn with_values(effect: &ActiveEffect) -> String {
    let value = |(name, estimate): (&String, &ParameterEstimate)| {
        Some(match estimate.value? {
            Number::Scalar(value) => format!("{name}={value}"),
            Number::Vector([x, y, z]) => format!("{name}=[{x},{y},{z}]"),
        })
    };
    let values: Vec<String> = effect.parameters.iter().filter_map(value).collect();
    format!("{}:{}", effect.label(), values.join(","))
}

/// The table with a header; effects and flags are separated by spaces. Before a text that a spreadsheet
/// would compute stands an apostrophe.
pub(super) fn csv(rows: &[Row]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let write = |writer: &mut csv::Writer<Vec<u8>>, cells: Vec<String>| {
        writer.write_record(cells).expect("memory takes every row, and all are of one length");
    };
    let header = fields(&Row::default()).into_iter().map(|(column, _)| column).collect();
    write(&mut writer, header);
    for row in rows {
        write(&mut writer, fields(row).into_iter().map(|(_, value)| cell(&value)).collect());
    }
    let bytes = writer.into_inner().expect("memory takes every row");
    String::from_utf8(bytes).expect("every cell is text")
}

/// One JSON object a row and line.
pub(super) fn json_lines(rows: &[Row]) -> String {
    rows.iter().map(|row| Value::Object(fields(row)).to_string() + "\n").collect()
}

/// The columns and their values.
fn fields(row: &Row) -> serde_json::Map<String, Value> {
    match serde_json::to_value(row) {
        Ok(Value::Object(fields)) => fields,
        _ => unreachable!("a row is a struct of plain numbers and strings"),
    }
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => spreadsheet_text(text),
        Value::Array(items) => items.iter().map(cell).collect::<Vec<_>>().join(" "),
        plain => plain.to_string(),
    }
}
