//! A session as it stands in a file, `smash.session/1`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::action::Change;
use super::session::Session;
use super::session_scene::SessionScene;
use super::tree::{MOST_COMPARED, Numbers, Tree};
use crate::json::{decode, pretty};
use crate::scene::values::check_range;
use crate::words::counted;
use crate::{Error, ErrorKind, Result, Scene};

/// The value of a session file's field `schema`.
pub const SESSION_SCHEMA: &str = "smash.session/1";
/// The largest session, in bytes.
pub(super) const LARGEST_SESSION_BYTES: usize = 8 << 20;
/// The longest draft of a law, in bytes.
pub(super) const LONGEST_DRAFT_BYTES: usize = 256 << 10;

/// All that was tried in a studio: what was changed, variant by variant. What the variants are follows
/// from that.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "smash.session/1")]
pub struct SessionFile {
    /// Always `smash.session/1`.
    #[schemars(extend("const" = SESSION_SCHEMA))]
    pub schema: String,
    /// The scene that it is of.
    pub scene: SessionScene,
    /// The variant that is seen.
    pub current: usize,
    /// Variants that are shown beside it.
    #[serde(default)]
    pub compared: Vec<usize>,
    /// The law that is being typed.
    #[serde(default)]
    pub draft: String,
    /// By their numbers; the first is the base model, and parents come before their children.
    #[schemars(length(min = 1))]
    pub variants: Vec<SessionVariant>,
}

/// A model that was tried.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SessionVariant {
    /// The variant that it was made from; null of the first.
    pub parent: Option<usize>,
    /// What was changed; null of the first.
    pub change: Option<Change>,
    /// The child that one came back from last.
    #[serde(default)]
    pub redo: Option<usize>,
    /// How well it fitted.
    pub numbers: Numbers,
}

impl SessionFile {
    /// Reads a session from `text`; `file_name` is only for messages.
    ///
    /// # Errors
    /// It is too large, isn't JSON, or is no session; with place, value and mend.
    pub fn parse(text: &str, file_name: &str) -> Result<SessionFile> {
        check_size(text).map_err(|error| error.in_file(file_name))?;
        decode(text, file_name, SESSION_SCHEMA)
    }

    pub(super) fn of(session: &Session, scene: &SessionScene) -> SessionFile {
        let variants = session.tree.variants.iter().map(|variant| SessionVariant {
            parent: variant.parent,
            change: variant.change.clone(),
            redo: variant.redo,
            numbers: variant.numbers,
        });
        SessionFile {
            schema: SESSION_SCHEMA.to_string(),
            scene: scene.clone(),
            current: session.tree.current,
            compared: session.tree.compared.clone(),
            draft: session.draft.clone(),
            variants: variants.collect(),
        }
    }

    /// The file's text: JSON, with a final newline.
    ///
    /// # Errors
    /// It is larger than what can be read again.
    pub fn to_json(&self) -> Result<String> {
        let text = pretty(self);
        check_size(&text)?;
        Ok(text)
    }

