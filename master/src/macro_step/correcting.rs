//! Prediction, look-ahead and correction of a macro step, and what they teach: what all methods with a corrector share.

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::impacts::Impacts;
use super::jacobian::{Jacobian, PointJacobian};
use super::rejection::singular;
use crate::accuracy::{Attempts, Change, Difference, PositionErrors, Tolerance};
use crate::error::RunError;
use crate::layout::Layout;
use crate::methods::Corrected;
use crate::policies::columns;
use crate::policies::deferred_correction::DeferredCorrection;
use crate::policies::degree::AutomaticDegrees;
use crate::policies::iteration::{IterationControl, Missed};
use crate::policies::linearisation_check::LinearisationCheck;
use crate::policies::norm::Norm;
use crate::policies::singular_positions::SingularPositions;
use crate::results::{Cause, Verdict};
use crate::system::Outputs;
use crate::system::unknowns::Unknowns;
use crate::time::MacroStep;
use crate::workers::{Ahead, Look, Workers};

/// What a corrector needs beside its method.
pub struct Corrector {
    /// The conditions at the end of the step.
    pub end: Jacobian,
    /// What the linearised conditions ask for.
    pub(super) solution: Vec<f64>,
    /// What is changed: the solution, and what it is foreseen to miss.
    pub(super) change: Vec<f64>,
    /// What another correction would change.
    remaining: Vec<f64>,
    /// Largest change of the unknowns of each variable.
    sizes: Vec<f64>,
    /// Solutions with polynomials of one degree and of two degrees less.
    pub(super) nested: [Vec<f64>; 2],
    /// Whether those of the last first correction are solved for, and whether there are such.
    pub(super) has_nested: Option<bool>,
    /// Errors of the unknowns of multipliers as positions feel them.
    pub(super) errors: Vec<f64>,
    pub(super) position_errors: PositionErrors,
    /// What the last change makes of the inputs.
    pub(super) raised: Vec<f64>,
    check: LinearisationCheck,
    pub(super) attempts: Attempts,
    deferred: DeferredCorrection,
    norm: Norm,
    /// How far the equations are from having no unique solution.
    pub singular_positions: SingularPositions,
    /// Whether the look-ahead is the first one over its step.
    is_first: bool,
    /// Whether it is another one with new columns.
    is_renewed: bool,
    /// Whether the step has columns and shape of the one before.
    continues: bool,
}

/// What a corrector remembers at a macro point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    columns: columns::State,
    deferred: DeferredCorrection,
    norm: Norm,
    singular_positions: SingularPositions,
}

impl Corrector {
    /// For these conditions.
    pub fn new(end: Jacobian, layout: &Layout) -> Self {
        let (size, unknowns) = (layout.variables(), end.system.unknowns().len());
        Self {
            end,
            solution: vec![0.0; unknowns],
            change: vec![0.0; unknowns],
            remaining: vec![0.0; unknowns],
            sizes: vec![0.0; size],
            nested: [vec![0.0; unknowns], vec![0.0; unknowns]],
            has_nested: None,
            errors: vec![0.0; unknowns],
            position_errors: PositionErrors::new(size),
            raised: Vec::new(),
            check: LinearisationCheck::new(size),
            attempts: Attempts::default(),
            deferred: DeferredCorrection::new(unknowns),
            norm: Norm::new(layout),
            singular_positions: SingularPositions::default(),
            is_first: true,
            is_renewed: false,
            continues: false,
        }
    }

    /// What is remembered, to be written.
    pub fn state(&self) -> State {
        State {
            columns: self.end.columns.state(),
            deferred: self.deferred.clone(),
            norm: self.norm.clone(),
            singular_positions: self.singular_positions.clone(),
        }
    }

    /// Goes on from what was written.
    pub fn resume(&mut self, state: State) {
        self.end.columns.resume(state.columns);
        self.deferred = state.deferred;
        self.norm = state.norm;
        self.singular_positions = state.singular_positions;
    }
}

/// All that takes part in the corrections of a run.
pub struct Correcting<'a> {
    /// What is coupled.
    pub layout: &'a Layout,
    /// The workers.
    pub workers: &'a mut Workers,
    /// The method.
    pub method: &'a mut dyn Corrected,
    /// What it shares with others.
    pub own: &'a mut Corrector,
    /// The conditions at the present macro point, for methods that have them.
    pub point: Option<&'a mut PointJacobian>,
    /// Impacts within the step, where there may be any.
    pub impacts: Option<&'a mut Impacts>,
    /// Whether a shorter step may follow a failure.
    pub varies: bool,
}

