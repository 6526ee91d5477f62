//! Kinds of joints: each gives coupling conditions and loads; the rest of the master sees rows only.

mod rigid_link;

pub use rigid_link::RigidLink;

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

    /// As it stands in the names of result columns.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }
}

/// One of the two bodies of a joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The first body; the multiplier acts on it in its own direction.
    A,
    /// The second body; the multiplier acts on it in the opposite direction.
    B,
}

impl End {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];
}

/// Motion of a joint's two markers: `[end][level]`. Levels that were not asked for are not read.
pub type Motion = [[f64; 3]; 2];

/// Largest position of the two markers: the size of the motion.
pub fn extent(motion: &Motion) -> f64 {
    motion.iter().map(|end| end[0].abs()).fold(0.0, f64::max)
}

/// The law of a joint with one row: its condition on every level, and the load of its multiplier.
pub trait Joint: Send + Sync {
    /// `g`, `g'` or `g''` from the motion of the two markers.
    fn condition(&self, level: Level, motion: &Motion) -> f64;

    /// Derivative of [`Joint::condition`] with respect to `motion[end][of]`.
    fn gradient(&self, level: Level, motion: &Motion, end: End, of: Level) -> f64;

    /// Force on the marker at `end` for a multiplier of 1.
    fn load(&self, end: End) -> f64;
}
