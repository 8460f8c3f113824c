//! A tree to a struct of ours, with the path to whatever is wrong.

use serde::de::value::{MapAccessDeserializer, MapDeserializer, SeqDeserializer, StrDeserializer};
use serde::de::{
    DeserializeOwned, Deserializer, Error as _, IntoDeserializer, Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_path_to_error::{Path, Segment};

use super::fault::Fault;
use super::parse::{Tree, parse};
use super::toml::parse_toml;
use crate::words::{quoted, shortened};
use crate::{Error, ErrorKind, Result};

/// Reads a file of the kind `schema` (such as `smash.scene/1`) from its `text`.
///
/// # Errors
/// Not JSON, another kind of file, or a value that doesn't fit; with the place, the value found
/// and a mend.
pub(crate) fn decode<T: DeserializeOwned>(text: &str, file: &str, schema: &str) -> Result<T> {
    let decode_tree = |tree: &Tree| {
        match tree.field("schema") {
            Some(Tree::Text(found)) => check_schema(found, schema)?,
            // First of all: it tells a scene that lacks it from another program's file.
            None if matches!(tree, Tree::Object(_)) => {
                return Err(Error::new(ErrorKind::Invalid, "the field `schema` is missing")
                    .mend(format!("add `schema`, here \"{schema}\", if it is such a file")));
            }
            // Decoding says what is wrong.
            _ => {}
        }
        from_tree(tree)
    };
    parse(text).and_then(|tree| decode_tree(&tree)).map_err(|error| error.in_file(file))
}

/// Reads what stands by itself, without a field `schema`, from its `text`.
///
/// # Errors
/// Not JSON, or a value that doesn't fit; with the place, the value found and a mend.
pub(crate) fn decode_part<T: DeserializeOwned>(text: &str) -> Result<T> {
    parse(text).and_then(|tree| from_tree(&tree))
}

/// Reads a TOML file from its `text`.
///
/// # Errors
/// Not TOML, or a value that doesn't fit; with the place, the value found and a mend.
pub(crate) fn decode_toml<T: DeserializeOwned>(text: &str, file: &str) -> Result<T> {
    parse_toml(text).and_then(|tree| from_tree(&tree)).map_err(|error| error.in_file(file))
}

fn from_tree<T: DeserializeOwned>(tree: &Tree) -> Result<T> {
    serde_path_to_error::deserialize(tree).map_err(|error| {
        let place = place(error.path());
        error.into_inner().into_error(place)
    })
}

/// Whether `text` is JSON in good order, but no file of the kind `schema`.
pub(crate) fn is_of_another_kind(text: &str, schema: &str) -> bool {
    parse(text).is_ok_and(
        |tree| !matches!(tree.field("schema"), Some(Tree::Text(found)) if found == schema),
    )
}

/// Checks the field `schema`, which says what kind of file this is.
pub(crate) fn check_schema(found: &str, expected: &str) -> Result<()> {
    if found == expected {
        return Ok(());
    }
    Err(Error::invalid("schema", format!("is {}", quoted(found)))
        .mend(format!("this command reads files whose `schema` is `{expected}`")))
}

/// The place as in `bodies[1].observations[3].position`, as [`crate::Error`] names it everywhere.
fn place(path: &Path) -> String {
    let mut text = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => text.push_str(&format!("[{index}]")),
            Segment::Map { key } | Segment::Enum { variant: key } => {
                if !text.is_empty() {
                    text.push('.');
                }
                text.push_str(&shortened(key));
            }
            Segment::Unknown => {}
        }
    }
    text
}

impl<'de> IntoDeserializer<'de, Fault> for &'de Tree {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for &'de Tree {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::Null => visitor.visit_unit(),
            Tree::Bool(value) => visitor.visit_bool(*value),
            Tree::Number(number) => {
                if let Some(value) = number.as_u64() {
                    visitor.visit_u64(value)
                } else if let Some(value) = number.as_i64() {
                    visitor.visit_i64(value)
                } else {
                    visitor.visit_f64(number.as_f64().unwrap_or(f64::NAN))
                }
            }
            Tree::Text(text) => visitor.visit_borrowed_str(text),
            Tree::List(items) => {
                let mut list = SeqDeserializer::new(items.iter());
                let value = visitor.visit_seq(&mut list)?;
                list.end().map(|()| value)
            }
            Tree::Object(fields) => {
                let pairs = fields.iter().map(|(key, value)| (key.as_str(), value));
                visitor.visit_map(MapDeserializer::new(pairs))
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(
        self,
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        length: usize,
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::List(items) if items.len() != length => {
                Err(Fault::invalid_length(items.len(), &visitor))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    /// Objects only: by default serde would take a list for a struct, field after field.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::Object(_) => self.deserialize_any(visitor),
            _ => Err(Fault::Wrong { found: self.shown(), expected: "an object".into() }),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        known: &'static [&'static str],
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::Text(word) => {
                let bare: StrDeserializer<'_, Fault> = StrDeserializer::new(word);
                visitor.visit_enum(bare).map_err(|fault| fault.of_word(word))
            }
            // The word is the only field's name; the field holds what belongs to it.
            Tree::Object(fields) if fields.len() == 1 => {
                let pairs = fields.iter().map(|(key, value)| (key.as_str(), value));
                visitor.visit_enum(MapAccessDeserializer::new(MapDeserializer::new(pairs)))
            }
            _ => {
                let expected = crate::words::listed(known);
                Err(Fault::Wrong { found: self.shown(), expected: format!("one of {expected}") })
            }
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_string<V: Visitor<'de>>(
        self,
        visitor: V,
    ) -> std::result::Result<V::Value, Fault> {
        match self {
            Tree::Text(text) => visitor.visit_borrowed_str(text),
            _ => Err(Fault::invalid_type(Unexpected::Other(&self.shown()), &visitor)),
        }
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str
        bytes byte_buf unit unit_struct seq tuple_struct map identifier ignored_any
    }
}