impl Correcting<'_> {
    /// Predicts all variables over `step`.
    pub fn predict(&mut self, step: MacroStep) {
        self.own.attempts.repeat();
        self.method.predict(step.length);
    }

    /// Whether the look-ahead over `step`, which is predicted, brings new columns.
    pub fn decide_columns(&mut self, iteration: &mut IterationControl, step: MacroStep) -> bool {
        let mut found = None;
        if !iteration.needs_new_columns() {
            let (layout, nodes) = (self.layout, self.method.nodes());
            let columns = &mut self.own.end.columns;
            self.method.lend(&mut |_, raised| {
                found = columns.prepare(layout, (step.length, nodes), raised);
            });
        }
        iteration.decide_columns(step, found)
    }

    /// Lets the next exchange look ahead over `step`, with a perturbed input for each column of the coupling Jacobian if `with_columns`;
    /// otherwise earlier columns stay in use.
    pub fn request_prediction(
        &mut self,
        step: MacroStep,
        with_columns: bool,
    ) -> Result<(), RunError> {
        check_finite(self.method.ends(), self.layout, step)?;
        (self.own.is_first, self.own.is_renewed) = (true, false);
        self.own.check.forget();
        self.request_look(step, with_columns, Cause::Predictor);
        let nodes = self.method.nodes();
        let continues = self.own.end.columns.begin(step.length, nodes);
        self.own.continues = continues && !with_columns;
        // A step that is repeated starts from a point that is linearised about already.
        match self.point.as_mut().filter(|point| point.is_missing()) {
            Some(point) => point.request(self.workers, self.layout, self.method, step.start),
            None => self.workers.forgo_look(Ahead::Now),
        }
        Ok(())
    }

    fn request_look(&mut self, step: MacroStep, with_columns: bool, cause: Cause) {
        let (layout, workers) = (self.layout, &mut *self.workers);
        let (method, columns) = (&*self.method, &mut self.own.end.columns);
        method.lend(&mut |curves, raised| {
            let look = Look {
                ahead: Ahead::Step,
                t: step.start,
                length: step.length,
                curves,
                raised,
                perturbed: columns.ask(layout, raised, method.ends(), with_columns),
                cause,
            };
            workers.request_look(layout, look);
        });
    }

    /// Lets the next exchange look ahead over nothing.
    pub fn forgo_look(&mut self) {
        self.workers.forgo_look(Ahead::Step);
        self.workers.forgo_look(Ahead::Now);
    }

    /// Looks ahead over `step` as requested.
    #[tracing::instrument(name = "look_ahead", level = "trace", skip_all, fields(t = step.start, H = step.length))]
    pub fn look(&mut self, step: MacroStep) -> Result<(), RunError> {
        match self.varies {
            true => self.workers.try_look(step),
            false => self.workers.exchange(step),
        }
    }

    /// Another look-ahead over `step` from the same macro point, with the corrected inputs in place of the predicted ones.
    pub fn look_again(&mut self, step: MacroStep, with_columns: bool) -> Result<(), RunError> {
        let own = &mut *self.own;
        own.check.remember(&own.end.system, &own.solution);
        (own.is_first, own.is_renewed) = (false, with_columns);
        own.continues &= !with_columns;
        self.workers.forgo_advance();
        self.request_look(step, with_columns, Cause::Pass);
        self.workers.forgo_look(Ahead::Now);
        self.look(step)
    }

    /// Solves for the coupling variables at the end of `step` from the answers to the look-ahead over it. The time that it took.
    #[tracing::instrument(name = "correction", level = "trace", skip_all)]
    pub fn correct(&mut self, step: MacroStep) -> Result<Duration, RunError> {
        let started = Instant::now();
        self.linearise();
        let own = &mut *self.own;
        own.has_nested = None;
        let start = self.point.as_ref().map(|point| point.system());
        let system = &mut own.end.system;
        self.method
            .solve(system, start, own.is_first, &mut own.solution)
            .map_err(|row| singular(row, self.layout, step))?;
        own.check.take(system);
        own.change.copy_from_slice(&own.solution);
        match own.is_first {
            true => own.deferred.complete_first(&mut own.change, own.continues),
            false if own.is_renewed && self.method.tells_error() => own.deferred.renew(),
            false => own.deferred.add_pass(&own.change),
        }
        self.method.correct(&own.change, &own.solution, system);
        let ends = self.method.ends();
        if own.is_first {
            own.attempts.correct(step.length, ends);
        }
        largest_changes(system.unknowns(), &own.change, &mut own.sizes);
        check_finite(ends, self.layout, step)?;
        Ok(started.elapsed())
    }

    /// Linearises the conditions about the answers to the look-ahead.
    pub(super) fn linearise(&mut self) {
        let ahead = self.workers.looked(Ahead::Step);
        let end = &mut self.own.end;
        end.linearise(self.layout, &ahead, self.method.point());
        if let (Some(point), Some(held)) = (self.point.as_mut(), self.method.held()) {
            let now = self.workers.looked(Ahead::Now);
            point.linearise_once(self.layout, &now, held);
        }
    }

    /// Requests the look-ahead over `step` once more, with new columns, because of impacts within it.
    pub(super) fn request_look_at_impacts(&mut self, step: MacroStep) {
        self.own.continues = false;
        self.workers.forgo_advance();
        self.request_look(step, true, Cause::Impact);
        self.workers.forgo_look(Ahead::Now);
    }

    /// The first correction is small enough: it counts among those that later ones are compared with.
    pub fn begin(
        &mut self,
        iteration: &mut IterationControl,
        step: MacroStep,
        tolerance: &Tolerance,
    ) {
        self.own.norm.note(&self.own.sizes);
        let change = self.size_of_change(step, tolerance);
        iteration.begin(change, self.own.continues, !self.method.has_past());
    }

    /// Size of the last correction; what follows from it is compared with the `tolerance` by methods whose error is known so precisely.
    pub fn size_of_change(&mut self, step: MacroStep, tolerance: &Tolerance) -> Change {
        let now = self.workers.now();
        let own = &mut *self.own;
        let change = own.norm.of(&own.sizes, self.method.ends());
        let tolerance = self.method.tells_error().then_some(tolerance);
        let of_allowed = tolerance.map(|tolerance| {
            let difference = Difference {
                layout: self.layout,
                outputs: Some(&now),
                step: step.length,
                system: &own.end.system,
                columns: own.end.columns.all(),
                unknowns: &own.change,
            };
            own.position_errors.largest(difference, tolerance).scaled
        });
        Change {
            of_allowed,
            ..change
        }
    }

    /// The step is taken.
    pub fn accept(&mut self, degrees: Option<&mut AutomaticDegrees>) {
        let own = &mut *self.own;
        let was_blind = !self.method.has_past();
        own.attempts.move_on();
        own.end.columns.settle();
        own.norm.move_on();
        if was_blind {
            own.norm.forget();
        }
        if !own.continues {
            own.deferred.forget();
        }
        if let Some(point) = &mut self.point {
            point.accept();
            point.is_wanted = !own.continues;
        }
        self.method.accept();
        if let Some(degrees) = degrees {
            degrees.accept();
            self.apply(degrees);
        }
    }

    /// How well the outputs after the advance meet what their linearisation promised.
    pub fn judge(&mut self) -> Verdict {
        let own = &mut *self.own;
        let now = self.workers.now();
        let solution = &own.solution;
        own.check
            .judge(&own.end.system, self.layout, &now, solution)
    }

    /// Learns from the outputs after the advance what the first correction of the step has missed, so that the next first
    /// correction takes it into account; of a step `with_new_columns`, what even they leave.
    pub fn learn(
        &mut self,
        step: MacroStep,
        with_new_columns: bool,
        tolerance: &Tolerance,
    ) -> Missed {
        let Corrector {
            end,
            remaining,
            sizes,
            norm,
            deferred,
            position_errors,
            ..
        } = &mut *self.own;
        let system = &mut end.system;
        let now = self.workers.now();
        let outputs = |subsystem: usize| now.of(subsystem);
        let point = self.method.corrected_point();
        system.assemble_residuals(self.layout, outputs, point);
        system.assemble_inside(self.layout, &now, None, point);
        self.method.remaining(system, remaining);
        let unknowns = system.unknowns();
        if with_new_columns {
            largest_changes(unknowns, remaining, sizes);
            norm.note_left(sizes);
        }
        let tolerance = self.method.tells_error().then_some(tolerance);
        let of_allowed = tolerance.map(|tolerance| {
            let difference = Difference {
                layout: self.layout,
                outputs: None,
                step: step.length,
                system,
                columns: end.columns.all(),
                unknowns: remaining,
            };
            position_errors.largest(difference, tolerance).scaled
        });
        let ends = self.method.corrected_point().w;
        let mut size = |change: &[f64]| {
            largest_changes(unknowns, change, sizes);
            norm.of(sizes, ends).of_usual
        };
        Missed {
            of_allowed,
            by_last: size(remaining),
            by_first: deferred.learn(remaining, size),
        }
    }
}

/// Largest absolute change of the unknowns of every variable.
fn largest_changes(unknowns: &Unknowns, change: &[f64], largest: &mut [f64]) {
    for (variable, largest) in largest.iter_mut().enumerate() {
        let own = change[unknowns.of(variable)].iter();
        *largest = own.fold(0.0, |most, change| most.max(change.abs()));
    }
}

/// Refuses coupling variables that have grown out of the range of numbers.
pub fn check_finite(variables: &[f64], layout: &Layout, step: MacroStep) -> Result<(), RunError> {
    match variables.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(row) => Err(RunError::Grown {
            t: step.end,
            step: step.length,
            variable: layout.variable_name(row),
            value: variables[row],
            growth: f64::MAX,
        }),
    }
}
