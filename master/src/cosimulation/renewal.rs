//! How often a macro step is corrected, and when the columns of the coupling Jacobian are asked for afresh.

use super::obstacle::{Kind, Obstacle};
use crate::coupling::corrector::{Corrector, Missed};
use crate::coupling::measure::{Change, MOST_LEFT};
use crate::error::RunError;
use crate::results::Passes;
use crate::scene::{Coupling, Iterations, Jacobian, Otherwise};
use crate::time::MacroStep;
use crate::workers::Parts;

/// Rate of convergence above which new columns come with the next look-ahead.
const SLOW: f64 = 0.3;

/// Rate of convergence above which the step itself is corrected with new columns.
const TOO_SLOW: f64 = 0.5;

/// Noise is what stands so many times above what convergence explains; what stands so many times above noise is none.
const ABOVE_NOISE: f64 = 2.0;

/// A pass that leaves more than this share of what it has changed was of no use.
const USELESS: f64 = 0.7;

/// Share that noise keeps from step to step where nothing is heard of it.
const FADING: f64 = 0.99;

/// Most passes that columns of an earlier step get.
const MOST_PASSES: u32 = 8;

/// After so many macro steps of one length that needed passes with columns of other lengths it gets its own.
const MOST_BORROWED: u32 = 3;

/// What columns of an earlier step may leave of a correction where steps vary: the error of such a step is a thirtieth of a correction and more.
const MOST_LEFT_OF_VARIABLE_STEPS: f64 = 3e-3;

/// Watches how well corrections converge with the columns at hand.
///
/// With columns of an earlier step a correction misses its aim by a share, the *rate*. A pass looks ahead over the same step with the
/// corrected inputs and corrects what is left, so that the result is the one of new columns; it takes one integration
/// of each subsystem, where columns take one for each input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Renewal {
    rule: Jacobian,
    iterations: Option<Iterations>,
    /// What may be left of a correction.
    most_left: f64,
    /// Rate of columns of which no step has shown it: where steps vary they are trusted for one step.
    unknown_rate: Option<f64>,
    /// Share that a correction misses with the columns at hand; `None` until a step has shown it.
    rate: Option<f64>,
    /// Share that the first correction of a step has left, which takes into account what it was foreseen to miss.
    left_by_first: Option<f64>,
    /// Whether the columns at hand belong to the look-ahead over the present step.
    are_fresh: bool,
    /// Whether the present step was predicted without a past.
    is_blind: bool,
    /// Whether the last look-ahead, over the following step, was asked for columns.
    come_next: bool,
    /// Share of the columns for it that may be wrong because they were measured over other lengths; `None` if it brings new ones.
    off_by_length: Option<f64>,
    /// Whether corrections converged too slowly when the last step was taken.
    is_slow: bool,
    /// Length of that step in s.
    length: f64,
    /// Macro steps of this length in a row that needed passes with columns of other lengths.
    borrowed: u32,
    /// Size of the first correction of the step.
    first: f64,
    last: Change,
    /// What passes do not take away: rounding and the errors of the solvers.
    noise: f64,
    passes: Passes,
}

impl Renewal {
    /// Under the rules of the scene.
    pub fn new(coupling: &Coupling) -> Self {
        let (most_left, unknown_rate) = match coupling.step_control {
            Some(_) => (MOST_LEFT_OF_VARIABLE_STEPS, Some(0.0)),
            None => (MOST_LEFT, None),
        };
        Self {
            rule: coupling.jacobian,
            iterations: coupling.iterations,
            most_left,
            unknown_rate,
            rate: None,
            left_by_first: None,
            are_fresh: true,
            is_blind: false,
            come_next: true,
            off_by_length: None,
            is_slow: false,
            length: 0.0,
            borrowed: 0,
            noise: 0.0,
            first: 0.0,
            last: Change::default(),
            passes: Passes::default(),
        }
    }

