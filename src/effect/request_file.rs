//! What was asked for of effects, as it stands in a result's options.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::EffectFile;
use super::request::{check_value, parameter};
use super::{Effect, EffectRequest, catalogue, known};
use crate::Error;

/// An effect, as it was asked for.
#[derive(Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "EffectRequest")]
pub(crate) struct RequestFile {
    /// Its name in the catalogue, or in the user's file.
    name: String,
    /// The body that it acts on; null for all that it can act on.
    #[serde(default)]
    body: Option<String>,
    /// The parameters that were given, in their units: 1 or 3 numbers each.
    #[serde(default)]
    fixed: BTreeMap<String, Vec<f64>>,
    /// The user's file, as it was named; missing where there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    /// What it is, in the form of its file; missing where it is the catalogue's effect of this name.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<EffectFile>")]
    definition: Option<Effect>,
}

impl From<EffectRequest> for RequestFile {
    fn from(EffectRequest { effect, body, fixed }: EffectRequest) -> RequestFile {
        let is_known = catalogue().contains(&effect);
        RequestFile {
            name: effect.name.clone(),
            body,
            fixed,
            file: effect.file.clone(),
            definition: (!is_known).then_some(effect),
        }
    }
}

impl TryFrom<RequestFile> for EffectRequest {
    type Error = String;

    fn try_from(asked: RequestFile) -> std::result::Result<EffectRequest, String> {
        // The reader takes what follows a semicolon for the mend.
        let in_words = |error: Error| error.to_string().replace("\n  hint: ", "; ");
        let effect = match asked.definition {
            Some(effect) => effect,
            None => known(&asked.name).map_err(in_words)?.clone(),
        };
        for (name, numbers) in &asked.fixed {
            let parameter = parameter(&effect, name).map_err(in_words)?;
            check_value(&effect, parameter, numbers).map_err(in_words)?;
        }
        let effect = Effect { file: asked.file, ..effect };
        Ok(EffectRequest { effect, body: asked.body, fixed: asked.fixed })
    }
}
