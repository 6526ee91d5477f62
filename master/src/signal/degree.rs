//! Degrees of polynomials.

use std::fmt;

use serde::{Serialize, Serializer};

use super::MAX_DEGREE;

/// Degree of the Lagrange polynomials of coupling variables.
///
/// Serialises as the number, or as `"automatic"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degree {
    /// The same on all macro steps.
    Fixed(usize),
    /// On every macro step the one from 0 to [`MAX_DEGREE`] that the estimates favour, as far as the method is stable for it.
    Automatic,
}

impl Degree {
    /// The highest degree that a step may have.
    pub fn highest(self) -> usize {
        match self {
            Self::Fixed(degree) => degree,
            Self::Automatic => MAX_DEGREE,
        }
    }

    /// The degree, if it does not change.
    pub fn fixed(self) -> Option<usize> {
        match self {
            Self::Fixed(degree) => Some(degree),
            Self::Automatic => None,
        }
    }
}

impl Serialize for Degree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(degree) => serializer.serialize_u64(*degree as u64),
            Self::Automatic => serializer.serialize_str(AUTOMATIC_DEGREE),
        }
    }
}

impl fmt::Display for Degree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(degree) => degree.fmt(f),
            Self::Automatic => write!(f, "{AUTOMATIC_DEGREE:?}"),
        }
    }
}

/// A degree that follows the estimates, in a scene.
pub(crate) const AUTOMATIC_DEGREE: &str = "automatic";
