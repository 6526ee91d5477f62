//! Parameters of nonsmooth models: numbers with defaults, and texts that may be left out.

use std::collections::BTreeMap;

use linchpin_proto::v1;
use linchpin_worker::setup::{SetupError, Values};

use crate::mechanics::describe::{needed, optional};

/// One parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Key {
    /// Name.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// What it is and what is allowed.
    pub what: &'static str,
    /// What a scene may give.
    pub value: KeyValue,
}

/// Type and default of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeyValue {
    /// A number with its default.
    Number(f64),
    /// One of these texts, by default the first.
    Text(&'static [&'static str]),
    /// A number that may be left out.
    Absent,
}

/// A number with a default.
pub const fn number(
    name: &'static str,
    unit: &'static str,
    default: f64,
    what: &'static str,
) -> Key {
    Key {
        name,
        unit,
        what,
        value: KeyValue::Number(default),
    }
}

/// A number that may be left out.
pub const fn absent(name: &'static str, unit: &'static str, what: &'static str) -> Key {
    Key {
        name,
        unit,
        what,
        value: KeyValue::Absent,
    }
}

/// A text.
pub const fn text(name: &'static str, known: &'static [&'static str], what: &'static str) -> Key {
    Key {
        name,
        unit: "",
        what,
        value: KeyValue::Text(known),
    }
}

/// The parameters of a model with what a scene gives for them.
#[derive(Debug, Clone, Copy)]
pub struct Parameters<'a> {
    keys: &'a [Key],
    given: &'a BTreeMap<String, v1::Value>,
}

impl<'a> Parameters<'a> {
    /// Checks the names.
    ///
    /// # Errors
    /// [`SetupError::Unknown`].
    pub fn new(
        keys: &'a [Key],
        given: &'a BTreeMap<String, v1::Value>,
    ) -> Result<Self, SetupError> {
        let unknown = given
            .keys()
            .find(|name| !keys.iter().any(|key| key.name == **name));
        if let Some(name) = unknown {
            let known: Vec<&str> = keys.iter().map(|key| key.name).collect();
            return Err(SetupError::Unknown {
                field: format!("parameters.{name}"),
                known: known.join(", "),
            });
        }
        Ok(Self { keys, given })
    }

    /// As a master is told: without what may be left out and is.
    pub fn described(&self) -> Vec<v1::Parameter> {
        let described = |key: &Key| match key.value {
            KeyValue::Number(default) => Some(optional(key.name, key.unit, key.what, default)),
            KeyValue::Text(_) | KeyValue::Absent => self
                .given
                .contains_key(key.name)
                .then(|| needed(key.name, key.unit, key.what)),
        };
        self.keys.iter().filter_map(described).collect()
    }

    fn key(&self, name: &str) -> Option<&'a Key> {
        self.keys.iter().find(|key| key.name == name)
    }

    /// Whether a scene gives it.
    pub fn has(&self, name: &str) -> bool {
        self.given.contains_key(name)
    }

    /// A number in a range.
    ///
    /// # Errors
    /// [`SetupError`].
    pub fn number_in(
        &self,
        name: &str,
        allowed: &'static str,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<f64, SetupError> {
        if let (false, Some(KeyValue::Number(default))) =
            (self.has(name), self.key(name).map(|key| key.value))
        {
            return Ok(default);
        }
        Values::parameters(self.given).number_in(name, allowed, is_allowed)
    }

    /// Any finite number.
    ///
    /// # Errors
    /// As [`Parameters::number_in`].
    pub fn number(&self, name: &str) -> Result<f64, SetupError> {
        self.number_in(name, "it must be a finite number", f64::is_finite)
    }

    /// A number greater than 0.
    ///
    /// # Errors
    /// As [`Parameters::number_in`].
    pub fn positive(&self, name: &str) -> Result<f64, SetupError> {
        self.number_in(name, "it must be greater than 0", |value| value > 0.0)
    }

    /// A number that is 0 or greater.
    ///
    /// # Errors
    /// As [`Parameters::number_in`].
    pub fn non_negative(&self, name: &str) -> Result<f64, SetupError> {
        self.number_in(name, "it must be 0 or greater", |value| value >= 0.0)
    }

    /// A coefficient of restitution.
    ///
    /// # Errors
    /// As [`Parameters::number_in`].
    pub fn restitution(&self, name: &str) -> Result<f64, SetupError> {
        self.number_in(name, "it must be 0 to 1", |value| {
            (0.0..=1.0).contains(&value)
        })
    }

    /// A whole number from `least` to 10,000.
    ///
    /// # Errors
    /// As [`Parameters::number_in`].
    pub fn count(
        &self,
        name: &str,
        allowed: &'static str,
        least: usize,
    ) -> Result<usize, SetupError> {
        let is_allowed = |value: f64| value.fract() == 0.0 && (least as f64..=1e4).contains(&value);
        Ok(self.number_in(name, allowed, is_allowed)? as usize)
    }

    /// Which of its texts.
    ///
    /// # Errors
    /// [`SetupError`] if it is none of them.
    pub fn choice(&self, name: &str) -> Result<&'a str, SetupError> {
        let Some(KeyValue::Text(known)) = self.key(name).map(|key| key.value) else {
            return Err(SetupError::Missing {
                field: format!("parameters.{name}"),
            });
        };
        if self.has(name) {
            Values::parameters(self.given).one_of(name, known)
        } else {
            Ok(known[0])
        }
    }
}

/// A parameter that does not fit the others.
pub fn refused(name: &str, reason: impl ToString) -> SetupError {
    SetupError::Refused {
        field: format!("parameters.{name}"),
        reason: reason.to_string(),
    }
}
