//! How often a macro step is corrected, and when the columns of the coupling Jacobian are asked for afresh.

use super::Parts;
use crate::coupling::corrector::Corrector;
use crate::coupling::measure::Change;
use crate::error::RunError;
use crate::scene::{Iterations, Jacobian, Otherwise};
use crate::time::MacroStep;

/// What columns of an earlier step may leave of a correction. The error that they leave changes from step to step, so it is worse
/// for the motion than an error of the multipliers of the same size that is smooth.
const MOST_LEFT: f64 = 1e-4;

/// Rate of convergence above which new columns come with the next look-ahead.
const SLOW: f64 = 0.3;

/// Rate of convergence above which the step itself is corrected with new columns.
const TOO_SLOW: f64 = 0.5;

/// Most passes that columns of an earlier step get.
const MOST_PASSES: u32 = 8;

/// Watches how well corrections converge with the columns at hand.
///
/// With columns of an earlier step a correction misses its aim by a share, the *rate*. A pass looks ahead over the same step with the
/// corrected inputs and corrects what is left, so that the result is the one of new columns; it takes one integration
/// of each subsystem, where columns take one for each input.
pub(crate) struct Renewal {
    rule: Jacobian,
    iterations: Option<Iterations>,
    /// Rate of convergence with the columns at hand; `None` until a step has shown it.
    rate: Option<f64>,
    /// Whether the columns at hand belong to the look-ahead over the present step.
    are_fresh: bool,
    /// Whether the last look-ahead, over the following step, was asked for columns.
    come_next: bool,
    last: Change,
    passes: Passes,
}

/// How the corrections of a macro step went.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Passes {
    /// Corrections after the first one.
    pub count: u32,
    /// Size of the last correction over that of the one before, if there were several.
    pub rate: Option<f64>,
    /// Whether the last correction was still larger than the tolerance of the scene.
    pub is_unconverged: bool,
    /// Whether columns were asked for in this step.
    pub with_columns: bool,
}

impl Renewal {
    /// Under the rules of the scene.
    pub fn new(rule: Jacobian, iterations: Option<Iterations>) -> Self {
        Self {
            rule,
            iterations,
            rate: None,
            are_fresh: true,
            come_next: true,
            last: Change::default(),
            passes: Passes::default(),
        }
    }

    /// Whether the look-ahead over the `following` step has to bring new columns.
    pub fn wants_columns(&mut self, method: &mut dyn Corrector, following: MacroStep) -> bool {
        let again = method.again();
        let has_columns = again.is_some_and(|again| again.has_columns(following));
        let is_slow = self.rate.is_some_and(|rate| rate > SLOW);
        let wanted = self.rule == Jacobian::EveryStep || is_slow || !has_columns;
        self.come_next = wanted;
        wanted
    }

    /// The step is looked ahead over afresh, with new columns.
    pub fn renew(&mut self) {
        self.come_next = true;
    }

    /// After the first correction of a step.
    pub fn begin(&mut self, change: Change) {
        self.are_fresh = self.come_next;
        self.last = change;
        self.passes = Passes {
            with_columns: self.are_fresh,
            ..Passes::default()
        };
        if self.are_fresh {
            self.rate = None;
        }
    }

    /// Whether the step has to be corrected once more, and then whether with new columns.
    pub fn next_pass(&mut self) -> Option<bool> {
        let is_wanted = match self.iterations {
            Some(iterations) => {
                let is_open = self.last.of_size > iterations.tolerance;
                self.passes.is_unconverged = is_open && self.passes.count == iterations.most;
                is_open && self.passes.count < iterations.most
            }
            None => self.leaves_too_much() && self.passes.count < MOST_PASSES,
        };
        let is_too_slow = self.rate.is_some_and(|rate| rate > TOO_SLOW);
        is_wanted.then_some(is_too_slow)
    }

    fn leaves_too_much(&self) -> bool {
        if self.rule == Jacobian::EveryStep || self.are_fresh || self.last.of_usual == 0.0 {
            return false;
        }
        self.rate
            .is_none_or(|rate| rate * self.last.of_usual > MOST_LEFT)
    }

    /// After another correction.
    pub fn note_pass(&mut self, change: Change, with_columns: bool) {
        let rate = rate(change.of_usual, self.last.of_usual);
        self.passes.count += 1;
        self.passes.rate = Some(rate);
        self.passes.with_columns |= with_columns;
        self.last = change;
        self.are_fresh |= with_columns;
        self.rate = (!with_columns).then_some(rate);
    }

    /// Refuses a step that has not converged, if the scene says so.
    pub fn refuse(&self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        match self.iterations {
            Some(iterations)
                if self.passes.is_unconverged && iterations.otherwise == Otherwise::Fail =>
            {
                let change = self.last;
                Err(RunError::NotConverged {
                    t: step.start,
                    step: step.length,
                    unknown: parts.layout.variable_name(change.variable),
                    change: change.of_size,
                    tolerance: iterations.tolerance,
                    passes: self.passes.count,
                    rate: self.passes.rate.unwrap_or(f64::NAN),
                })
            }
            _ => Ok(()),
        }
    }

    /// After the step: an advance shows the rate without a pass.
    pub fn finish(&mut self, method: &mut dyn Corrector, parts: &Parts) -> Passes {
        let is_old = self.rule != Jacobian::EveryStep && !self.are_fresh;
        if let Some(again) = method.again()
            && is_old
            && self.passes.count == 0
        {
            self.rate = Some(rate(again.remainder(parts), self.last.of_usual));
        }
        self.passes
    }
}

fn rate(size: f64, before: f64) -> f64 {
    if before > 0.0 { size / before } else { 0.0 }
}
