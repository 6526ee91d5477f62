//! The constants of the iteration control.

use serde::Serialize;

use crate::accuracy::MOST_LEFT;

/// When columns are asked for afresh. A scene does not change these numbers; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// What columns of an earlier step may leave of a correction, relative to usual corrections. Larger leaves errors that change from step
    /// to step, smaller takes passes for nothing. Where steps vary 3e-3: the error of such a step is a thirtieth of a correction and more.
    pub most_left: f64,
    /// What corrections may leave of the error that is allowed, where it is known by how much they change what has an error. Larger spoils
    /// steps that are accurate otherwise, smaller takes passes for nothing.
    pub most_of_allowed: f64,
    /// What a correction may change of the error that is allowed where steps are fixed before another one is worth a pass: less is rounding of
    /// positions that are a hundred times as large as the motion.
    pub nothing: f64,
    /// Share of a correction below which what it misses is rounding, which passes do not take away.
    pub rounding: f64,
    /// Share of a correction below which conditions are linear but for rounding. Where steps are fixed passes would make the steps of a linear
    /// system differ.
    pub linear: f64,
    /// Share of a correction that may be missed with new columns where steps are fixed. What is missed more often grows from step to step:
    /// larger lets light parts under heavy loads run away, smaller takes passes where the curvature of the motion is all that is missed.
    pub astray: f64,
    /// Growth of first corrections, relative to calm ones, from which on corrections go on until what they change is calm, where steps are fixed.
    /// Larger lets light parts under heavy loads run away, smaller takes passes where a motion becomes faster.
    pub grown: f64,
    /// What calm corrections may grow by from step to step.
    pub memory: f64,
    /// Corrections of this share of the variables are calm in any case.
    pub least_calm: f64,
    /// Rate of convergence above which new columns come with the next look-ahead. Smaller asks more often, larger takes more passes:
    /// at 0.3 one pass less pays for the columns of two or three inputs.
    pub slow: f64,
    /// Rate of convergence above which the step itself is corrected with new columns. Nearer to 1 passes hardly help.
    pub too_slow: f64,
    /// Noise is what stands so many times above what convergence explains; what stands so many times above noise is none.
    pub above_noise: f64,
    /// A pass that leaves more than this share of what it has changed was of no use.
    pub useless: f64,
    /// Share that noise keeps from step to step where nothing is heard of it. At 1 one noisy step stops passes for good.
    pub fading: f64,
    /// Most passes that columns of an earlier step get; then the correction stays as it is, and its verdict tells.
    pub most_passes: u32,
    /// After so many macro steps of one length that needed passes with columns of other lengths it gets its own.
    pub most_borrowed: u32,
}

impl Settings {
    pub(crate) fn new(varies: bool) -> Self {
        Self {
            most_left: if varies { 3e-3 } else { MOST_LEFT },
            most_of_allowed: 0.1,
            nothing: 1e-10,
            rounding: 1e-8,
            linear: 1e-3,
            astray: 0.1,
            grown: 30.0,
            memory: 1.1,
            least_calm: 1e-9,
            slow: 0.3,
            too_slow: 0.5,
            above_noise: 2.0,
            useless: 0.7,
            fading: 0.99,
            most_passes: 8,
            most_borrowed: 3,
        }
    }
}
