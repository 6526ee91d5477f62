//! The constants that decide about the macro steps of a run.

use serde::Serialize;

use crate::policies::{columns, deferred_correction, degree, iteration, norm, step_size};

/// The constants of all policies, as they hold in a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Of iterations and refreshes of the Jacobian.
    pub iteration: iteration::Settings,
    /// Of kept columns.
    pub columns: columns::Settings,
    /// Of what columns miss.
    pub deferred_correction: deferred_correction::Settings,
    /// Of sizes of changes.
    pub norm: norm::Settings,
    /// Of variable macro steps; absent where they are fixed.
    pub step_size: Option<step_size::Settings>,
    /// Of degrees that follow the estimates; absent where none does.
    pub degree: Option<degree::Settings>,
}

impl Settings {
    /// Those of a run whose macro step `varies` or whose degrees `follow` the estimates.
    pub fn new(varies: bool, follow: bool) -> Self {
        Self {
            iteration: iteration::Settings::new(varies),
            columns: columns::SETTINGS,
            deferred_correction: deferred_correction::SETTINGS,
            norm: norm::SETTINGS,
            step_size: varies.then_some(step_size::SETTINGS),
            degree: follow.then_some(degree::SETTINGS),
        }
    }
}
