//! The length of a variable macro step: accepted or repeated, and how long the next one is.

use super::obstacle::{Kind, Obstacle};
use super::options::Options;
use crate::coupling::degree_choice::{MOST_GROWTH, Purpose};
use crate::coupling::error_estimate::{ErrorScales, Estimate};
use crate::error::RunError;
use crate::results::StepStatistics;
use crate::scene::{Scene, StepControl};
use crate::time::{MacroStep, TimePlan};
use crate::workers::Parts;

/// Share of the step that would just be accepted.
const SAFETY: f64 = 0.9;

/// Exponents of the controller, per order: proportional-integral, so that the step length does not swing.
const INTEGRAL: f64 = 0.7;
const PROPORTIONAL: f64 = 0.4;

/// A repeated step has at least this share of the rejected one.
const MOST_SHRINKING: f64 = 0.1;

/// A step that could be longer by no more than this factor keeps its length: histories and columns of equal steps are worth more.
const KEEP_TO: f64 = 1.25;

/// A step that should be shorter by no more than this factor keeps its length.
const KEEP_FROM: f64 = 0.95;

/// Where the solution is smooth, the multipliers of a repeated step change less by at least this power of its length.
const SMOOTH_ORDER: f64 = 0.5;

/// A length that is shorter than a power by this share is taken for it.
const ROUNDING: f64 = 1e-9;

/// Macro steps are the first one times powers of two with these parts of a whole exponent: columns of a length that comes back serve
/// again.
const LENGTHS_PER_OCTAVE: f64 = 16.0;

/// Smallest scaled error that the controller remembers.
const LEAST_ERROR: f64 = 1e-4;

/// Share of a step whose corrections do not converge, at a rate that does not tell by how much it is too long.
const DIVERGED: f64 = 0.5;

/// Share of a step that a worker could not take.
const FAILED: f64 = 0.25;

/// Accepted steps after a failure that stay below the length that failed: the error says nothing of failures.
const CAREFUL_STEPS: u32 = 20;

/// Chooses the lengths of the macro steps.
pub struct StepSize {
    control: StepControl,
    rule: Rule,
    scales: ErrorScales,
    /// Length of the first step in s.
    first: f64,
    /// Scaled error of the last accepted step.
    before: f64,
    /// Whether the present step is a repeated one.
    is_repeated: bool,
    /// The last attempt at the present step whose error was too large.
    rejected: Option<Rejected>,
    /// What has become of the look-ahead over the present step, if not its answer.
    refusal: Option<RunError>,
    /// Length that steps do not exceed, and how many more of them.
    careful: Option<(f64, u32)>,
    statistics: StepStatistics,
}

/// Where the lengths come from. If they are known beforehand, every step is accepted, and what remains to be chosen are degrees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Rule {
    /// They follow the error.
    Free,
    /// From a run in which they did.
    Given,
    /// They are all equal.
    Equal,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Rejected {
    length: f64,
    change: f64,
}

/// How a step is repeated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Repetition {
    /// With this length in s.
    pub length: f64,
    /// Whether the solution has jumped, so that what lies before the step says nothing about it.
    pub has_jumped: bool,
}

impl StepSize {
    /// From a first step of length `first`, at a start whose outputs are known.
    fn new(rule: Rule, control: StepControl, first: f64, parts: &Parts) -> Self {
        Self {
            rule,
            scales: ErrorScales::new(&control, parts),
            control,
            first,
            before: 1.0,
            is_repeated: false,
            rejected: None,
            refusal: None,
            careful: None,
            statistics: StepStatistics::default(),
        }
    }

    /// What error is allowed.
    pub fn scales(&self) -> &ErrorScales {
        &self.scales
    }

    /// Whether the lengths follow the error.
    pub fn varies(&self) -> bool {
        self.rule == Rule::Free
    }

    /// Steps so far, if their lengths follow the error.
    pub fn statistics(&self) -> Option<StepStatistics> {
        self.varies().then_some(self.statistics)
    }

