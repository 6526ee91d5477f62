//! How often a macro step is corrected, and when the columns of the coupling Jacobian are asked for afresh.

mod learning;
mod rules;
mod settings;
mod state;
#[cfg(test)]
mod tests;

use crate::accuracy::Change;
use crate::results::Passes;
use crate::time::MacroStep;

pub use rules::{Iterations, Jacobian, Otherwise};
pub use settings::Settings;
pub use state::State;
use state::{curvature, rate};

/// What corrections of a step have missed, relative to the first corrections of the last macro steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Missed {
    /// What another correction with the matrix at hand would change after the last one.
    pub by_last: f64,
    /// What the first one would have missed if nothing had been foreseen.
    pub by_first: f64,
    /// What the last one has missed, of the error that is allowed of a step, where it is known.
    pub of_allowed: Option<f64>,
}

/// The corrections of a step have not come to an end within their number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unconverged {
    /// The last correction.
    pub change: Change,
    /// What was allowed of it, relative to the variables.
    pub tolerance: f64,
    /// Corrections after the first one.
    pub passes: u32,
    /// Share that each leaves of the one before.
    pub rate: f64,
    /// The share of the step with which they would just have converged, if the step is to be repeated and the rate tells.
    pub share: Option<f64>,
    /// Whether the step is to be repeated with a shorter one.
    pub rejects: bool,
}

/// Watches how well corrections converge with the columns at hand.
///
/// With columns of an earlier step a correction misses its aim by a share, the *rate*. A pass looks ahead over the same step with the
/// corrected inputs and corrects what is left, so that the result is the one of new columns; it takes one integration
/// of each subsystem, where columns take one for each input.
///
/// A macro step works on a copy, which becomes the present state when the step is accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IterationControl {
    settings: Settings,
    rule: Jacobian,
    iterations: Option<Iterations>,
    /// Whether a step that is not solved may be repeated with a shorter one.
    varies: bool,
    /// Rate of columns of which no step has shown it: where steps vary they are trusted for one step.
    unknown_rate: Option<f64>,
    state: State,
}

impl IterationControl {
    /// Under the rules of the scene; the macro step `varies` or not.
    pub fn new(rule: Jacobian, iterations: Option<Iterations>, varies: bool) -> Self {
        Self {
            settings: Settings::new(varies),
            rule,
            iterations,
            varies,
            unknown_rate: varies.then_some(0.0),
            state: State {
                are_fresh: true,
                come_next: true,
                calm: f64::MAX,
                ..State::default()
            },
        }
    }

    /// Whether new columns have to come with the next look-ahead, whatever others are at hand.
    pub fn needs_new_columns(&self) -> bool {
        let state = &self.state;
        self.rule == Jacobian::EveryStep
            || state.is_slow
            || state.is_struck
            || state.is_near_singular
    }

    /// The look-ahead over the present step has brought new columns after all, because of an impact within it.
    pub fn bring_columns(&mut self) {
        self.state.come_next = true;
        self.state.off_by_length = None;
    }

    /// The step that was accepted has had an impact: behind it contacts are others, and columns as well.
    pub fn pass_impact(&mut self) {
        self.state.is_struck = true;
    }

    /// Whether the step that was accepted ends near a singular position, where the responses of earlier steps do not serve.
    pub fn approach_singular_position(&mut self, is_near: bool) {
        self.state.is_near_singular = is_near;
    }

    /// Whether the scene says how often steps are corrected.
    pub fn has_rule(&self) -> bool {
        self.iterations.is_some()
    }

    /// Decides whether the look-ahead over the `following` step brings new columns, where those that were `found` may be wrong by this
    /// share because they were measured over other lengths; `None` if there are none.
    pub fn decide_columns(&mut self, following: MacroStep, found: Option<f64>) -> bool {
        let state = &mut self.state;
        // A length that stays is worth columns of its own.
        let is_own =
            state.borrowed >= self.settings.most_borrowed && state.length == following.length;
        state.off_by_length = found.filter(|off| *off == 0.0 || !is_own);
        state.come_next = state.off_by_length.is_none();
        if state.come_next && self.rule != Jacobian::EveryStep {
            let because = match found {
                _ if state.is_struck => "contacts are others behind an impact",
                _ if state.is_near_singular => "the mechanism is near a singular position",
                _ if state.is_slow => "corrections converge slowly",
                Some(_) => "steps keep a length without columns of its own",
                None => "no columns at hand serve",
            };
            let (t, rate) = (following.start, state.rate);
            tracing::debug!(t, H = following.length, because, rate, "Jacobian refresh");
        }
        state.come_next
    }

