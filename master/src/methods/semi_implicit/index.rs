//! The index of the coupled system.

use serde::Serialize;

use crate::joint::Level;

/// Index of the coupled system: which derivatives of the constraint are demanded.
///
/// Serialises as its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(into = "u8")]
pub enum Index {
    /// Position, velocity and acceleration: both parameters are greater than 0.
    One,
    /// Position and velocity: the second parameter is 0.
    Two,
    /// Position only: both parameters are 0.
    Three,
}

impl From<Index> for u8 {
    fn from(index: Index) -> Self {
        index.number()
    }
}

impl Index {
    /// 1, 2 or 3.
    pub fn number(self) -> u8 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

impl Index {
    /// Highest derivative that is demanded.
    pub(super) fn level(self) -> Level {
        match self {
            Self::Three => Level::Position,
            Self::Two => Level::Velocity,
            Self::One => Level::Acceleration,
        }
    }
}