    /// What degrees are chosen for, after a step with this error.
    pub fn purpose(&self, estimate: &Estimate) -> Purpose {
        match self.rule {
            Rule::Free if estimate.scaled > 1.0 => Purpose::Repetition,
            Rule::Free | Rule::Given => Purpose::LongestStep,
            Rule::Equal => Purpose::SmallestError,
        }
    }

    /// Keeps what has become of the look-ahead over the next step until that step is attempted.
    pub(super) fn keep_refusal(&mut self, refusal: Option<RunError>) {
        self.refusal = refusal;
    }

    /// The look-ahead over the present step must have an answer.
    pub(super) fn check_answered(&mut self) -> Result<(), Obstacle> {
        self.refusal
            .take()
            .map_or(Ok(()), |error| Err(error.into()))
    }

    /// The error of the step must be small enough, unless the lengths are given; `next` is the error that it would have had with the
    /// degrees that have been chosen for what follows.
    pub(super) fn check_error(
        &self,
        step: MacroStep,
        estimate: &Estimate,
        next: &Estimate,
        parts: &Parts,
    ) -> Result<(), Obstacle> {
        if self.purpose(estimate) != Purpose::Repetition {
            return Ok(());
        }
        Err(Obstacle {
            kind: Kind::Error {
                found: *estimate,
                next: *next,
            },
            error: Box::new(RunError::LeastStep {
                t: step.start,
                step: step.length,
                error: estimate.scaled,
                tolerance: self.control.tolerance,
                variable: estimate.suspect_name(parts),
            }),
        })
    }

    /// How the step is repeated; the error of the obstacle if it cannot be.
    pub(super) fn repeat(
        &mut self,
        step: MacroStep,
        obstacle: Obstacle,
    ) -> Result<Repetition, RunError> {
        let Obstacle { kind, error } = obstacle;
        let is_final = kind == Kind::Failed && !error.may_vanish_with_a_shorter_step();
        if is_final || !self.varies() {
            return Err(*error);
        }
        if step.length <= self.control.least_step {
            return Err(error.of_least_step());
        }
        let causes = &mut self.statistics.rejected_by_cause;
        let (count, share) = match kind {
            Kind::Error { next, .. } => {
                let share = SAFETY * next.scaled.powf(-1.0 / next.order as f64);
                (&mut causes.error, share)
            }
            Kind::NotConverged(share) => {
                let share = share.map_or(DIVERGED, |share| SAFETY * share);
                (&mut causes.not_converged, share)
            }
            Kind::Failed => (&mut causes.failed, FAILED),
        };
        *count += 1;
        self.statistics.rejected += 1;
        self.is_repeated = true;
        let length = step.length * share.clamp(MOST_SHRINKING, SAFETY);
        let length = self.allowed(length);
        let has_jumped = match kind {
            Kind::Error { found, next } => self.has_jumped(step, found.change, next.change),
            Kind::NotConverged(_) | Kind::Failed => {
                self.careful = Some((length.max(step.length / MOST_GROWTH), CAREFUL_STEPS));
                false
            }
        };
        let repetition = Repetition { length, has_jumped };
        log_rejection(step, kind, &error, repetition);
        Ok(repetition)
    }

    /// Whether the multipliers change hardly less in the present attempt at a step than in the one before, which was longer.
    /// The next attempt has the degrees that belong to the change `next`.
    fn has_jumped(&mut self, step: MacroStep, change: f64, next: f64) -> bool {
        let length = step.length;
        let change_of_next = Rejected {
            length,
            change: next,
        };
        let earlier = self.rejected.replace(change_of_next);
        earlier.is_some_and(|earlier| {
            let expected = (length / earlier.length).powf(SMOOTH_ORDER);
            change > expected * earlier.change
        })
    }

