//! Kinds of joints: each gives coupling conditions and loads; the rest of the master sees rows only.

mod atpoint;
mod rigid_link;

pub use atpoint::AtPoint;
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

/// Most components of a marker's motion that a joint may read on one level.
pub const MOST_COMPONENTS: usize = 7;

/// Motion of a joint's two markers: `[end][level][component]`, with the components that the joint reads. Levels that
/// were not asked for are not read.
pub type Motion = [[[f64; MOST_COMPONENTS]; 3]; 2];

/// Largest value on one level of the two markers: the size of the motion.
pub fn extent(motion: &Motion, level: Level) -> f64 {
    let values = motion.iter().flat_map(|end| end[level as usize]);
    values.map(f64::abs).fold(0.0, f64::max)
}

/// The law of a joint: its conditions on every level, one for each row, and the loads of their multipliers.
pub trait Joint: Send + Sync {
    /// Names of the rows in result columns; a joint with a single row has the empty name.
    fn rows(&self) -> &'static [&'static str];

    /// The components of the markers' motion that the conditions read, as places in the lists of
    /// [`Marker`](linchpin_proto::v1::Marker).
    fn reads(&self) -> &'static [usize];

    /// `g`, `g'` or `g''` of one row from the motion of the two markers.
    fn condition(&self, row: usize, level: Level, motion: &Motion) -> f64;

    /// Derivative of [`Joint::condition`] with respect to `motion[end][of][component]`.
    fn gradient(
        &self,
        row: usize,
        level: Level,
        motion: &Motion,
        end: End,
        of: Level,
        component: usize,
    ) -> f64;

    /// The components of the load on the markers, as places in [`Marker::load`](linchpin_proto::v1::Marker::load).
    fn loads(&self) -> &'static [usize];

    /// Load on the marker at `end`, component number `component` of [`Joint::loads`], for a multiplier of 1 in `row`.
    fn load(&self, row: usize, end: End, component: usize) -> f64;
}

#[cfg(test)]
mod tests;
