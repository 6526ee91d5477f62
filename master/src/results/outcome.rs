//! What became of a macro step.

use serde::{Deserialize, Serialize};
use std::time::Duration;

use super::verdict::Verdict;
use crate::time::MacroStep;

/// What a method reports of a macro step.
pub struct Outcome {
    /// The step that was accepted.
    pub step: MacroStep,
    /// Verdict on it.
    pub verdict: Verdict,
    /// Time that was spent on solving for the multipliers.
    pub solving: Duration,
    /// How the corrections went.
    pub passes: Passes,
    /// Whether there was an impact in it that partners took part in.
    pub has_impact: bool,
    /// Whether it was taken with an error that is larger than allowed, near a singular position.
    pub is_unsolved: bool,
    /// What its last correction has missed, of what the scene allows, if that is more than it; without a tolerance of the scene unknown.
    pub missed: Option<f64>,
}

impl Outcome {
    /// Of a step that no corrector has judged.
    pub(crate) fn of_step(step: MacroStep) -> Self {
        Self {
            step,
            verdict: Verdict::Uncorrected,
            solving: Duration::ZERO,
            passes: Passes::default(),
            has_impact: false,
            is_unsolved: false,
            missed: None,
        }
    }
}

/// How the corrections of a macro step went.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Passes {
    /// Corrections after the first one.
    pub count: u32,
    /// Size of the last correction over that of the one before, if there were several.
    pub rate: Option<f64>,
    /// Whether the last correction was still larger than the tolerance of the scene.
    pub is_unconverged: bool,
    /// Whether a condition was relaxed, since the macro step does not resolve its multiplier.
    pub is_limited: bool,
    /// Whether columns were asked for in this step.
    pub with_columns: bool,
}