    /// After the first correction of a step whose error is small enough. The step `continues` the one before if it has the columns and the
    /// shape of that; it `is_blind` if it was predicted without a past.
    pub fn begin(&mut self, change: Change, continues: bool, is_blind: bool) {
        let state = &mut self.state;
        state.are_fresh = state.come_next;
        state.is_blind = is_blind;
        state.last = change;
        state.passes = Passes {
            with_columns: state.are_fresh,
            ..Passes::default()
        };
        if !continues {
            let off = state.off_by_length.filter(|_| !state.are_fresh);
            state.rate = state.rate.filter(|_| off.is_some());
            let trusted = self.unknown_rate.filter(|_| change.of_allowed.is_none());
            state.left_by_first = state.rate.or(trusted).zip(off).map(larger);
        }
        (state.first, state.first_of_size) = (change.of_usual, change.of_size);
    }

    /// Whether the step has to be corrected once more, and then whether with new columns.
    pub fn next_pass(&mut self) -> Option<bool> {
        let leaves_too_much = self.leaves_too_much();
        let state = &mut self.state;
        let is_wanted = match self.iterations {
            Some(iterations) => {
                let is_open = state.last.of_size > iterations.tolerance;
                state.passes.is_unconverged = is_open && state.passes.count == iterations.most;
                is_open && state.passes.count < iterations.most
            }
            None => {
                let is_blind = state.is_blind && state.passes.count == 0;
                // Passes with new columns that change more and more do not come to an end.
                let diverges = state.are_fresh
                    && state.passes.count > 1
                    && state.passes.rate.is_some_and(|rate| rate >= 1.0);
                let may_go_on = state.passes.count < self.settings.most_passes && !diverges;
                is_blind || leaves_too_much && may_go_on
            }
        };
        let is_too_slow = state.rate.is_some_and(|rate| rate > self.settings.too_slow);
        let needs_columns = is_too_slow || self.is_out_of_reach();
        if is_wanted && needs_columns {
            let because = "corrections do not converge in this step";
            tracing::debug!(because, rate = self.state.rate, "Jacobian refresh");
        }
        is_wanted.then_some(needs_columns)
    }

    /// Whether the passes that are left do not converge with columns of earlier steps.
    fn is_out_of_reach(&self) -> bool {
        let state = &self.state;
        let rate = state.rate.or(state.off_by_length);
        let (Some(iterations), Some(rate)) = (self.iterations, rate) else {
            return false;
        };
        let passes = iterations.most.saturating_sub(state.passes.count);
        let left = rate.powf(f64::from(passes));
        !state.are_fresh && left * state.last.of_size > iterations.tolerance
    }

    fn leaves_too_much(&self) -> bool {
        let state = &self.state;
        if state.last.of_usual == 0.0 {
            return false;
        }
        let left = match state.passes.count {
            _ if state.are_fresh => match (state.last.of_allowed, state.curvature) {
                (Some(change), Some(curvature)) => Some((curvature * change).min(1.0)),
                (Some(_), None) => None,
                (None, _) => state.fresh_rate,
            },
            // Where it is known by how much a correction may be off, columns are not trusted before a step has shown them.
            0 if state.last.of_allowed.is_some() => state.left_by_first,
            0 => state.left_by_first.or(self.unknown_rate),
            _ => state.rate,
        };
        if let Some(change) = state.last.of_allowed {
            let most = self.settings.most_of_allowed;
            let leaves = |share: f64| share > self.settings.rounding && share * change > most;
            // Where steps are fixed only what is known to be left of what is bearable counts, beside the rule below.
            match self.varies {
                true => return change > most && left.is_none_or(leaves),
                false if change <= self.settings.nothing => return false,
                // Corrections that grow from step to step feed on what the ones before have left.
                false
                    if state.curved > self.settings.linear
                        && state.first_of_size > self.settings.grown * state.calm =>
                {
                    return state.last.of_size > state.calm;
                }
                false
                    if change > most
                        && left.is_some_and(|left| left > self.settings.linear && leaves(left)) =>
                {
                    return true;
                }
                // The step before has shown that corrections miss their aim.
                false
                    if state
                        .fresh_rate
                        .is_some_and(|rate| rate > self.settings.astray) =>
                {
                    return state.last.of_usual > self.settings.most_left;
                }
                false => {}
            }
        }
        if self.rule == Jacobian::EveryStep || state.are_fresh {
            return false;
        }
        let noise = self.settings.above_noise * state.noise;
        let most = self.settings.most_left.max(noise);
        left.is_none_or(|share| share * state.last.of_usual > most)
    }

