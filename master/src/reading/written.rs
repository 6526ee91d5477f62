//! The scene as written: a tree of values, each with its place in the text.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeInteger, DeString, DeTable, DeValue};

use super::error::{SceneError, SceneErrors};
use super::error_kind::SceneErrorKind;
use super::place::{Place, Source, Spot};
use super::text::text_of;

/// The entries of a table by key.
pub(crate) type Table = BTreeMap<String, Entry>;

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key_spot: Spot,
    pub(crate) node: Node,
}

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) spot: Spot,
    pub(crate) value: Value,
}

/// What TOML can say.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    /// An integer of more than 64 bits.
    Oversized(String),
    Float(f64),
    Flag(bool),
    Date(String),
    List(Vec<Node>),
    Table(Table),
}

impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => write!(f, "the text {text:?}"),
            Self::Integer(number) => write!(f, "{number}"),
            Self::Oversized(digits) => write!(f, "{digits} (more than 64 bits)"),
            Self::Float(number) => write!(f, "{number:?}"),
            Self::Flag(flag) => write!(f, "{flag}"),
            Self::Date(date) => write!(f, "the date {date}"),
            Self::List(_) => f.write_str("a list"),
            Self::Table(_) => f.write_str("a table"),
        }
    }
}

impl Node {
    /// Takes over a parsed value whose spans count from `offset` in the source.
    pub(crate) fn from_toml(parsed: &Spanned<DeValue<'_>>, source: usize, offset: usize) -> Self {
        let value = match parsed.get_ref() {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(integer) => integer_value(integer),
            // TOML writes floats as Rust reads them; one beyond the range of f64 becomes infinite.
            DeValue::Float(float) => Value::Float(float.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(flag) => Value::Flag(*flag),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => Value::List(
                items
                    .iter()
                    .map(|item| Self::from_toml(item, source, offset))
                    .collect(),
            ),
            DeValue::Table(table) => Value::Table(table_from_toml(table, source, offset)),
        };
        Self {
            spot: spot_of(parsed, source, offset),
            value,
        }
    }

    /// The same value as one-line TOML, to be read again.
    pub(crate) fn to_toml(&self) -> toml::Value {
        match &self.value {
            Value::Text(text) | Value::Date(text) | Value::Oversized(text) => {
                toml::Value::String(text.clone())
            }
            Value::Integer(number) => toml::Value::Integer(*number),
            Value::Float(number) => toml::Value::Float(*number),
            Value::Flag(flag) => toml::Value::Boolean(*flag),
            Value::List(items) => toml::Value::Array(items.iter().map(Self::to_toml).collect()),
            Value::Table(table) => toml::Value::Table(
                table
                    .iter()
                    .map(|(key, entry)| (key.clone(), entry.node.to_toml()))
                    .collect(),
            ),
        }
    }

    /// The same value with its places in another source.
    pub(crate) fn in_source(&self, source: usize) -> Self {
        let value = match &self.value {
            Value::List(items) => {
                Value::List(items.iter().map(|item| item.in_source(source)).collect())
            }
            Value::Table(table) => {
                let moved = |(key, entry): (&String, &Entry)| {
                    let entry = Entry {
                        key_spot: entry.key_spot.in_source(source),
                        node: entry.node.in_source(source),
                    };
                    (key.clone(), entry)
                };
                Value::Table(table.iter().map(moved).collect())
            }
            plain => plain.clone(),
        };
        Self {
            spot: self.spot.in_source(source),
            value,
        }
    }

    /// True if this is a table whose `name` is the given one.
    pub(crate) fn is_named(&self, name: &str) -> bool {
        self.name() == Some(name)
    }

    /// The text under the key `name` of a table.
    pub(crate) fn name(&self) -> Option<&str> {
        let Value::Table(table) = &self.value else {
            return None;
        };
        match &table.get("name")?.node.value {
            Value::Text(name) => Some(name),
            _ => None,
        }
    }
}

fn integer_value(integer: &DeInteger<'_>) -> Value {
    i64::from_str_radix(integer.as_str(), integer.radix())
        .map_or_else(|_| Value::Oversized(integer.to_string()), Value::Integer)
}

fn table_from_toml(table: &DeTable<'_>, source: usize, offset: usize) -> Table {
    table
        .iter()
        .map(|(key, value): (&Spanned<DeString<'_>>, _)| {
            let entry = Entry {
                key_spot: spot_of(key, source, offset),
                node: Node::from_toml(value, source, offset),
            };
            (key.get_ref().to_string(), entry)
        })
        .collect()
}

fn spot_of<T>(spanned: &Spanned<T>, source: usize, offset: usize) -> Spot {
    let span = spanned.span();
    Spot::new(source, span.start + offset..span.end + offset)
}

/// A scene as written, together with the overrides that were put into it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Written {
    /// The file, then one source for each override or study.
    pub(crate) sources: Vec<Arc<Source>>,
    /// What the file is, for messages.
    pub(crate) document: &'static str,
    pub(crate) root: Node,
}

