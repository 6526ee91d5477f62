//! Values by name, read by their type.

use std::collections::BTreeMap;

use linchpin_proto::v1::{self, value::Kind};

use super::SetupError;

/// The values of one table of a scene's subsystem.
#[derive(Debug, Clone, Copy)]
pub struct Values<'a> {
    table: &'static str,
    values: &'a BTreeMap<String, v1::Value>,
}

impl<'a> Values<'a> {
    /// The parameters of a request, for [`Model::describe_with`](crate::Model::describe_with).
    pub fn parameters(values: &'a BTreeMap<String, v1::Value>) -> Self {
        Self {
            table: "parameters",
            values,
        }
    }

    pub(super) fn options(values: &'a BTreeMap<String, v1::Value>) -> Self {
        Self {
            table: "solver",
            values,
        }
    }

    /// A finite number.
    ///
    /// # Errors
    /// [`SetupError`] if it is missing, of another type or not finite.
    pub fn number(&self, name: &str) -> Result<f64, SetupError> {
        match self.kind(name)? {
            Some(Kind::Number(value)) => finite(self.field(name), *value),
            _ => Err(self.wrong_type(name, "a number")),
        }
    }

    /// A number in a range that is told to the user by `allowed`.
    ///
    /// # Errors
    /// As [`Values::number`], and if it is out of its range.
    pub fn number_in(
        &self,
        name: &str,
        allowed: &'static str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<f64, SetupError> {
        let value = self.number(name)?;
        if is_allowed(value) {
            return Ok(value);
        }
        Err(SetupError::OutOfRange {
            field: self.field(name),
            value,
            allowed,
        })
    }

    /// A text.
    ///
    /// # Errors
    /// [`SetupError`] if it is missing or of another type.
    pub fn text(&self, name: &str) -> Result<&'a str, SetupError> {
        match self.kind(name)? {
            Some(Kind::Text(text)) => Ok(text),
            _ => Err(self.wrong_type(name, "a text")),
        }
    }

    /// A text that is one of `known`.
    ///
    /// # Errors
    /// As [`Values::text`], and if it is none of them.
    pub fn one_of(&self, name: &str, known: &[&str]) -> Result<&'a str, SetupError> {
        let text = self.text(name)?;
        if known.contains(&text) {
            return Ok(text);
        }
        Err(SetupError::UnknownText {
            field: self.field(name),
            value: text.to_owned(),
            known: known.join(", "),
        })
    }

    /// A list of finite numbers, of any length.
    ///
    /// # Errors
    /// [`SetupError`] if it is missing, of another type or has an entry that is not finite.
    pub fn numbers(&self, name: &str) -> Result<&'a [f64], SetupError> {
        let Some(Kind::Numbers(list)) = self.kind(name)? else {
            return Err(self.wrong_type(name, "a list of numbers"));
        };
        for (place, &value) in list.values.iter().enumerate() {
            finite(format!("{}[{place}]", self.field(name)), value)?;
        }
        Ok(&list.values)
    }

    fn kind(&self, name: &str) -> Result<Option<&'a Kind>, SetupError> {
        let value = self.values.get(name);
        let value = value.ok_or_else(|| SetupError::Missing {
            field: self.field(name),
        })?;
        Ok(value.kind.as_ref())
    }

    fn wrong_type(&self, name: &str, expected: &'static str) -> SetupError {
        SetupError::WrongType {
            field: self.field(name),
            expected,
        }
    }

    fn field(&self, name: &str) -> String {
        format!("{}.{name}", self.table)
    }
}

/// The value of a field, if it is finite.
pub(super) fn finite(field: String, value: f64) -> Result<f64, SetupError> {
    if value.is_finite() {
        return Ok(value);
    }
    Err(SetupError::OutOfRange {
        field,
        value,
        allowed: "it must be a finite number",
    })
}