    /// Whether the look-ahead over the `following` step has to bring new columns.
    pub fn wants_columns(
        &mut self,
        method: &mut dyn Corrector,
        parts: &Parts,
        following: MacroStep,
    ) -> bool {
        let wanted = self.rule == Jacobian::EveryStep || self.is_slow;
        let found = (!wanted).then(|| method.prepare_columns(parts, following));
        // A length that stays is worth columns of its own.
        let is_own = self.borrowed >= MOST_BORROWED && self.length == following.length;
        let found = found.flatten();
        self.off_by_length = found.filter(|off| *off == 0.0 || !is_own);
        self.come_next = self.off_by_length.is_none();
        if self.come_next && self.rule != Jacobian::EveryStep {
            let because = match found {
                _ if self.is_slow => "corrections converge slowly",
                Some(_) => "steps keep a length without columns of its own",
                None => "no columns at hand serve",
            };
            let (t, rate) = (following.start, self.rate);
            tracing::debug!(t, H = following.length, because, rate, "Jacobian refresh");
        }
        self.come_next
    }

    /// The step is taken after all its corrections: what they tell decides about the columns of the next one, however often that is tried.
    pub fn take(&mut self, step: MacroStep) {
        self.is_slow = self.rate.is_some_and(|rate| rate > SLOW);
        let is_borrowed = self.off_by_length.is_some_and(|off| off > 0.0);
        let before = if step.length == self.length {
            self.borrowed
        } else {
            0
        };
        self.borrowed = match is_borrowed && self.passes.count > 0 {
            true => before + 1,
            false => 0,
        };
        self.length = step.length;
    }

    /// After the first correction of a step whose error is small enough.
    pub fn begin(&mut self, method: &mut dyn Corrector) {
        let continues = method.accept();
        let change = method.last_change();
        self.are_fresh = self.come_next;
        self.is_blind = method.is_blind();
        self.last = change;
        self.passes = Passes {
            with_columns: self.are_fresh,
            ..Passes::default()
        };
        if !continues {
            let off = self.off_by_length.filter(|_| !self.are_fresh);
            self.rate = self.rate.filter(|_| off.is_some());
            self.left_by_first = self.rate.or(self.unknown_rate).zip(off).map(larger);
        }
        self.first = change.of_usual;
    }

    /// Whether the step has to be corrected once more, and then whether with new columns.
    pub fn next_pass(&mut self) -> Option<bool> {
        let is_wanted = match self.iterations {
            Some(iterations) => {
                let is_open = self.last.of_size > iterations.tolerance;
                self.passes.is_unconverged = is_open && self.passes.count == iterations.most;
                is_open && self.passes.count < iterations.most
            }
            None => {
                let is_blind = self.is_blind && self.passes.count == 0;
                is_blind || self.leaves_too_much() && self.passes.count < MOST_PASSES
            }
        };
        let needs_columns = self.rate.is_some_and(|rate| rate > TOO_SLOW) || self.is_out_of_reach();
        if is_wanted && needs_columns {
            let because = "corrections do not converge in this step";
            tracing::debug!(because, rate = self.rate, "Jacobian refresh");
        }
        is_wanted.then_some(needs_columns)
    }

    /// Whether the passes that are left do not converge with columns of earlier steps.
    fn is_out_of_reach(&self) -> bool {
        let rate = self.rate.or(self.off_by_length);
        let (Some(iterations), Some(rate)) = (self.iterations, rate) else {
            return false;
        };
        let passes = iterations.most.saturating_sub(self.passes.count);
        let left = rate.powf(f64::from(passes));
        !self.are_fresh && left * self.last.of_size > iterations.tolerance
    }

    fn leaves_too_much(&self) -> bool {
        if self.rule == Jacobian::EveryStep || self.are_fresh || self.last.of_usual == 0.0 {
            return false;
        }
        let left = match self.passes.count {
            0 => self.left_by_first.or(self.unknown_rate),
            _ => self.rate,
        };
        let most = self.most_left.max(ABOVE_NOISE * self.noise);
        left.is_none_or(|share| share * self.last.of_usual > most)
    }

