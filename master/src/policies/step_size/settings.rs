//! The constants of the step-size control.

use serde::Serialize;

use crate::time::MOST_GROWTH;

/// How the lengths of macro steps follow the error. A scene does not change them; run.json shows them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settings {
    /// Share of the length with which the error would just be allowed. Nearer to 1 more steps are rejected, smaller ones cost more
    /// steps: with 0.9 few are rejected where the error changes by less than a fifth from step to step.
    pub safety: f64,
    /// Exponent of the last error, per order. Larger follows faster and swings.
    pub integral: f64,
    /// Exponent of the error before it, per order. Larger damps more and follows later; the usual pair is 0.7 and 0.4.
    pub proportional: f64,
    /// Least ratio of two successive lengths. Smaller follows an estimate that may be wrong too far; larger takes more rejections
    /// at a jump.
    pub most_shrinking: f64,
    /// Largest ratio of two successive lengths. More would make polynomials over unequal steps unstable.
    pub most_growth: f64,
    /// The same where the error is known from the step alone.
    pub most_growth_alone: f64,
    /// A step that could be longer by no more than this factor keeps its length: histories and columns of equal steps are worth more.
    pub keep_to: f64,
    /// A step that should be shorter by no more than this factor keeps its length. Smaller rejects more of the next ones.
    pub keep_from: f64,
    /// Where the solution is smooth, the multipliers of a repeated step change less by at least this power of its length. Larger takes
    /// smooth motion for a jump; at 0 no jump is found.
    pub smooth_order: f64,
    /// A length that is shorter than an allowed one by this share is taken for it: rounding of the logarithm.
    pub rounding: f64,
    /// Macro steps are the first one times powers of two with these parts of a whole exponent: columns of a length that comes back serve
    /// again. More lengths follow the error closer, fewer come back more often; between 8 and 32 the cost hardly changes.
    pub lengths_per_octave: f64,
    /// Smallest scaled error that the controller remembers. Smaller lets one step without error dominate the next ones.
    pub least_error: f64,
    /// Share of a step whose corrections do not converge, at a rate that does not tell by how much it is too long.
    pub diverged: f64,
    /// Share of a step that a worker could not take: nothing tells how much too long it was.
    pub failed: f64,
    /// A step with an impact is shortened for its error down to this share of what it was at the first attempt. Smaller reaches lengths at
    /// which the responses of the workers are rounding; larger leaves more of what the loads of the step miss of its jump.
    pub least_of_impact: f64,
    /// Attempts at a step near a singular position that are no better than a longer one before that one is taken. Smaller takes a step that
    /// ends in the position, larger tries more that are hopeless.
    pub most_in_vain: u32,
    /// Accepted steps after a failure that stay below the length that failed: the error says nothing of failures.
    pub careful_steps: u32,
}

/// Those of every run.
pub(crate) const SETTINGS: Settings = Settings {
    safety: 0.9,
    integral: 0.7,
    proportional: 0.4,
    most_shrinking: 0.1,
    most_growth: MOST_GROWTH,
    most_growth_alone: 10.0,
    keep_to: 1.25,
    keep_from: 0.95,
    smooth_order: 0.5,
    rounding: 1e-9,
    lengths_per_octave: 16.0,
    least_error: 1e-4,
    diverged: 0.5,
    least_of_impact: 1.0 / 128.0,
    failed: 0.25,
    most_in_vain: 3,
    careful_steps: 20,
};
