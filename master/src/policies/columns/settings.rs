//! The constants of kept columns.

use serde::Serialize;

/// Most lengths that an interpolation goes through.
pub const MOST_SUPPORTS: usize = 3;

/// How long columns serve. A scene does not change these numbers; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Most lengths whose columns stay: macro steps that vary come back to the same lengths. More cost memory, fewer are measured again.
    pub most_kinds: usize,
    /// Most lengths that an interpolation goes through.
    pub most_supports: usize,
    /// Share of a response that the farthest length may change. Larger trusts interpolations that need passes, smaller measures more.
    pub most_changed: f64,
    /// What the farthest length changes falls with the square of the distances, what is left then with the cube: power of the one in the
    /// other.
    pub left_of_change: f64,
    /// Responses that differ from those of inertia alone by this factor are not resolved: for an undamped spring under a load that grows
    /// with time where `omega H` is above 2.6, shortly before the acceleration at the end of the step passes through zero.
    pub unresolved: f64,
    /// Shapes whose mean weighted by `1 - s` is smaller than this move a free body too little to tell.
    pub least_lever: f64,
}

/// Those of every run.
pub(crate) const SETTINGS: Settings = Settings {
    most_kinds: 32,
    most_supports: MOST_SUPPORTS,
    most_changed: 0.05,
    left_of_change: 1.5,
    unresolved: 4.0,
    least_lever: 0.02,
};