    /// The session, made again change by change, by the checks that each passed when it was made.
    pub(super) fn session(self, scene: &Scene, identity: &SessionScene) -> Result<Session> {
        self.scene.check_same(identity)?;
        if self.draft.len() > LONGEST_DRAFT_BYTES {
            return Err(Error::invalid("draft", "is too long").mend("keep a page of text"));
        }
        let mut tree = Tree::new();
        for (index, variant) in self.variants.iter().enumerate() {
            let place = format!("variants[{index}]");
            add(&mut tree, scene, index, variant).map_err(|error| within(&place, error))?;
        }
        let Some(first) = self.variants.first() else {
            return Err(Error::invalid("variants", "is empty").mend("the first is the base model"));
        };
        tree.variants[0].numbers = first.numbers;
        for (index, variant) in self.variants.iter().enumerate() {
            let Some(redo) = variant.redo else { continue };
            let place = format!("variants[{index}].redo");
            tree.check(&place, redo)?;
            if tree.variants[redo].parent != Some(index) {
                return Err(Error::invalid(place, format!("{redo} wasn't made from it"))
                    .mend("name a variant whose `parent` it is, or null"));
            }
            tree.variants[index].redo = Some(redo);
        }
        tree.check("current", self.current)?;
        tree.current = self.current;
        if self.compared.len() > MOST_COMPARED {
            let problem = format!("holds {}", counted(self.compared.len(), "variant"));
            return Err(Error::invalid("compared", problem).mend(format!("keep {MOST_COMPARED}")));
        }
        for (index, &compared) in self.compared.iter().enumerate() {
            let place = format!("compared[{index}]");
            tree.check(&place, compared)?;
            if compared == self.current || self.compared[..index].contains(&compared) {
                return Err(Error::invalid(place, format!("{compared} is shown already"))
                    .mend("name each variant once"));
            }
        }
        tree.compared = self.compared;
        let session = Session { tree, draft: self.draft };
        session.check_laws().map_err(|error| error.at("variants"))?;
        Ok(session)
    }
}

/// Adds the variant with the number `index`.
fn add(tree: &mut Tree, scene: &Scene, index: usize, variant: &SessionVariant) -> Result<()> {
    check_numbers(&variant.numbers)?;
    let (parent, change) = match (index, variant.parent, &variant.change) {
        (0, None, None) => return Ok(()),
        (0, _, _) => {
            return Err(Error::new(ErrorKind::Invalid, "was made from another one")
                .mend("the first variant is the base model: null as `parent` and `change`"));
        }
        (_, Some(parent), Some(change)) => (parent, change),
        (_, parent, _) => {
            let field = if parent.is_none() { "parent" } else { "change" };
            return Err(
                Error::invalid(field, "is null").mend("only the first variant was made from none")
            );
        }
    };
    if parent >= index {
        return Err(Error::invalid("parent", format!("is {parent}, which comes later"))
            .mend("parents come before their children"));
    }
    let model = tree.variants[parent].model.clone();
    if model.lacks_double(scene, change) {
        tree.check_room()?;
        let same = tree.push(parent, change.clone(), model);
        tree.variants[same].numbers = variant.numbers;
        return Ok(());
    }
    let grown =
        tree.grow(scene, parent, change.clone()).map_err(|error| within("change", error))?;
    let Some(grown) = grown else {
        return Err(Error::invalid("change", "changes nothing").mend("take the variant out"));
    };
    tree.variants[grown].numbers = variant.numbers;
    Ok(())
}

/// Numbers of a file are shown, but never reckoned with.
fn check_numbers(numbers: &Numbers) -> Result<()> {
    let Numbers {
        position_rmse,
        orientation_rmse,
        reduced_chi2,
        chi2,
        mass_ratio,
        restitution,
        milliseconds,
    } = *numbers;
    let named = [
        ("position_rmse", Some(position_rmse)),
        ("orientation_rmse", orientation_rmse),
        ("reduced_chi2", reduced_chi2),
        ("chi2", chi2),
        ("mass_ratio", mass_ratio),
        ("restitution", restitution),
        ("milliseconds", Some(milliseconds)),
    ];
    named.into_iter().try_for_each(|(name, value)| {
        check_range(
            &format!("numbers.{name}"),
            value.unwrap_or(0.0),
            &(-1e100..=1e100),
            "no fit has such a number",
        )
    })
}

fn check_size(text: &str) -> Result<()> {
    if text.len() <= LARGEST_SESSION_BYTES {
        return Ok(());
    }
    let problem = format!("the session is larger than {} MiB", LARGEST_SESSION_BYTES >> 20);
    Err(Error::new(ErrorKind::Invalid, problem)
        .mend("keep it, and start a new one: --session FILE"))
}

/// The error at a place that is within `place`.
fn within(place: &str, error: Error) -> Error {
    let inner = error.place().map(|inner| format!("{place}.{inner}"));
    error.at(inner.unwrap_or_else(|| place.to_string()))
}