    /// After another correction.
    pub fn note_pass(&mut self, change: Change, with_columns: bool) {
        let rate = rate(change.of_usual, self.last.of_usual);
        if self.passes.count == 0 {
            self.left_by_first = Some(rate);
        }
        self.passes.count += 1;
        tracing::debug!(
            pass = self.passes.count,
            change = change.of_size,
            rate,
            with_columns,
            "corrected again"
        );
        self.passes.rate = Some(rate);
        self.passes.with_columns |= with_columns;
        self.last = change;
        self.are_fresh |= with_columns;
        if with_columns {
            (self.rate, self.left_by_first) = (None, None);
        } else {
            self.rate = Some(self.rate.unwrap_or_default().max(rate));
        }
    }

    /// After the last correction: whether the step is taken as it is, by the rule of the scene.
    pub fn check(&self, parts: &Parts, step: MacroStep) -> Result<(), Obstacle> {
        let Some(iterations) = self.iterations.filter(|_| self.passes.is_unconverged) else {
            return Ok(());
        };
        let change = self.last;
        let passes = self.passes.count;
        let rate = self.passes.rate.unwrap_or(f64::NAN);
        let error = || RunError::NotConverged {
            t: step.start,
            step: step.length,
            unknown: parts.layout.variable_name(change.variable),
            change: change.of_size,
            tolerance: iterations.tolerance,
            passes,
            rate,
            remedy: "a smaller coupling.macro_step",
        };
        match iterations.otherwise {
            Otherwise::Warn => Ok(()),
            Otherwise::Fail => Err(error().into()),
            Otherwise::Reject => {
                // The rate falls at least with H, and the last change with its power.
                let share = (iterations.tolerance / change.of_size).powf(1.0 / f64::from(passes));
                Err(Obstacle {
                    kind: Kind::NotConverged((rate < 1.0).then_some(share)),
                    error: Box::new(error()),
                })
            }
        }
    }

    /// After the step: an advance shows what was missed without a pass.
    pub fn finish(&mut self, method: &mut dyn Corrector, parts: &Parts) -> Passes {
        if self.rule == Jacobian::EveryStep {
            return self.passes;
        }
        let missed = method.learn(parts, self.are_fresh);
        let is_noise = self.listen(missed);
        match self.are_fresh {
            // What new columns leave says nothing of how they serve in later steps.
            true => (self.rate, self.left_by_first) = (None, None),
            false => self.note_missed(missed, is_noise),
        }
        self.passes
    }

    fn note_missed(&mut self, missed: Missed, is_noise: bool) {
        let of_first = rate(missed.by_first, self.first);
        let of_last = rate(missed.by_last, self.last.of_usual);
        if self.passes.count == 0 {
            self.left_by_first = Some(of_last);
        }
        let tells_rate = self.passes.count > 0 && !is_noise;
        self.rate = Some(if tells_rate {
            of_first.max(of_last)
        } else {
            of_first
        });
    }

    /// A pass leaves a share of what it has changed; where it leaves most of it and the columns do not explain that, no further pass
    /// would take it away. Gives whether that is so.
    fn listen(&mut self, missed: Missed) -> bool {
        let left = missed.by_last;
        let expected = self.rate.unwrap_or_default() * self.last.of_usual;
        let is_useless = left > (ABOVE_NOISE * expected).max(USELESS * self.last.of_usual);
        let is_noise = self.passes.count > 0 && is_useless;
        self.noise = match is_noise {
            true => self.noise.max(left),
            false => FADING * self.noise,
        };
        is_noise
    }
}

fn larger((one, other): (f64, f64)) -> f64 {
    one.max(other)
}

fn rate(size: f64, before: f64) -> f64 {
    if before > 0.0 { size / before } else { 0.0 }
}