    /// Takes the step; the length of the next one in s. The `estimate` is that of the degrees that follow; errors before are compared only
    /// if the degrees stay.
    pub fn accept(&mut self, step: MacroStep, estimate: &Estimate, has_equal_degrees: bool) -> f64 {
        let power = |error: f64, exponent: f64| error.powf(exponent / estimate.order as f64);
        let scaled = estimate.scaled.max(LEAST_ERROR);
        let possible = SAFETY * power(scaled, -1.0);
        let smooth = match has_equal_degrees {
            true => SAFETY * power(scaled, -INTEGRAL) * power(self.before, PROPORTIONAL),
            false => possible,
        };
        let most = if self.is_repeated { 1.0 } else { MOST_GROWTH };
        let mut wish = match possible {
            KEEP_FROM..=KEEP_TO => step.length,
            _ => step.length * smooth.clamp(MOST_SHRINKING, most),
        };
        self.careful = self.careful.filter(|(_, steps)| *steps > 0);
        if let Some((longest, steps)) = &mut self.careful {
            wish = wish.min(*longest);
            *steps -= 1;
        }
        self.before = scaled;
        self.is_repeated = false;
        self.rejected = None;
        self.statistics.accept(step);
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
        let octaves = (length / self.first * (1.0 + ROUNDING)).log2();
        let exponent = (LENGTHS_PER_OCTAVE * octaves).floor() / LENGTHS_PER_OCTAVE;
        let StepControl {
            least_step,
            greatest_step,
            ..
        } = self.control;
        (self.first * exponent.exp2()).clamp(least_step, greatest_step)
    }

    /// Takes the outputs at the macro point that is reached.
    pub fn observe(&mut self, parts: &Parts) {
        self.scales.observe(parts);
    }
}

/// Why a step is repeated, and how.
fn log_rejection(step: MacroStep, kind: Kind, error: &RunError, repetition: Repetition) {
    let (tried, next) = (step.length, repetition.length);
    match (kind, error) {
        (Kind::Error { found, .. }, RunError::LeastStep { variable, .. }) => {
            tracing::debug!(
                H = tried,
                error = found.scaled,
                order = found.order,
                of = variable,
                next_H = next,
                has_jumped = repetition.has_jumped,
                "rejected: error above tolerance"
            );
        }
        (Kind::NotConverged(_), because) => {
            tracing::debug!(H = tried, next_H = next, %because, "rejected: not converged");
        }
        (_, because) => tracing::debug!(H = tried, next_H = next, %because, "rejected: failed"),
    }
}

/// Where the macro points lie: as the scene says, unless a study gives the steps.
pub(super) fn plan_of(scene: &Scene, options: &Options) -> TimePlan {
    let (start, end, first) = (scene.t_start, scene.t_end, scene.coupling.macro_step);
    match (&options.step_lengths, scene.coupling.step_control) {
        (Some(lengths), _) => TimePlan::given(start, end, lengths.clone()),
        (None, Some(_)) => TimePlan::variable(start, end, first),
        (None, None) => TimePlan::equidistant(start, end, first),
    }
}

/// Against which the errors of degrees are compared where no error is too large: only their ratios matter.
const ANY_ERROR: StepControl = StepControl {
    tolerance: 1.0,
    absolute_tolerance: 1e-3,
    least_step: 0.0,
    greatest_step: f64::INFINITY,
};

/// The control of the steps, if the scene asks for one, or of the degrees; outputs at the start are known.
pub(super) fn step_size_of(scene: &Scene, options: &Options, parts: &Parts) -> Option<StepSize> {
    let coupling = &scene.coupling;
    let (rule, control) = match (coupling.step_control, &options.step_lengths) {
        (Some(control), None) => (Rule::Free, control),
        _ if !coupling.has_automatic_degree() => return None,
        (Some(control), Some(_)) => (Rule::Given, control),
        (None, _) => (Rule::Equal, ANY_ERROR),
    };
    Some(StepSize::new(rule, control, coupling.macro_step, parts))
}
