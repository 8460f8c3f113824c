//! Which scene a session belongs to.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::content::{changes, content};
use crate::files::sha256;
use crate::words::quoted;
use crate::{Error, Result, Scene};

/// Which scene a session is of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SessionScene {
    /// Its name.
    pub name: String,
    /// The SHA-256 of its file, as `sha256sum` prints it.
    pub sha256: String,
    /// Its file's fields, with checksums instead of poses: to tell what was changed in it since.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub content: Option<Map<String, Value>>,
}

impl SessionScene {
    /// That of the file `text`, which holds `scene`.
    pub(super) fn of(scene: &Scene, text: &str) -> SessionScene {
        SessionScene {
            name: scene.name().to_string(),
            sha256: sha256(text),
            content: Some(content(scene)),
        }
    }

    /// Refuses a session of this scene where `other` is open.
    pub(super) fn check_same(&self, other: &SessionScene) -> Result<()> {
        let changed = self.content.as_ref().zip(other.content.as_ref());
        let changes = changed.map(|(was, now)| changes(was, now));
        // What differs but for that is white space, a name, a comment.
        if self.sha256 == other.sha256 || changes.as_deref() == Some("") {
            return Ok(());
        }
        let name = quoted(&self.name);
        let problem = match changes {
            Some(changes) => {
                format!("isn't as it was when the session was saved, {name}: {changes}")
            }
            None => format!("is another one, or was changed since: {name}"),
        };
        Err(Error::invalid("scene", problem).mend(
            "open the session with its own scene, as that was; or, to start anew, move or remove the \
             session, or name another one: --session FILE",
        ))
    }
}
