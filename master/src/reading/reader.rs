//! Reads typed values from the tree of a written scene and collects what is wrong with them.

use super::error::{SceneError, SceneErrors};
use super::error_kind::{Names, SceneErrorKind};
use super::key::{Default, FINITE, Key, Range, Takes};
use super::nearest::nearest;
use super::place::Spot;
use super::written::{Entry, Node, Table, Value, Written};

/// The mistakes found so far.
pub(crate) struct Problems<'w> {
    pub(crate) written: &'w Written,
    found: Vec<SceneError>,
}

impl<'w> Problems<'w> {
    pub(crate) fn new(written: &'w Written) -> Self {
        Self {
            written,
            found: Vec::new(),
        }
    }

    pub(crate) fn report(&mut self, spot: &Spot, kind: SceneErrorKind) {
        self.found
            .push(SceneError::new(self.written.place(spot), kind));
    }

    /// Takes over a mistake that was found elsewhere.
    pub(crate) fn keep(&mut self, error: SceneError) {
        self.found.push(error);
    }

    /// The result, if nothing is wrong.
    pub(crate) fn finish<T>(self, result: Option<T>) -> Result<T, SceneErrors> {
        match result {
            Some(result) if self.found.is_empty() => Ok(result),
            _ => Err(SceneErrors::new(self.found)),
        }
    }
}

/// Integers beyond this size are not all numbers of double precision.
const LARGEST_EXACT_INTEGER: u64 = 1 << 53;

/// A value with its key, and what it may be.
#[derive(Clone)]
pub(crate) struct Field<'w> {
    pub(crate) key: String,
    pub(crate) node: &'w Node,
    takes: &'static Takes,
}

impl<'w> Field<'w> {
    pub(crate) fn report(&self, kind: SceneErrorKind, problems: &mut Problems<'_>) {
        problems.report(&self.node.spot, kind);
    }

    /// Reports that the value is not what is allowed.
    pub(crate) fn refuse<T>(&self, allowed: &str, problems: &mut Problems<'_>) -> Option<T> {
        let kind = SceneErrorKind::WrongValue {
            key: self.key.clone(),
            allowed: allowed.to_owned(),
            found: self.node.value.to_string(),
        };
        self.report(kind, problems);
        None
    }

