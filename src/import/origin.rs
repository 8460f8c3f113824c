//! The way back: from a place in the scene to the table or the option that it was made of.

use std::sync::Arc;

use super::Import;
use crate::{Error, Result, Scene};

/// The row that an observation was made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Origin {
    pub file: Arc<str>,
    pub line: usize,
}

impl Import {
    /// Checks the rules of the scene; warnings too name the table's lines.
    ///
    /// # Errors
    /// The first broken rule, with the table's line or the option of `smash import` at fault.
    pub fn check(&self) -> Result<Scene> {
        let checked = Scene::from_file(self.scene_file.clone());
        let mut scene = checked.map_err(|error| self.traced(error))?;
        scene.retell_warnings(|text| self.retold(text));
        Ok(scene)
    }

    /// A text with the table's line for an observation's place.
    fn retold(&self, text: &str) -> String {
        let place = text.find("bodies[").map(|start| text.split_at(start));
        let found = place.and_then(|(before, place)| Some((before, self.origin_of(place)?)));
        match found {
            Some((before, (origin, after))) => {
                format!("{before}line {} of {}{after}", origin.line, origin.file)
            }
            None => text.to_owned(),
        }
    }

    fn traced(&self, error: Error) -> Error {
        let place = error.place().unwrap_or_default().to_owned();
        if let Some((origin, field)) = self.origin_of(&place) {
            let line = format!("line {}", origin.line);
            let place = match column(field) {
                "" => line,
                column => format!("{line}, {column}"),
            };
            let problem = self.retold(error.problem());
            return error.problem_in_words(problem).at(place).in_file(&*origin.file);
        }
        match self.option_of(&place) {
            Some(option) => error.at(option),
            None => error.in_file("the scene of the tables"),
        }
    }

    /// The row of an observation, and what follows in `place`: `.position[1]`.
    fn origin_of<'a>(&self, place: &'a str) -> Option<(&Origin, &'a str)> {
        let (body, rest) = index(place.strip_prefix("bodies[")?)?;
        let (observation, field) = index(rest.strip_prefix(".observations[")?)?;
        Some((self.origins.get(body)?.get(observation)?, field))
    }

    /// The option that gives the value at `place`.
    fn option_of(&self, place: &str) -> Option<String> {
        if ["name", "fps", "gravity"].contains(&place) || place.starts_with("up") {
            let option = place.split('[').next().unwrap_or(place);
            return Some(format!("--{option}"));
        }
        let (body, field) = index(place.strip_prefix("bodies[")?)?;
        let body = self.scene_file.bodies.get(body)?;
        match field.split(['.', '[']).nth(1)? {
            "shape" if field.contains("radius") => Some(format!("--sphere {}", body.name)),
            "shape" => Some(format!("--box {}", body.name)),
            "normal" => Some("--plane".into()),
            "height" => Some("--floor or --plane".into()),
            _ => None,
        }
    }
}

/// Splits `3].position` into 3 and `.position`.
fn index(text: &str) -> Option<(usize, &str)> {
    let (number, rest) = text.split_once(']')?;
    Some((number.parse().ok()?, rest))
}

/// The columns of an observation's field.
fn column(field: &str) -> &str {
    match field {
        ".position[0]" => "column `x`",
        ".position[1]" => "column `y`",
        ".position[2]" => "column `z`",
        ".orientation" => "the quaternion",
        other => other.trim_start_matches('.'),
    }
}
