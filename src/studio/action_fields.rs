//! Actions from JSON.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use super::action::{Action, Change, Step};

/// By hand, as the scene's shapes are: serde's own way through a tag loses the path to a wrong value.
impl<'de> Deserialize<'de> for Action {
    fn deserialize<D: Deserializer<'de>>(source: D) -> std::result::Result<Self, D::Error> {
        let mut fields = Fields::deserialize(source)?;
        let action = fields.action()?;
        fields.check_empty()?;
        Ok(action)
    }
}

impl<'de> Deserialize<'de> for Change {
    fn deserialize<D: Deserializer<'de>>(source: D) -> std::result::Result<Self, D::Error> {
        match Action::deserialize(source)? {
            Action::Change(change) => Ok(change),
            Action::Step(_) => {
                Err(D::Error::custom("makes no variant; only changes stand in a session"))
            }
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fields {
    r#do: Word,
    effect: Option<String>,
    text: Option<String>,
    body: Option<String>,
    observation: Option<usize>,
    wrong: Option<bool>,
    time: Option<f64>,
    scale: Option<f64>,
    position: Option<f64>,
    orientation: Option<f64>,
    variant: Option<usize>,
    shown: Option<bool>,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Word {
    Add,
    Remove,
    Law,
    Mark,
    Time,
    PoseNoise,
    Noise,
    Undo,
    Redo,
    Go,
    Compare,
}

impl Fields {
    /// The action, whose fields are taken out.
    fn action<E: serde::de::Error>(&mut self) -> std::result::Result<Action, E> {
        let effect = |fields: &mut Fields| taken(&mut fields.effect, "effect");
        let body = |fields: &mut Fields| taken(&mut fields.body, "body");
        let observation = |fields: &mut Fields| taken(&mut fields.observation, "observation");
        let variant = |fields: &mut Fields| taken(&mut fields.variant, "variant");
        let change = match self.r#do {
            Word::Add => Change::Add { effect: effect(self)? },
            Word::Remove => Change::Remove { effect: effect(self)? },
            Word::Law => {
                Change::Law { text: taken(&mut self.text, "text")?, effect: effect(self)? }
            }
            Word::Mark => Change::Mark {
                body: body(self)?,
                observation: observation(self)?,
                wrong: taken(&mut self.wrong, "wrong")?,
            },
            Word::Time => Change::Time {
                body: body(self)?,
                observation: observation(self)?,
                time: taken(&mut self.time, "time")?,
            },
            Word::PoseNoise => Change::PoseNoise {
                body: body(self)?,
                observation: observation(self)?,
                scale: taken(&mut self.scale, "scale")?,
            },
            Word::Noise => Change::Noise {
                position: self.position.take(),
                orientation: self.orientation.take(),
            },
            Word::Undo => return Ok(Action::Step(Step::Undo)),
            Word::Redo => return Ok(Action::Step(Step::Redo)),
            Word::Go => return Ok(Action::Step(Step::Go { variant: variant(self)? })),
            Word::Compare => {
                let shown = taken(&mut self.shown, "shown")?;
                return Ok(Action::Step(Step::Compare { variant: variant(self)?, shown }));
            }
        };
        Ok(Action::Change(change))
    }

    /// Refuses what belongs to another action.
    fn check_empty<E: serde::de::Error>(&self) -> std::result::Result<(), E> {
        let left = [
            ("effect", self.effect.is_some()),
            ("text", self.text.is_some()),
            ("body", self.body.is_some()),
            ("observation", self.observation.is_some()),
            ("wrong", self.wrong.is_some()),
            ("time", self.time.is_some()),
            ("scale", self.scale.is_some()),
            ("position", self.position.is_some()),
            ("orientation", self.orientation.is_some()),
            ("variant", self.variant.is_some()),
            ("shown", self.shown.is_some()),
        ];
        match left.iter().find(|(_, is_left)| *is_left) {
            Some((name, _)) => {
                Err(E::custom(format!("has no `{name}` in this action; leave `{name}` out")))
            }
            None => Ok(()),
        }
    }
}

fn taken<T, E: serde::de::Error>(
    field: &mut Option<T>,
    name: &'static str,
) -> std::result::Result<T, E> {
    field.take().ok_or_else(|| E::missing_field(name))
}
