//! What is known of the columns at hand and of the present step.

use serde::{Deserialize, Serialize};

use super::settings::Settings;
use crate::accuracy::Change;
use crate::results::Passes;

/// What is known of the columns at hand and of the present step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Share that a correction misses with the columns at hand; `None` until a step has shown it.
    pub(super) rate: Option<f64>,
    /// Share that a correction misses even with new columns, since the conditions are not linear.
    pub(super) fresh_rate: Option<f64>,
    /// The same per size of the correction, where that is known relative to the error that is allowed: what is missed goes with the square.
    pub(super) curvature: Option<f64>,
    /// Share that the first correction of a step has left, which takes into account what it was foreseen to miss.
    pub(super) left_by_first: Option<f64>,
    /// Whether the columns at hand belong to the look-ahead over the present step.
    pub(super) are_fresh: bool,
    /// Whether the present step was predicted without a past.
    pub(super) is_blind: bool,
    /// Whether the last look-ahead, over the following step, was asked for columns.
    pub(super) come_next: bool,
    /// Share of the columns for it that may be wrong because they were measured over other lengths; `None` if it brings new ones.
    pub(super) off_by_length: Option<f64>,
    /// Whether corrections converged too slowly when the last step was taken.
    pub(super) is_slow: bool,
    /// Whether there was an impact in it.
    pub(super) is_struck: bool,
    /// Whether it ends near a singular position.
    pub(super) is_near_singular: bool,
    /// Length of that step in s.
    pub(super) length: f64,
    /// Macro steps of this length in a row that needed passes with columns of other lengths.
    pub(super) borrowed: u32,
    /// Size of the first correction of the step, relative to usual ones and to the variables.
    pub(super) first: f64,
    pub(super) first_of_size: f64,
    /// Largest share that corrections have missed that were not rounding, older ones counting less.
    pub(super) curved: f64,
    /// Size of first corrections relative to the variables while nothing grows.
    pub(super) calm: f64,
    pub(super) last: Change,
    /// What passes do not take away: rounding and the errors of the solvers.
    pub(super) noise: f64,
    pub(super) passes: Passes,
}

impl State {
    /// The last correction has missed a share.
    pub(super) fn note_curved(&mut self, rate: f64, settings: &Settings) {
        self.curved *= settings.fading;
        if self
            .last
            .of_allowed
            .is_some_and(|change| change > settings.nothing)
        {
            self.curved = self.curved.max(rate);
        }
    }
}

/// The share that a correction has missed per size of it.
pub(super) fn curvature(rate: f64, change: Change) -> Option<f64> {
    let change = change.of_allowed.filter(|change| *change > 0.0)?;
    Some(rate / change)
}

/// What one change is of the one before.
pub(super) fn rate(size: f64, before: f64) -> f64 {
    if before > 0.0 { size / before } else { 0.0 }
}
