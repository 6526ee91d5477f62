//! What Hermite coupling demands of a macro step.

use serde::Serialize;

use crate::joint::Level;

/// What the multipliers of Hermite coupling are at the start `T_N` of a macro step. At its end `T_{N+1}` both variants demand g = 0 and
/// g' = 0, and of degree p > 2 that p - 2 moments of g over the step vanish.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Variant {
    /// g'' = 0 at `T_N`.
    Apv,
    /// Continuous at `T_N`.
    C0pv,
}

impl Variant {
    /// Whether `g'' = 0` at `T_N` determines the start value; otherwise it is the end value of the step before.
    pub fn starts_anew(self) -> bool {
        self == Self::Apv
    }

    /// Highest level that is read of the workers.
    pub fn level(self) -> Level {
        match self {
            Self::Apv => Level::Acceleration,
            Self::C0pv => Level::Velocity,
        }
    }
}

/// The curves over a macro step, and so the conditions that determine them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Family {
    /// What holds at the start of the step.
    pub variant: Variant,
    /// Degree p of the multipliers' polynomials.
    pub degree: usize,
    /// Whether connected signals have curves of their own; otherwise they are polynomials through past values.
    pub has_own_signals: bool,
}

/// The conditions of joints and of exchanged motion at `T_{N+1}`.
pub const ENDS: [Level; 2] = [Level::Position, Level::Velocity];

/// The degree at which there are as many unknowns as conditions at the ends of the step.
pub const LEAST_DEGREE: usize = 2;

/// The highest degree: that of exchanged motion is [`linchpin_proto::polynomial::MAX_NODES`] less 1.
pub const HIGHEST_DEGREE: usize = 5;

impl Family {
    /// Number of moments of a joint's condition, and of exchanged motion less its output, that vanish.
    pub fn moments_of_motion(self) -> usize {
        self.degree - LEAST_DEGREE
    }

    /// Number of moments of a connected signal less its output that vanish.
    pub fn moments_of_signals(self) -> usize {
        match self.has_own_signals {
            true => self.degree - 1,
            false => 0,
        }
    }

    /// Number of rates of exchanged motion at the start of the step that are known, its value included.
    pub fn known_at_start(self) -> usize {
        match self.variant.level() {
            Level::Acceleration => 3,
            Level::Position | Level::Velocity => 2,
        }
    }

    /// Degree of the polynomials of exchanged motion: position and velocity at both ends and the acceleration at the start if it is read,
    /// and one for each moment.
    pub fn motion_degree(self) -> usize {
        self.known_at_start() + ENDS.len() - 1 + self.moments_of_motion()
    }

    /// The nodes of a multiplier whose values are unknown, as shares of the step.
    pub fn shares(self) -> Vec<f64> {
        let first = if self.variant.starts_anew() { 0 } else { 1 };
        let share = |node: usize| node as f64 / self.degree as f64;
        (first..=self.degree).map(share).collect()
    }
}