    /// After another correction.
    pub fn note_pass(&mut self, change: Change, with_columns: bool) {
        let state = &mut self.state;
        let rate = rate(change.of_usual, state.last.of_usual);
        state.note_curved(rate, &self.settings);
        if state.passes.count == 0 {
            state.left_by_first = Some(rate);
        }
        if state.are_fresh {
            state.fresh_rate = Some(rate);
            state.curvature = curvature(rate, state.last);
        }
        state.passes.count += 1;
        tracing::debug!(
            pass = state.passes.count,
            change = change.of_size,
            rate,
            with_columns,
            "corrected again"
        );
        state.passes.rate = Some(rate);
        state.passes.with_columns |= with_columns;
        state.last = change;
        state.are_fresh |= with_columns;
        if with_columns {
            (state.rate, state.left_by_first) = (None, None);
        } else {
            state.rate = Some(state.rate.unwrap_or_default().max(rate));
        }
    }

    /// After the last correction: whether the step is taken as it is, by the rule of the scene.
    pub fn check(&self) -> Result<(), Unconverged> {
        let state = &self.state;
        if let Some(unsolved) = self.unsolved() {
            return Err(unsolved);
        }
        let unconverged = self.iterations.filter(|_| state.passes.is_unconverged);
        let Some(iterations) = unconverged.filter(|own| own.otherwise != Otherwise::Warn) else {
            return Ok(());
        };
        let (change, passes) = (state.last, state.passes.count);
        let rate = state.passes.rate.unwrap_or(f64::NAN);
        let rejects = iterations.otherwise == Otherwise::Reject;
        // The rate falls at least with H, and the last change with its power.
        let share = (iterations.tolerance / change.of_size).powf(1.0 / f64::from(passes));
        Err(Unconverged {
            change,
            tolerance: iterations.tolerance,
            passes,
            rate,
            share: (rejects && rate < 1.0).then_some(share),
            rejects,
        })
    }

    /// Where the error of a step is known precisely and the scene says nothing of iterations: corrections that have not come to an end, and
    /// leave more than is allowed.
    fn unsolved(&self) -> Option<Unconverged> {
        let state = &self.state;
        let change = state
            .last
            .of_allowed
            .filter(|_| self.iterations.is_none() && self.varies)?;
        let rate = state.passes.rate?;
        (rate.min(1.0) * change > 1.0).then_some(Unconverged {
            change: state.last,
            tolerance: state.last.of_size / change,
            passes: state.passes.count,
            rate,
            share: None,
            rejects: true,
        })
    }

    /// The step is taken after all its corrections: what they tell decides about the columns of the next one, however often that is tried.
    pub fn accept(&mut self, step: MacroStep) {
        let (slow, state) = (self.settings.slow, &mut self.state);
        let calm = state.first_of_size.max(self.settings.least_calm);
        state.calm = calm.min(self.settings.memory * state.calm);
        state.is_slow = state.rate.is_some_and(|rate| rate > slow);
        state.is_struck = false;
        let is_borrowed = state.off_by_length.is_some_and(|off| off > 0.0);
        let before = if step.length == state.length {
            state.borrowed
        } else {
            0
        };
        state.borrowed = match is_borrowed && state.passes.count > 0 {
            true => before + 1,
            false => 0,
        };
        state.length = step.length;
    }

    /// Share that corrections have missed last, with columns of earlier steps or new ones.
    pub fn rate(&self) -> Option<f64> {
        let State {
            rate, fresh_rate, ..
        } = self.state;
        rate.zip(fresh_rate).map(larger).or(rate).or(fresh_rate)
    }

    /// How the corrections of the step went.
    pub fn passes(&self) -> Passes {
        self.state.passes
    }

    /// Whether it matters for later columns what the corrections have missed.
    pub fn learns(&self) -> bool {
        self.rule != Jacobian::EveryStep
    }

    /// Whether the columns at hand belong to the present step.
    pub fn has_fresh_columns(&self) -> bool {
        self.state.are_fresh
    }

    /// What is known, to be written.
    pub fn state(&self) -> State {
        self.state
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.state = state;
    }
}

fn larger((one, other): (f64, f64)) -> f64 {
    one.max(other)
}