impl Written {
    /// Parses a file; `document` says what it is. All mistakes of its text: the first one of every line.
    pub(crate) fn parse(
        text: &str,
        origin: &str,
        document: &'static str,
    ) -> Result<Self, SceneErrors> {
        Self::parse_toml(text, origin, document).map_err(|mistakes| {
            let error =
                |(place, reason)| SceneError::new(Some(place), SceneErrorKind::NotToml { reason });
            SceneErrors::new(mistakes.into_iter().map(error).collect())
        })
    }

    fn parse_toml(
        text: &str,
        origin: &str,
        document: &'static str,
    ) -> Result<Self, Vec<(Place, String)>> {
        let source = Arc::new(Source::file(origin, text));
        let (table, mistakes) = DeTable::parse_recoverable(text);
        if mistakes.is_empty() {
            return Ok(Self {
                sources: vec![source],
                document,
                root: Node {
                    spot: Spot::new(0, 0..0),
                    value: Value::Table(table_from_toml(table.get_ref(), 0, 0)),
                },
            });
        }
        let mut reported: Vec<(Place, String)> = Vec::new();
        for mistake in mistakes {
            let span = mistake.span().unwrap_or(text.len()..text.len());
            let place = Place::new(&source, &Spot::new(0, span));
            // What follows in the same line is a consequence of the first mistake there.
            if reported.iter().all(|(other, _)| other.line != place.line) {
                reported.push((place, mistake.message().to_owned()));
            }
        }
        Err(reported)
    }

    /// Whether the file at `path` has a table of this name at the top; false if it cannot be read.
    pub(crate) fn has_table(path: &Path, name: &str) -> bool {
        let text = text_of(path, "").ok();
        let written = text.and_then(|text| Self::parse(&text, "", "").ok());
        let root = written.map(|written| written.root.value);
        matches!(root, Some(Value::Table(table)) if table.contains_key(name))
    }

    /// The folder of the file, from which it counts its paths.
    pub(crate) fn folder(&self) -> &Path {
        let file = self.sources.first().and_then(|file| file.path());
        file.and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// The text of the file.
    pub(crate) fn text(&self) -> &str {
        self.sources.first().map_or("", |file| file.text())
    }

    /// The place of a spot.
    pub(crate) fn place(&self, spot: &Spot) -> Option<Place> {
        let source = self.sources.get(spot.source)?;
        Some(Place::new(source, spot))
    }

    /// The entry of a list at the top level, such as `subsystem`, by its name.
    pub(crate) fn list_entry(&self, list: &str, name: &str) -> Option<&Node> {
        let Value::Table(table) = &self.root.value else {
            return None;
        };
        match &table.get(list)?.node.value {
            Value::List(items) => items.iter().find(|item| item.is_named(name)),
            _ => None,
        }
    }

    /// The value at a dotted key, or at the nearest key around it; entries of lists go by their name.
    pub(crate) fn nearest_node(&self, key: &str) -> Option<&Node> {
        let mut found = None;
        let mut node = &self.root;
        for part in key.split('.') {
            let below = match &node.value {
                Value::Table(table) => table.get(part).map(|entry| &entry.node),
                Value::List(items) => items.iter().find(|item| item.is_named(part)),
                _ => None,
            };
            match below {
                Some(below) => node = below,
                None => break,
            }
            found = Some(node);
        }
        found
    }
}
