//! What the variants of Hermite coupling demand.

use serde::Serialize;

use crate::joint::Level;

/// What the multipliers of Hermite coupling are on a macro step: their conditions at its start `T_N` and its end `T_{N+1}`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Variant {
    /// g'' = 0 at `T_N`; g = 0, g' = 0 at `T_{N+1}`: quadratic.
    Apv,
    /// Continuous at `T_N`; g = 0, g' = 0 at `T_{N+1}`: quadratic.
    C0pv,
}

impl Variant {
    /// Whether `g'' = 0` at `T_N` determines the start value; otherwise it is the end value of the step before.
    pub fn starts_anew(self) -> bool {
        self == Self::Apv
    }

    /// The conditions at `T_{N+1}`.
    pub fn ends(self) -> &'static [Level] {
        match self {
            Self::Apv | Self::C0pv => &[Level::Position, Level::Velocity],
        }
    }

    /// Highest level that is read of the workers.
    pub fn level(self) -> Level {
        match self {
            Self::Apv => Level::Acceleration,
            Self::C0pv => Level::Velocity,
        }
    }

    /// Degree of the multipliers' polynomials.
    pub fn degree(self) -> usize {
        self.ends().len()
    }

    /// Degree of the polynomials of exchanged motion: through position and velocity at both ends, and the acceleration at
    /// the start if it is read.
    pub fn motion_degree(self) -> usize {
        match self.level() {
            Level::Acceleration => 4,
            Level::Position | Level::Velocity => 3,
        }
    }

    /// The nodes of a multiplier whose values are unknown, as shares of the step.
    pub fn shares(self) -> Vec<f64> {
        let degree = self.degree();
        let first = if self.starts_anew() { 0 } else { 1 };
        let share = |node: usize| node as f64 / degree as f64;
        (first..=degree).map(share).collect()
    }
}