    /// What `choose` takes of what the value may be.
    pub(crate) fn declared<T>(&self, choose: impl FnMut(&'static Takes) -> Option<T>) -> Option<T> {
        self.takes.alternatives().iter().find_map(choose)
    }

    /// A number of the declared range.
    pub(crate) fn number(&self, problems: &mut Problems<'_>) -> Option<f64> {
        let range = self.declared(|takes| match takes {
            Takes::Number(range) | Takes::Formula(_, range) => Some(range),
            _ => None,
        });
        self.number_within(range.unwrap_or(&FINITE), problems)
    }

    /// A number of a range that depends on other keys.
    pub(crate) fn number_within(&self, range: &Range, problems: &mut Problems<'_>) -> Option<f64> {
        let value = match self.node.value {
            Value::Float(value) => value,
            Value::Integer(value) if value.unsigned_abs() <= LARGEST_EXACT_INTEGER => value as f64,
            Value::Integer(_) | Value::Oversized(_) => {
                return self.refuse(
                    "at most 2^53 in size if written without a decimal point",
                    problems,
                );
            }
            _ => return self.refuse(range.words, problems),
        };
        match range.contains(value) {
            true => Some(value),
            false => self.refuse(range.words, problems),
        }
    }

    /// A whole number of the declared range.
    pub(crate) fn whole(&self, problems: &mut Problems<'_>) -> Option<usize> {
        let range = self.declared(|takes| match takes {
            Takes::Whole(least, most) => Some((*least, *most)),
            _ => None,
        });
        let (least, most) = range.unwrap_or((0, usize::MAX));
        self.whole_within(least, most, problems)
    }

    /// A whole number from `least` to `most`, which depend on other keys.
    pub(crate) fn whole_within(
        &self,
        least: usize,
        most: usize,
        problems: &mut Problems<'_>,
    ) -> Option<usize> {
        match &self.node.value {
            Value::Integer(value) => usize::try_from(*value)
                .ok()
                .filter(|value| (least..=most).contains(value))
                .or_else(|| self.refuse(&whole_range(least, most), problems)),
            Value::Oversized(_) => self.refuse(&whole_range(least, most), problems),
            _ => self.refuse("a whole number", problems),
        }
    }

    pub(crate) fn text(&self, problems: &mut Problems<'_>) -> Option<&'w str> {
        self.peek_text()
            .or_else(|| self.refuse("a text in quotes", problems))
    }

    pub(crate) fn flag(&self, problems: &mut Problems<'_>) -> Option<bool> {
        match self.node.value {
            Value::Flag(flag) => Some(flag),
            _ => self.refuse("true or false", problems),
        }
    }

    /// The text, if it is one; nothing is reported.
    pub(crate) fn peek_text(&self) -> Option<&'w str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// A text with at least one letter.
    pub(crate) fn filled_text(&self, problems: &mut Problems<'_>) -> Option<String> {
        match self.text(problems)? {
            "" => self.refuse("a text that is not empty", problems),
            text => Some(text.to_owned()),
        }
    }

    /// One or more texts in a list.
    pub(crate) fn texts(&self, problems: &mut Problems<'_>) -> Option<Vec<Field<'w>>> {
        let fields = self.items(problems)?;
        let all_text = fields.iter().all(|field| field.peek_text().is_some());
        if fields.is_empty() || !all_text {
            return self.refuse(&self.list().1, problems);
        }
        Some(fields)
    }

    /// All numbers of a list, each of the declared range.
    pub(crate) fn numbers(&self, problems: &mut Problems<'_>) -> Option<Vec<f64>> {
        collect(&self.items(problems)?, |item| item.number(problems))
    }

    /// The choice that a text stands for.
    pub(crate) fn choice<T: Copy>(
        &self,
        choices: &[(&str, T)],
        problems: &mut Problems<'_>,
    ) -> Option<T> {
        let text = self.text(problems)?;
        if let Some((_, choice)) = choices.iter().find(|(word, _)| *word == text) {
            return Some(*choice);
        }
        let words: Vec<&str> = choices.iter().map(|(word, _)| *word).collect();
        let kind = SceneErrorKind::UnknownChoice {
            key: self.key.clone(),
            found: text.to_owned(),
            nearest: nearest(text, words.iter().copied()),
            allowed: Names::from(words.as_slice()),
        };
        self.report(kind, problems);
        None
    }

    /// A name of letters, digits, `_` and `-`.
    pub(crate) fn name(&self, problems: &mut Problems<'_>) -> Option<&'w str> {
        let name = self.text(problems)?;
        if is_name(name) {
            return Some(name);
        }
        let kind = SceneErrorKind::InvalidName {
            key: self.key.clone(),
            name: name.to_owned(),
        };
        self.report(kind, problems);
        None
    }

    pub(crate) fn items(&self, problems: &mut Problems<'_>) -> Option<Vec<Field<'w>>> {
        let (takes, words) = self.list();
        let Value::List(items) = &self.node.value else {
            return self.refuse(&words, problems);
        };
        let field = |(i, node)| Field {
            key: format!("{}[{i}]", self.key),
            node,
            takes,
        };
        Some(items.iter().enumerate().map(field).collect())
    }

    /// What the items of a list may be, and what messages call the list.
    pub(crate) fn list(&self) -> (&'static Takes, String) {
        let list = self.declared(|takes| match takes {
            Takes::List(item, words) => Some((*item, (*words).to_owned())),
            _ => None,
        });
        list.unwrap_or_else(|| (&Takes::Any, format!("tables headed [[{}]]", self.key)))
    }

    pub(crate) fn section(&self, problems: &mut Problems<'_>) -> Option<Section<'w>> {
        match &self.node.value {
            Value::Table(table) => Some(Section {
                key: self.key.clone(),
                spot: &self.node.spot,
                table,
            }),
            _ => self.refuse("a table", problems),
        }
    }
}

/// Whether a text is one or more letters, digits, `_` and `-`.
pub(crate) fn is_name(text: &str) -> bool {
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    !text.is_empty() && text.chars().all(allowed)
}

fn whole_range(least: usize, most: usize) -> String {
    match (least, most) {
        (least, usize::MAX) => format!("a whole number, {least} or greater"),
        (least, most) if least == most => format!("{least}"),
        (least, most) => format!("a whole number from {least} to {most}"),
    }
}

/// All or nothing, but every element is read.
pub(crate) fn collect<S, T>(items: &[S], read: impl FnMut(&S) -> Option<T>) -> Option<Vec<T>> {
    let read: Vec<Option<T>> = items.iter().map(read).collect();
    read.into_iter().collect()
}

/// The choice that a text stands for; the first one where it is absent.
pub(crate) fn choice<T: Copy>(
    field: Option<Field<'_>>,
    choices: &[(&str, T)],
    problems: &mut Problems<'_>,
) -> Option<T> {
    match field {
        Some(field) => field.choice(choices, problems),
        None => choices.first().map(|(_, choice)| *choice),
    }
}

/// Absent is `Some(None)`; `None` is a mistake that has been reported.
pub(crate) fn given<'w, T>(
    field: Option<Field<'w>>,
    read: impl FnOnce(&Field<'w>) -> Option<T>,
) -> Option<Option<T>> {
    field.map_or(Some(None), |field| read(&field).map(Some))
}

/// A table with its key.
#[derive(Clone)]
pub(crate) struct Section<'w> {
    pub(crate) key: String,
    pub(crate) spot: &'w Spot,
    pub(crate) table: &'w Table,
}

impl<'w> Section<'w> {
    /// The whole file.
    pub(crate) fn root(written: &'w Written) -> Option<Self> {
        let Value::Table(table) = &written.root.value else {
            return None;
        };
        Some(Self {
            key: String::new(),
            spot: &written.root.spot,
            table,
        })
    }

    pub(crate) fn key_of(&self, key: &str) -> String {
        if self.key.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.key)
        }
    }

    /// The fields of a table that has these keys only; the others are reported, and those that must be there and are not.
    pub(crate) fn read<const N: usize>(
        &self,
        keys: &'static [Key; N],
        problems: &mut Problems<'_>,
    ) -> [Option<Field<'w>>; N] {
        self.allow_only(keys, problems);
        self.fields(keys, problems)
    }

    /// The same of a table that has others as well.
    pub(crate) fn fields<const N: usize>(
        &self,
        keys: &'static [Key; N],
        problems: &mut Problems<'_>,
    ) -> [Option<Field<'w>>; N] {
        keys.each_ref().map(|key| match key.default {
            Default::None => self.require(key, problems),
            _ => self.get(key),
        })
    }

    pub(crate) fn get(&self, key: &'static Key) -> Option<Field<'w>> {
        Some(Field {
            takes: &key.takes,
            ..self.find(key.name)?
        })
    }

    /// A value whatever it may be.
    pub(crate) fn find(&self, key: &str) -> Option<Field<'w>> {
        self.table.get(key).map(|entry| self.field(key, entry))
    }

    /// All entries of a table whose keys the scene's author chooses.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (&'w str, Field<'w>)> {
        self.table
            .iter()
            .map(|(key, entry)| (key.as_str(), self.field(key, entry)))
    }

    pub(crate) fn field(&self, key: &str, entry: &'w Entry) -> Field<'w> {
        Field {
            key: self.key_of(key),
            node: &entry.node,
            takes: &Takes::Any,
        }
    }

    /// A field that must be there.
    pub(crate) fn require(
        &self,
        key: &'static Key,
        problems: &mut Problems<'_>,
    ) -> Option<Field<'w>> {
        let field = self.get(key);
        if field.is_none() {
            let kind = SceneErrorKind::MissingKey {
                key: key.name,
                section: self.title(problems),
                example: key.example,
            };
            problems.report(self.spot, kind);
        }
        field
    }

    /// Reports every key that is not among the allowed ones.
    pub(crate) fn allow_only(&self, allowed: &[Key], problems: &mut Problems<'_>) {
        for (key, entry) in self.table {
            if allowed.iter().all(|own| own.name != key) {
                self.report_unknown_key(key, entry, allowed, problems);
            }
        }
    }

    pub(crate) fn report_unknown_key(
        &self,
        key: &str,
        entry: &Entry,
        allowed: &[Key],
        problems: &mut Problems<'_>,
    ) {
        let names: Vec<&str> = allowed.iter().map(|own| own.name).collect();
        let kind = SceneErrorKind::UnknownKey {
            key: key.to_owned(),
            section: self.title(problems),
            allowed: Names::from(names.as_slice()),
            nearest: nearest(key, names),
        };
        problems.report(&entry.key_spot, kind);
    }

    pub(crate) fn report_invalid_key(&self, key: &str, entry: &Entry, problems: &mut Problems<'_>) {
        let kind = SceneErrorKind::InvalidKey {
            section: self.title(problems),
            key: key.to_owned(),
        };
        problems.report(&entry.key_spot, kind);
    }

    fn title(&self, problems: &Problems<'_>) -> String {
        if self.key.is_empty() {
            problems.written.document.to_owned()
        } else {
            self.key.clone()
        }
    }
}
