//! The length of a variable macro step: accepted or repeated, and how long the next one is.
//!
//! With the scaled error `e_N` of a step of length `H_N`, which falls with the power `p` of the step, the next one is
//!
//! ```text
//! H_{N+1} = H_N  s  e_N^(-0.7/p)  e_{N-1}^(0.4/p),   s = 0.9,
//! ```
//!
//! a proportional-integral controller, so that the length does not swing; where the error is known from the step alone and a longer step
//! saves more until the end than its columns cost, `H_{N+1} = H_N s e_N^(-1/p)`. Both within the limits of [`Settings`].

mod best;
mod control;
mod settings;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::accuracy::{Estimate, SingularPosition, Suspect, Tolerance};
use crate::results::StepStatistics;
use crate::time::MacroStep;
use best::{Again, Attempts};

pub use control::StepControl;
pub(crate) use settings::SETTINGS;
pub use settings::Settings;

/// Chooses the lengths of the macro steps.
pub struct StepSize {
    control: StepControl,
    rule: Rule,
    tolerance: Tolerance,
    /// Length of the first step in s.
    first: f64,
    /// End of the run in s.
    end: f64,
    state: State,
}

/// What the controller remembers from step to step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Scaled error of the last accepted step.
    before: f64,
    /// Whether the present step is a repeated one.
    is_repeated: bool,
    /// The last attempt at the present step whose error was too large.
    rejected: Option<Rejected>,
    /// The attempts at it near a singular position.
    attempts: Attempts,
    /// Length that steps do not exceed, and how many more of them.
    careful: Option<(f64, u32)>,
    statistics: StepStatistics,
}

/// Where the lengths come from. If they are known beforehand, every step is accepted, and what remains to be chosen are degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    /// They follow the error.
    Free,
    /// From a run in which they did.
    Given,
    /// They are all equal.
    Equal,
}

/// Why a step was rejected.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cause {
    /// The error is larger than allowed.
    Error {
        /// That of the step.
        found: Estimate,
        /// The error that the step would have had with the degrees of its repetition.
        next: Estimate,
    },
    /// The corrections have not come to an end within their number, and the scene rejects such a step. With this share of the step they
    /// would just have, if the rate of convergence tells.
    NotConverged(Option<f64>),
    /// A worker has refused the look-ahead, or the coupling has no solution.
    Failed,
}

#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Rejected {
    length: f64,
    change: f64,
}

/// How a step is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repetition {
    /// With this length in s.
    pub length: f64,
    /// Whether the solution has jumped, so that what lies before the step says nothing about it.
    pub has_jumped: bool,
}

impl StepSize {
    /// From a first step of length `first` to the `end` of the run.
    pub fn new(
        rule: Rule,
        control: StepControl,
        [first, end]: [f64; 2],
        tolerance: Tolerance,
    ) -> Self {
        Self {
            rule,
            tolerance,
            control,
            first,
            end,
            state: State {
                before: 1.0,
                is_repeated: false,
                rejected: None,
                attempts: Attempts::default(),
                careful: None,
                statistics: StepStatistics::default(),
            },
        }
    }

    /// What error is allowed.
    pub fn tolerance(&self) -> &Tolerance {
        &self.tolerance
    }

    /// What error is allowed, to take the outputs at a macro point that is reached.
    pub fn tolerance_mut(&mut self) -> &mut Tolerance {
        &mut self.tolerance
    }

    /// The tolerance and the limits of the scene.
    pub fn control(&self) -> &StepControl {
        &self.control
    }

    /// Whether the lengths follow the error.
    pub fn varies(&self) -> bool {
        self.rule == Rule::Free
    }

    /// Steps so far, if their lengths follow the error.
    pub fn statistics(&self) -> Option<StepStatistics> {
        self.varies().then_some(self.state.statistics)
    }

    /// Whether a step with this error is too long.
    pub fn is_too_long(&self, step: MacroStep, estimate: &Estimate) -> bool {
        self.varies()
            && estimate.scaled > 1.0
            && !self.is_jump(step, estimate)
            && !self.is_best_of(step)
    }

    /// Whether the step is taken whatever its error is, since shorter ones were no better.
    pub fn is_best_of(&self, step: MacroStep) -> bool {
        self.state.attempts.takes(step.length)
    }

