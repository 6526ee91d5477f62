//! How often a macro step is corrected, and when the columns of the coupling Jacobian are asked for afresh.

use super::Parts;
use super::obstacle::{Kind, Obstacle};
use crate::coupling::corrector::{Corrector, Missed};
use crate::coupling::measure::{Change, MOST_LEFT};
use crate::error::RunError;
use crate::scene::{Iterations, Jacobian, Otherwise};
use crate::time::MacroStep;

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

/// Watches how well corrections converge with the columns at hand.
///
/// With columns of an earlier step a correction misses its aim by a share, the *rate*. A pass looks ahead over the same step with the
/// corrected inputs and corrects what is left, so that the result is the one of new columns; it takes one integration
/// of each subsystem, where columns take one for each input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Renewal {
    rule: Jacobian,
    iterations: Option<Iterations>,
    /// Share that a correction misses with the columns at hand; `None` until a step has shown it.
    rate: Option<f64>,
    /// Share that the first correction of a step has left, which takes into account what it was foreseen to miss.
    left_by_first: Option<f64>,
    /// Whether the columns at hand belong to the look-ahead over the present step.
    are_fresh: bool,
    /// Whether the last look-ahead, over the following step, was asked for columns.
    come_next: bool,
    /// Size of the first correction of the step.
    first: f64,
    last: Change,
    /// What passes do not take away: rounding and the errors of the solvers.
    noise: f64,
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
            left_by_first: None,
            are_fresh: true,
            come_next: true,
            noise: 0.0,
            first: 0.0,
            last: Change::default(),
            passes: Passes::default(),
        }
    }

    /// Whether the look-ahead over the `following` step has to bring new columns.
    pub fn wants_columns(&mut self, method: &dyn Corrector, following: MacroStep) -> bool {
        let has_columns = method.has_columns(following);
        let is_slow = self.rate.is_some_and(|rate| rate > SLOW);
        let wanted = self.rule == Jacobian::EveryStep || is_slow || !has_columns;
        self.come_next = wanted;
        wanted
    }

    /// After the first correction of a step whose error is small enough.
    pub fn begin(&mut self, method: &mut dyn Corrector) {
        let continues = method.accept();
        let change = method.last_change();
        self.are_fresh = self.come_next;
        self.last = change;
        self.passes = Passes {
            with_columns: self.are_fresh,
            ..Passes::default()
        };
        if !continues {
            (self.rate, self.left_by_first) = (None, None);
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
            None => self.leaves_too_much() && self.passes.count < MOST_PASSES,
        };
        let is_too_slow = self.rate.is_some_and(|rate| rate > TOO_SLOW);
        is_wanted.then_some(is_too_slow)
    }

    fn leaves_too_much(&self) -> bool {
        if self.rule == Jacobian::EveryStep || self.are_fresh || self.last.of_usual == 0.0 {
            return false;
        }
        let left = match self.passes.count {
            0 => self.left_by_first,
            _ => self.rate,
        };
        let most = MOST_LEFT.max(ABOVE_NOISE * self.noise);
        left.is_none_or(|share| share * self.last.of_usual > most)
    }

    /// After another correction.
    pub fn note_pass(&mut self, change: Change, with_columns: bool) {
        let rate = rate(change.of_usual, self.last.of_usual);
        if self.passes.count == 0 {
            self.left_by_first = Some(rate);
        }
        self.passes.count += 1;
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
        if !self.are_fresh {
            self.take(missed, is_noise);
        }
        self.passes
    }

    fn take(&mut self, missed: Missed, is_noise: bool) {
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

fn rate(size: f64, before: f64) -> f64 {
    if before > 0.0 { size / before } else { 0.0 }
}
