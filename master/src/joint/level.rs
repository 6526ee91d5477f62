//! Levels of the coupling conditions.

/// Time derivative of a coupling condition: `g`, `g'` or `g''`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// `g`
    Position,
    /// `dg/dt`
    Velocity,
    /// `d^2 g/dt^2`
    Acceleration,
}

impl Level {
    /// All levels, lowest first.
    pub const ALL: [Self; 3] = [Self::Position, Self::Velocity, Self::Acceleration];

    /// This level and those below it.
    pub fn up_to(self) -> &'static [Self] {
        &Self::ALL[..=self as usize]
    }

    /// `value` of this level and those below it, 0 above.
    pub(super) fn each_up_to(self, value: impl Fn(Self) -> f64) -> [f64; 3] {
        Self::ALL.map(|level| if level <= self { value(level) } else { 0.0 })
    }

    /// As it stands in the names of result columns.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }
}