    /// Whether an exchanged variable jumps in `step`: in the shortest step its error is the jump, and what follows from that for the motion
    /// goes with the length.
    pub fn is_jump(&self, step: MacroStep, estimate: &Estimate) -> bool {
        let is_shortest = step.length <= self.control.least_step * (1.0 + SETTINGS.rounding);
        let is_of_exchanged = matches!(estimate.suspect, Suspect::Variable(_));
        self.varies() && estimate.scaled > 1.0 && is_shortest && is_of_exchanged
    }

    /// Whether a step with an impact, which was `longest` (s) at the first attempt, may become shorter.
    pub fn may_follow_impact(&self, step: MacroStep, longest: f64) -> bool {
        let least = (SETTINGS.least_of_impact * longest).max(self.control.least_step);
        step.length > least * (1.0 + SETTINGS.rounding)
    }

    /// Takes a step in which an exchanged variable jumps; the length of the next one in s.
    pub fn pass_jump(&mut self, step: MacroStep) -> f64 {
        self.state.statistics.jumps += 1;
        self.pass_break(step)
    }

    /// Takes a step with a jump or an impact; the length of the next one in s. What the errors were before says nothing about it.
    pub fn pass_break(&mut self, step: MacroStep) -> f64 {
        let state = &mut self.state;
        let longest = state
            .statistics
            .longest
            .map_or(self.first, |step| step.length);
        (state.before, state.is_repeated) = (1.0, false);
        (state.rejected, state.careful) = (None, None);
        state.attempts = Attempts::default();
        state.statistics.accept(step);
        let next = self.allowed(SETTINGS.most_shrinking * longest);
        tracing::debug!(
            H = step.length,
            next_H = next,
            "an exchanged variable or a velocity has jumped"
        );
        next
    }

    /// The time that is left behind a step, in lengths of it.
    pub fn rest(&self, step: MacroStep) -> f64 {
        ((self.end - step.end) / step.length).max(0.0)
    }

    /// How many times as long as a step of this length, with this error that is known from it alone and falls with this power of it, steps may
    /// become: 1 where it keeps its length.
    pub fn growth(&self, length: f64, scaled: f64, order: usize) -> f64 {
        let most = self.control.greatest_step / length;
        let possible = (SETTINGS.safety * scaled.powf(-1.0 / order as f64)).min(most);
        match (SETTINGS.keep_from..=SETTINGS.keep_to).contains(&possible) {
            true => 1.0,
            false => possible.max(SETTINGS.most_shrinking),
        }
    }

    /// So many times as long the next step may be at most, where the error is known from the step alone.
    pub fn most_growth_alone(&self) -> f64 {
        SETTINGS.most_growth_alone
    }

    /// Where the lengths come from.
    pub fn rule(&self) -> Rule {
        self.rule
    }

    /// How a step is repeated after this, which may end near a singular position; `None` if it may not be shorter.
    pub fn repeat(
        &mut self,
        step: MacroStep,
        cause: Cause,
        singular: Option<SingularPosition>,
    ) -> Option<Repetition> {
        let is_shortest = step.length <= self.control.least_step;
        let state = &mut self.state;
        let error = match cause {
            Cause::Error { found, .. } => Some(found.scaled),
            Cause::NotConverged(_) | Cause::Failed => None,
        };
        let StepControl {
            least_step,
            greatest_step,
            ..
        } = self.control;
        let is_allowed = |length: &f64| (least_step..=greatest_step).contains(length);
        let again = singular.map_or(Again::Shorter, |near| {
            let across = near.across.filter(is_allowed);
            let near = SingularPosition { across, ..near };
            state.attempts.reject(step.length, error, near)
        });
        match again {
            Again::With(length) if is_allowed(&length) => {}
            Again::Shorter if !is_shortest => {}
            _ => return None,
        }
        let causes = &mut state.statistics.rejected_by_cause;
        let (count, share) = match cause {
            Cause::Error { next, .. } => {
                let share = SETTINGS.safety * next.scaled.powf(-1.0 / next.order as f64);
                (&mut causes.error, share)
            }
            Cause::NotConverged(share) => {
                let share = share.map_or(SETTINGS.diverged, |share| SETTINGS.safety * share);
                (&mut causes.not_converged, share)
            }
            Cause::Failed => (&mut causes.failed, SETTINGS.failed),
        };
        *count += 1;
        state.statistics.rejected += 1;
        state.is_repeated = true;
        if let Again::With(length) = again {
            return Some(Repetition {
                length,
                has_jumped: false,
            });
        }
        let length = state.attempts.shortest(step.length)
            * share.clamp(SETTINGS.most_shrinking, SETTINGS.safety);
        let length = self.allowed(length);
        let has_jumped = match cause {
            Cause::Error { found, next } => self.has_jumped(step, found.change, next.change),
            Cause::NotConverged(_) | Cause::Failed => {
                let longest = length.max(step.length / SETTINGS.most_growth);
                self.state.careful = Some((longest, SETTINGS.careful_steps));
                false
            }
        };
        Some(Repetition { length, has_jumped })
    }

