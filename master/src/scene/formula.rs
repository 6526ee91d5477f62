//! Numbers that may be given as a multiple of the macro step, such as `"2H"` or `"0.5 H^2"`.

use std::fmt;

use serde::{Serialize, Serializer};

use super::error_kind::SceneErrorKind;
use super::reader::{Field, NOT_NEGATIVE, POSITIVE, Problems};
use super::written::Value;

/// The power of H that fits the unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    /// A number without unit: no multiple of H.
    Plain,
    /// s: multiples of H.
    Time,
    /// s^2: multiples of H^2.
    TimeSquared,
}

impl Unit {
    fn symbol(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Time => "H",
            Self::TimeSquared => "H^2",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Plain => "a number",
            Self::Time => "a number, or a multiple of the macro step such as \"2H\"",
            Self::TimeSquared => {
                "a number, or a multiple of the squared macro step such as \"0.5 H^2\""
            }
        }
    }
}

/// The macro steps that a formula is taken for, in s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Steps {
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
    pub(super) const ZERO: Self = Self::multiple(0.0, Unit::Plain);

    pub(crate) const fn multiple(factor: f64, unit: Unit) -> Self {
        Self { factor, unit }
    }

    /// Reads a number or a multiple of H; it must not be negative.
    pub(super) fn read(field: &Field<'_>, unit: Unit, problems: &mut Problems<'_>) -> Option<Self> {
        let Value::Text(text) = &field.node.value else {
            if is_number(&field.node.value) {
                let value = field.number(&NOT_NEGATIVE, problems)?;
                return Some(Self::multiple(value, Unit::Plain));
            }
            return field.wrong_type(unit.words(), problems);
        };
        match parse_factor(text, unit) {
            Some(factor) if factor >= 0.0 => Some(Self::multiple(factor, unit)),
            Some(_) => field.out_of_range(NOT_NEGATIVE.words, problems),
            None => field.wrong_type(unit.words(), problems),
        }
    }

    /// Like [`Formula::read`], but zero is out of range.
    pub(super) fn read_positive(
        field: &Field<'_>,
        unit: Unit,
        problems: &mut Problems<'_>,
    ) -> Option<Self> {
        let formula = Self::read(field, unit, problems)?;
        if formula.is_zero() {
            return field.out_of_range(POSITIVE.words, problems);
        }
        Some(formula)
    }

    pub(super) fn unit(self) -> Unit {
        self.unit
    }

    pub(super) fn is_zero(self) -> bool {
        self.factor == 0.0
    }

    /// The number itself, of a formula that is no multiple of H.
    pub(super) fn number(self) -> f64 {
        self.factor
    }

    /// Whether it is a multiple of the macro step.
    pub fn follows_steps(self) -> bool {
        self.unit != Unit::Plain
    }

    /// The value for a macro step in s.
    pub fn at(self, macro_step: f64) -> f64 {
        match self.unit {
            Unit::Plain => self.factor,
            Unit::Time => self.factor * macro_step,
            Unit::TimeSquared => self.factor * macro_step * macro_step,
        }
    }

    /// What stands in the resolved scene: the formula where the macro step varies within `steps`, else its number; in neither
    /// case may a value over- or underflow.
    pub(super) fn over(self, steps: Steps, key: &str) -> Result<Self, SceneErrorKind> {
        match steps {
            Steps::Fixed(macro_step) => self.checked_at(macro_step, key).map(Self::from),
            Steps::Between(least, greatest) => {
                self.checked_at(least, key)?;
                self.checked_at(greatest, key)?;
                Ok(self)
            }
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
            Unit::Time | Unit::TimeSquared => {
                serializer.collect_str(&format_args!("{:?} {}", self.factor, self.unit.symbol()))
            }
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
