//! Reads typed values from the tree of a written scene and collects what is wrong with them.

use super::error::{SceneError, SceneErrors};
use super::error_kind::{Names, SceneErrorKind};
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

/// Numbers that a key may have, and how to say so.
pub(crate) struct Range {
    pub(crate) words: &'static str,
    pub(crate) contains: fn(f64) -> bool,
}

pub(crate) const FINITE: Range = Range {
    words: "a finite number",
    contains: |_| true,
};
pub(crate) const POSITIVE: Range = Range {
    words: "a finite number greater than 0",
    contains: |value| value > 0.0,
};
pub(crate) const NOT_NEGATIVE: Range = Range {
    words: "a finite number, 0 or greater",
    contains: |value| value >= 0.0,
};

/// Integers beyond this size are not all numbers of double precision.
const LARGEST_EXACT_INTEGER: u64 = 1 << 53;

/// A value with its key.
#[derive(Clone)]
pub(crate) struct Field<'w> {
    pub(crate) key: String,
    pub(crate) node: &'w Node,
}

impl<'w> Field<'w> {
    pub(crate) fn report(&self, kind: SceneErrorKind, problems: &mut Problems<'_>) {
        problems.report(&self.node.spot, kind);
    }

    pub(crate) fn wrong_type<T>(
        &self,
        allowed: &'static str,
        problems: &mut Problems<'_>,
    ) -> Option<T> {
        let kind = SceneErrorKind::WrongType {
            key: self.key.clone(),
            allowed,
            found: self.node.value.to_string(),
        };
        self.report(kind, problems);
        None
    }

    pub(crate) fn out_of_range<T>(&self, allowed: &str, problems: &mut Problems<'_>) -> Option<T> {
        let kind = SceneErrorKind::OutOfRange {
            key: self.key.clone(),
            allowed: allowed.to_owned(),
            found: self.node.value.to_string(),
        };
        self.report(kind, problems);
        None
    }

    /// A finite number of the given range.
    pub(crate) fn number(&self, range: &Range, problems: &mut Problems<'_>) -> Option<f64> {
        let value = match self.node.value {
            Value::Float(value) => value,
            Value::Integer(value) if value.unsigned_abs() <= LARGEST_EXACT_INTEGER => value as f64,
            Value::Integer(_) | Value::Oversized(_) => {
                return self.out_of_range(
                    "at most 2^53 in size if written without a decimal point",
                    problems,
                );
            }
            _ => return self.wrong_type(range.words, problems),
        };
        if value.is_finite() && (range.contains)(value) {
            Some(value)
        } else {
            self.out_of_range(range.words, problems)
        }
    }

    /// A whole number from `least` to `most`.
    pub(crate) fn whole(
        &self,
        least: usize,
        most: usize,
        problems: &mut Problems<'_>,
    ) -> Option<usize> {
        match &self.node.value {
            Value::Integer(value) => usize::try_from(*value)
                .ok()
                .filter(|value| (least..=most).contains(value))
                .or_else(|| self.out_of_range(&whole_range(least, most), problems)),
            Value::Oversized(_) => self.out_of_range(&whole_range(least, most), problems),
            _ => self.wrong_type("a whole number", problems),
        }
    }

    pub(crate) fn text(&self, problems: &mut Problems<'_>) -> Option<&'w str> {
        self.peek_text()
            .or_else(|| self.wrong_type("a text in quotes", problems))
    }

    pub(crate) fn flag(&self, problems: &mut Problems<'_>) -> Option<bool> {
        match self.node.value {
            Value::Flag(flag) => Some(flag),
            _ => self.wrong_type("true or false", problems),
        }
    }

    /// The text, if it is one; nothing is reported.
    pub(crate) fn peek_text(&self) -> Option<&'w str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// One or more texts in a list.
    pub(crate) fn texts(
        &self,
        allowed: &'static str,
        problems: &mut Problems<'_>,
    ) -> Option<Vec<Field<'w>>> {
        let fields = self.items(allowed, problems)?;
        let all_text = fields
            .iter()
            .all(|field| matches!(field.node.value, Value::Text(_)));
        if fields.is_empty() || !all_text {
            return self.wrong_type(allowed, problems);
        }
        Some(fields)
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

    pub(crate) fn items(
        &self,
        allowed: &'static str,
        problems: &mut Problems<'_>,
    ) -> Option<Vec<Field<'w>>> {
        let Value::List(items) = &self.node.value else {
            return self.wrong_type(allowed, problems);
        };
        let field = |(i, node)| Field {
            key: format!("{}[{i}]", self.key),
            node,
        };
        Some(items.iter().enumerate().map(field).collect())
    }

    pub(crate) fn section(&self, problems: &mut Problems<'_>) -> Option<Section<'w>> {
        match &self.node.value {
            Value::Table(table) => Some(Section {
                key: self.key.clone(),
                spot: &self.node.spot,
                table,
            }),
            _ => self.wrong_type("a table", problems),
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

/// A table with its key.
#[derive(Clone)]
pub(crate) struct Section<'w> {
    pub(crate) key: String,
    pub(crate) spot: &'w Spot,
    pub(crate) table: &'w Table,
}

impl<'w> Section<'w> {
    /// The whole scene.
    pub(crate) fn root(written: &'w Written, table: &'w Table) -> Self {
        Self {
            key: String::new(),
            spot: &written.root.spot,
            table,
        }
    }

    pub(crate) fn key_of(&self, key: &str) -> String {
        if self.key.is_empty() {
            key.to_owned()
        } else {
            format!("{}.{key}", self.key)
        }
    }

    pub(crate) fn get(&self, key: &str) -> Option<Field<'w>> {
        self.table.get(key).map(|entry| self.field(key, entry))
    }

    /// All entries of a table whose keys the scene's author chooses.
    pub(crate) fn fields(&self) -> impl Iterator<Item = (&'w str, Field<'w>)> {
        self.table
            .iter()
            .map(|(key, entry)| (key.as_str(), self.field(key, entry)))
    }

    pub(crate) fn field(&self, key: &str, entry: &'w Entry) -> Field<'w> {
        Field {
            key: self.key_of(key),
            node: &entry.node,
        }
    }

    /// A field that must be there; `example` is a line that would do.
    pub(crate) fn require(
        &self,
        key: &'static str,
        example: &'static str,
        problems: &mut Problems<'_>,
    ) -> Option<Field<'w>> {
        let field = self.get(key);
        if field.is_none() {
            let kind = SceneErrorKind::MissingKey {
                key,
                section: self.title(problems),
                example,
            };
            problems.report(self.spot, kind);
        }
        field
    }

    /// Reports every key that is not among the allowed ones.
    pub(crate) fn allow_only(&self, allowed: &[&str], problems: &mut Problems<'_>) {
        for (key, entry) in self.table {
            if !allowed.contains(&key.as_str()) {
                self.report_unknown_key(key, entry, allowed, problems);
            }
        }
    }

    pub(crate) fn report_unknown_key(
        &self,
        key: &str,
        entry: &Entry,
        allowed: &[&str],
        problems: &mut Problems<'_>,
    ) {
        let kind = SceneErrorKind::UnknownKey {
            key: key.to_owned(),
            section: self.title(problems),
            allowed: Names::from(allowed),
            nearest: nearest(key, allowed.iter().copied()),
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
