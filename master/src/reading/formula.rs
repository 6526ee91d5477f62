//! Numbers that may be given as a multiple of the macro step, such as `"2H"` or `"0.5 H^2"`, or of its inverse, such as `"2.5/H^2"`.

use std::fmt;

use serde::{Serialize, Serializer};

use super::error_kind::SceneErrorKind;
use super::key::{NOT_NEGATIVE, Takes, Unit};
use super::reader::{Field, Problems};
use super::written::Value;

/// The macro steps that a formula is taken for, in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Steps {
    /// One for the whole run.
    Fixed(f64),
    /// They vary between the least and the greatest.
    Between(f64, f64),
}

/// A finite number, 0 or greater, times a power of the macro step.
///
/// Serialises as the number, or as text such as `"2.0 H"`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formula {
    factor: f64,
    unit: Unit,
}

impl Formula {
    pub(crate) const ZERO: Self = Self::multiple(0.0, Unit::Plain);

    pub(crate) const fn multiple(factor: f64, unit: Unit) -> Self {
        Self { factor, unit }
    }

    /// Reads a number or a multiple of H of the declared unit and range.
    pub(crate) fn read(field: &Field<'_>, problems: &mut Problems<'_>) -> Option<Self> {
        let declared = field.declared(|takes| match takes {
            Takes::Formula(unit, range) => Some((*unit, range)),
            _ => None,
        });
        let (unit, range) = declared.unwrap_or((Unit::Plain, &NOT_NEGATIVE));
        let Value::Text(text) = &field.node.value else {
            if is_number(&field.node.value) {
                let value = field.number(problems)?;
                return Some(Self::multiple(value, Unit::Plain));
            }
            return field.refuse(unit.words(), problems);
        };
        match parse_factor(text, unit) {
            Some(factor) if range.contains(factor) => Some(Self::multiple(factor, unit)),
            Some(_) => field.refuse(range.words, problems),
            None => field.refuse(unit.words(), problems),
        }
    }

    pub(crate) fn is_zero(self) -> bool {
        self.factor == 0.0
    }

    /// The number itself, of a formula that is no multiple of H.
    pub(crate) fn number(self) -> f64 {
        self.factor
    }

    /// The value for a macro step in s.
    pub fn at(self, macro_step: f64) -> f64 {
        match self.unit {
            Unit::Plain => self.factor,
            Unit::Time => self.factor * macro_step,
            Unit::TimeSquared => self.factor * macro_step * macro_step,
            Unit::PerTime => self.factor / macro_step,
            Unit::PerTimeSquared => self.factor / (macro_step * macro_step),
        }
    }

    /// What stands in the resolved scene: the formula where the macro step varies within `steps`, else its number; in neither
    /// case may a value over- or underflow.
    pub(crate) fn over(self, steps: Steps, key: &str) -> Result<Self, SceneErrorKind> {
        match steps {
            Steps::Fixed(macro_step) => self.checked_at(macro_step, key).map(Self::from),
            Steps::Between(least, greatest) => {
                self.checked_at(least, key)?;
                self.checked_at(greatest, key)?;
                Ok(self)
            }
        }
    }

    /// The number that it is for the macro step of the whole run; methods whose parameters are numbers refuse steps that vary.
    pub(crate) fn fixed(self, steps: Steps, key: &str) -> Result<f64, SceneErrorKind> {
        match steps {
            Steps::Fixed(macro_step) => self.checked_at(macro_step, key),
            Steps::Between(..) => Ok(self.factor),
        }
    }

    fn checked_at(self, macro_step: f64, key: &str) -> Result<f64, SceneErrorKind> {
        let value = self.at(macro_step);
        if value.is_finite() && (value > 0.0 || self.is_zero()) {
            return Ok(value);
        }
        Err(SceneErrorKind::FormulaOutOfRange {
            key: key.to_owned(),
            formula: self.to_string(),
            value,
            macro_step,
        })
    }
}

impl From<f64> for Formula {
    fn from(number: f64) -> Self {
        Self::multiple(number, Unit::Plain)
    }
}

impl Serialize for Formula {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.unit {
            Unit::Plain => serializer.serialize_f64(self.factor),
            _ => serializer.collect_str(&format_args!("{:?} {}", self.factor, self.unit.symbol())),
        }
    }
}

impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            Unit::Plain => write!(f, "{:?}", self.factor),
            _ => write!(f, "\"{:?} {}\"", self.factor, self.unit.symbol()),
        }
    }
}

fn is_number(value: &Value) -> bool {
    matches!(
        value,
        Value::Integer(_) | Value::Float(_) | Value::Oversized(_)
    )
}

fn parse_factor(text: &str, unit: Unit) -> Option<f64> {
    if unit == Unit::Plain {
        return None;
    }
    let factor = text.trim().strip_suffix(unit.symbol())?.trim_end();
    if factor.is_empty() {
        return Some(1.0);
    }
    factor
        .parse()
        .ok()
        .filter(|factor: &f64| factor.is_finite())
}