    /// Whether the multipliers change hardly less in the present attempt at a step than in the one before, which was longer.
    /// The next attempt has the degrees that belong to the change `next`.
    fn has_jumped(&mut self, step: MacroStep, change: f64, next: f64) -> bool {
        let length = step.length;
        let change_of_next = Rejected {
            length,
            change: next,
        };
        let earlier = self.state.rejected.replace(change_of_next);
        earlier.is_some_and(|earlier| {
            let expected = (length / earlier.length).powf(SETTINGS.smooth_order);
            change > expected * earlier.change
        })
    }

    /// Takes the step; the length of the next one in s. The `estimate` is that of the degrees that follow; errors before are compared only
    /// if the degrees stay. Where the error is known from the step alone, a longer one has to save more than `columns` steps until the end:
    /// as much as its columns cost.
    pub fn accept(
        &mut self,
        step: MacroStep,
        estimate: &Estimate,
        has_equal_degrees: bool,
        columns: f64,
    ) -> f64 {
        let power = |error: f64, exponent: f64| error.powf(exponent / estimate.order as f64);
        let (least_error, most_growth) = match estimate.is_of_step_alone {
            true => (0.0, SETTINGS.most_growth_alone),
            false => (SETTINGS.least_error, SETTINGS.most_growth),
        };
        let scaled = estimate.scaled.max(least_error);
        let possible = SETTINGS.safety * power(scaled, -1.0);
        // Far below what is allowed there is nothing to be smoothed.
        let is_far = estimate.is_of_step_alone && possible > SETTINGS.most_growth;
        let smooth = match has_equal_degrees && !is_far {
            true => {
                let before = power(self.state.before, SETTINGS.proportional);
                SETTINGS.safety * power(scaled, -SETTINGS.integral) * before
            }
            false => possible,
        };
        let saved = self.rest(step) * (1.0 - 1.0 / possible);
        let may_grow = estimate.is_of_step_alone && possible > SETTINGS.keep_to;
        let is_no_gain = may_grow && has_equal_degrees && (saved < columns || smooth < 1.0);
        let state = &mut self.state;
        let most = if state.is_repeated { 1.0 } else { most_growth };
        let keeps = (SETTINGS.keep_from..=SETTINGS.keep_to).contains(&possible);
        let mut wish = match keeps || is_no_gain {
            true => step.length,
            false => step.length * smooth.clamp(SETTINGS.most_shrinking, most),
        };
        state.careful = state.careful.filter(|(_, steps)| *steps > 0);
        if let Some((longest, steps)) = &mut state.careful {
            wish = wish.min(*longest);
            *steps -= 1;
        }
        state.before = scaled;
        state.is_repeated = false;
        state.rejected = None;
        state.attempts = Attempts::default();
        state.statistics.accept(step);
        let next = match wish == step.length {
            true => wish,
            false => self.allowed(wish),
        };
        if self.varies() {
            let (error, order) = (estimate.scaled, estimate.order);
            tracing::debug!(H = step.length, error, order, next_H = next, "accepted");
        }
        next
    }

    /// The longest allowed length that is no longer than this one.
    fn allowed(&self, length: f64) -> f64 {
        let octaves = (length / self.first * (1.0 + SETTINGS.rounding)).log2();
        let per_octave = SETTINGS.lengths_per_octave;
        let exponent = (per_octave * octaves).floor() / per_octave;
        let StepControl {
            least_step,
            greatest_step,
            ..
        } = self.control;
        (self.first * exponent.exp2()).clamp(least_step, greatest_step)
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        self.state
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.state = state;
    }
}
