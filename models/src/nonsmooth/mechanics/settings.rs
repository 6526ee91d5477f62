//! How steps are taken.

use crate::nonsmooth::contact::{self, ContactSettings};

/// On which level closed contacts are held during the non-impulsive part of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// `g' = 0` at the end of the step: what S2 develops. Gaps drift by what one step leaves.
    Velocity,
    /// `g'' = 0` at the end of the step: for comparison (S2 Figs. 17, 18). Velocities drift.
    Acceleration,
}

/// How steps are taken, whatever the scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Level of the contacts.
    pub level: Level,
    /// Whether the accelerations at the start agree with closed contacts. Otherwise they are those without contacts, as
    /// printed in S2 eqs. (25), (62), (83); then a constraint drifts and its force oscillates.
    pub has_consistent_start: bool,
    /// Whether accelerations are found anew behind an impact. Otherwise those before it go on, as in S2; then the
    /// schemes that carry accelerations lose their order.
    pub restarts_after_impacts: bool,
    /// Whether a contact that presses stays closed even if its gap drifted above 0. Otherwise it opens then, as S2 eq.
    /// (41) has it, and closes again with an impact; that happens where directions of contacts turn, as in rolling and
    /// rocking. Moreau's rule always looks at the gap alone.
    pub holds_pressed_contacts: bool,
    /// The iteration of a step ends when velocities change by less than this share of their size.
    pub tolerance: f64,
    /// Iterations of a step at most.
    pub most_iterations: usize,
    /// How contact problems are solved.
    pub contact: ContactSettings,
}

/// The defaults of [`Settings`].
pub const DEFAULT: Settings = Settings {
    level: Level::Velocity,
    has_consistent_start: true,
    restarts_after_impacts: true,
    holds_pressed_contacts: true,
    tolerance: 1e-12,
    most_iterations: 50,
    contact: contact::DEFAULT,
};

impl Default for Settings {
    fn default() -> Self {
        DEFAULT
    }
}
