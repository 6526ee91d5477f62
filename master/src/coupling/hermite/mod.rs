//! Hermite coupling: multipliers that are polynomials of their own on every macro step.
//!
//! On the step from `T_N` to `T_{N+1}` a multiplier is a polynomial of degree 1 to 3 in `s = (t - T_N)/H`. Nothing of it comes
//! from steps before but, in the variants that are continuous, its start value. It has as many unknown values at equidistant
//! nodes as there are conditions ([`Variant`]), for APV
//!
//! ```text
//! lambda(s) = l_0 (1 - s)(1 - 2s) + l_1 4s(1 - s) + l_2 s(2s - 1)
//! g''(T_N) = 0,   g(T_{N+1}) / H^2 = 0,   g'(T_{N+1}) / H = 0
//! ```
//!
//! For free bodies the velocity at the end takes the mean of a load over the step, the position its mean weighted by `1 - s`:
//! `l_1` weighs 2/3 and 1/3, `l_2` 1/6 and 0. What the polynomial misses of the true multiplier,
//! `c H^3 s (s^2 - 6 s/5 + 3/10)`, then has no mean of either kind, so positions and velocities feel it only through
//! stiffness, damping and geometry: one power of `H` for each integration. That is why APV has order 5 where its multipliers,
//! which miss `c H^3/10` at the end, have order 3.
//!
//! Motion that is exchanged is a polynomial through position and velocity at both ends and the acceleration at the start: the
//! end values are unknowns, with the conditions that they are what the partner's outputs say (`arcs`). All conditions are
//! linearised about the prediction with columns of the workers for each shape, and solved together (`stack`).
//!
//! * `variant`: which conditions;
//! * `arcs`: the curves of all variables;
//! * `estimate`: the error of a step;
//! * `stack`: the equations of all unknowns.

mod again;
mod arcs;
mod estimate;
mod held;
mod sample;
mod stack;
mod variant;

use super::attempts::Attempts;
use super::columns::{Columns, Look, Measuring, Nodes, Resolution};
use super::condition::{SingularRow, check_finite};
use super::corrector::Corrector;
use super::error_estimate::{ErrorScales, Estimate};
use super::measure::Measure;
use super::position_error::PositionErrors;
use super::promise::Promise;
use super::shortfall::Shortfall;
use crate::error::RunError;
use crate::joint::Level;
use crate::layout::{Layout, Over};
use crate::results::Verdict;
use crate::signal::{Curves, History};
use crate::system::solve::{LinearSolver, SingularColumn};
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};
use crate::time::MacroStep;
use crate::workers::{Ahead, Parts};

use arcs::{Arcs, unknowns_of};
use held::Held;
use sample::Sample;
use stack::Stack;
pub use variant::Variant;

/// State of Hermite coupling between two macro steps.
pub struct Hermite {
    variant: Variant,
    arcs: Arcs,
    /// The curves before the last step.
    before: Arcs,
    multipliers: Vec<f64>,
    /// All variables at the start of the step.
    held: Vec<f64>,
    /// Whether `start` is linearised about the present macro point.
    start_is_known: bool,
    start: Linear,
    end: Linear,
    stack: Stack,
    solver: LinearSolver,
    start_solver: LinearSolver,
    sample: Sample,
    /// The corrected curves of the last step.
    settled: Sample,
    memory: Vec<f64>,
    /// What the linearised conditions ask for.
    solution: Vec<f64>,
    /// What is changed: the solution, and what it is foreseen to miss.
    change: Vec<f64>,
    shortfall: Shortfall,
    accelerations: Vec<f64>,
    attempts: Attempts,
    promise: Promise,
    /// Whether the look-ahead is the first one over its step.
    is_first: bool,
    /// Whether the step has columns and shape of the one before.
    continues: bool,
    /// Whether the responses at the start of a step are asked for with the next look-ahead: they are measured as often as those at its end.
    wants_start: bool,
    measure: Measure,
    /// Largest change of the unknowns of each variable.
    changes: Vec<f64>,
    /// Errors of the unknowns of multipliers as positions feel them.
    errors: Vec<f64>,
    position_errors: PositionErrors,
}

/// The conditions at one end of the step and the columns of the workers for them.
struct Linear {
    columns: Columns,
    system: System,
}

impl Linear {
    fn new(
        measuring: Measuring,
        looks: (Ahead, &'static [Level]),
        parts: &Parts,
        unknowns: Unknowns,
    ) -> Self {
        Self {
            columns: Columns::new(measuring, looks, &parts.layout, &unknowns),
            system: System::new(&parts.layout, unknowns),
        }
    }

    fn assemble<'a>(
        &mut self,
        parts: &'a Parts,
        outputs: impl Fn(usize) -> &'a [f64] + Copy,
        point: Point<'_>,
    ) {
        self.columns.difference(parts);
        self.system
            .assemble(&parts.layout, outputs, self.columns.all(), point);
    }
}

impl Hermite {
    /// The method from the first macro point, at which the outputs are known and `history` holds all variables.
    pub fn new(variant: Variant, measuring: Measuring, history: History, parts: &Parts) -> Self {
        let layout = &parts.layout;
        let size = layout.variables();
        let unknowns = unknowns_of(layout, variant);
        let mut arcs = Arcs::new(layout, variant, unknowns.clone(), history);
        start_motion(&mut arcs, parts);
        let looks = (Ahead::Now, &[Level::Acceleration][..]);
        let start = Linear::new(measuring, looks, parts, Unknowns::ends(layout));
        let start_solver = LinearSolver::new(start.system.pattern());
        let sample = Sample::new(&unknowns, size);
        let settled = Sample::new(&unknowns, size);
        let change = vec![0.0; unknowns.len()];
        let looks = (Ahead::Step, levels_of(variant, layout));
        let end = Linear::new(measuring, looks, parts, unknowns);
        let stack = Stack::new(layout, variant, &end.system, &start.system);
        Self {
            variant,
            multipliers: arcs.starts().take(layout.rows.len()).collect(),
            before: arcs.clone(),
            held: arcs.starts().collect(),
            arcs,
            start_is_known: false,
            start,
            end,
            solver: LinearSolver::new(stack.pattern()),
            start_solver,
            stack,
            sample,
            settled,
            memory: vec![0.0; size],
            errors: change.clone(),
            position_errors: PositionErrors::new(size),
            solution: change.clone(),
            shortfall: Shortfall::new(change.len()),
            change,
            accelerations: vec![0.0; size],
            attempts: Attempts::default(),
            promise: Promise::new(size),
            is_first: true,
            continues: false,
            wants_start: variant.starts_anew(),
            measure: Measure::new(layout),
            changes: vec![0.0; size],
        }
    }

    /// Fills in the look-ahead over `step` with the curves at hand.
    fn request_look(&mut self, parts: &mut Parts, with_columns: bool) {
        let look = Look {
            predicted: &self.arcs,
            raised: &self.arcs,
            ends: self.sample.ends(),
            with_columns,
        };
        self.end.columns.request(parts, look, &mut self.memory);
        self.continues &= !with_columns;
    }

    fn request_evaluation(&mut self, parts: &mut Parts, t: f64) {
        parts.prepare_evaluation(t);
        let held = Held {
            values: &self.held,
            attitudes: self.arcs.attitudes(),
        };
        let look = Look {
            predicted: &held,
            raised: &held,
            ends: &self.held,
            with_columns: true,
        };
        self.start.columns.request(parts, look, &mut self.memory);
    }

    /// Solves the linearised conditions for the change of the unknowns and takes it.
    fn solve(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        let (pattern, jacobian, change) = self.stack.equation();
        let solved = self.solver.solve(pattern, jacobian, change);
        solved.map_err(|SingularColumn(unknown)| {
            let singular = SingularRow {
                row: self.end.system.unknowns().variable(unknown),
                level: self.variant.level(),
            };
            singular.in_step(parts, step)
        })?;
        self.solution.copy_from_slice(change);
        self.change.copy_from_slice(change);
        if self.is_first {
            self.shortfall
                .complete_first(&mut self.change, self.continues);
        } else {
            self.shortfall.add_pass(&self.change);
        }
        self.arcs.change(&self.change);
        self.sample.take(&self.arcs);
        if self.is_first {
            self.attempts.correct(step.length, self.sample.ends());
        }
        check_finite(self.sample.ends(), parts, step)?;
        largest_changes(self.end.system.unknowns(), &self.change, &mut self.changes);
        self.foresee_accelerations(step.length);
        Ok(())
    }

    /// The second derivatives of exchanged motion at the end of the step: linearised outputs.
    fn foresee_accelerations(&mut self, step: f64) {
        if self.variant.level() < Level::Acceleration {
            return;
        }
        let system = &self.end.system;
        let accelerations = &mut self.accelerations;
        system.shift(Level::Acceleration, &self.solution, accelerations);
        let residual = system.residual(Level::Acceleration);
        for (acceleration, residual) in accelerations.iter_mut().zip(residual) {
            *acceleration = -(residual + *acceleration) / (step * step);
        }
    }
}

impl Corrector for Hermite {
    fn multipliers(&self) -> &[f64] {
        &self.multipliers
    }

    fn request_prediction(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        with_columns: bool,
    ) -> Result<(), RunError> {
        self.attempts.repeat();
        self.arcs.predict(step.length);
        self.sample.take(&self.arcs);
        check_finite(self.sample.ends(), parts, step)?;
        parts.prepare_prediction(step.start, step.length);
        self.is_first = true;
        self.promise.forget();
        self.continues = self.end.columns.begin(step.length, Nodes::default());
        self.request_look(parts, with_columns);
        // A step that is repeated starts from a point that is linearised about already.
        if self.wants_start && !self.start_is_known {
            self.request_evaluation(parts, step.start);
        } else {
            parts.forgo_evaluation();
        }
        Ok(())
    }

    fn correct(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        let predicted = |subsystem: usize| parts.subsystems[subsystem].predicted();
        let point = self.sample.point(step.length, self.arcs.attitudes());
        self.end.assemble(parts, predicted, point);
        if self.variant.starts_anew() && !self.start_is_known {
            self.linearise_start(parts);
        }
        let (end, start) = (&self.end.system, &self.start.system);
        self.stack.assemble_jacobian(end, start, step.length);
        self.stack.assemble_end(end, step.length);
        if self.is_first {
            // The accelerations are linear in the multipliers: the first correction meets these conditions.
            self.stack.assemble_start(start);
        }
        self.promise.take(end);
        self.solve(parts, step)
    }

    fn error_estimate(&mut self, parts: &Parts, step: MacroStep, scales: &ErrorScales) -> Estimate {
        self.estimate(parts, step, scales)
    }

    /// Nothing of a polynomial comes from steps before.
    fn restart(&mut self) {}

    fn request_advance(&mut self, parts: &mut Parts, _step: MacroStep) {
        let mut over = Over {
            curves: &self.arcs,
            memory: &mut self.memory,
        };
        for input in &parts.layout.inputs {
            let subsystem = &mut parts.subsystems[input.subsystem];
            input.signal(&mut over, subsystem.advance_signal(input.place));
        }
    }

    fn move_on(&mut self, _step: MacroStep) {
        let was_blind = !self.arcs.has_past();
        self.attempts.move_on();
        self.start.columns.settle();
        self.end.columns.settle();
        if !self.continues {
            self.shortfall.forget();
        }
        self.wants_start = self.variant.starts_anew() && !self.continues;
        self.before.copy_from(&self.arcs);
        self.arcs.move_on(self.sample.ends(), &self.accelerations);
        self.measure.move_on();
        if was_blind {
            self.measure.forget();
        }
        self.read_starts();
    }

    fn multipliers_at(&self, tau: f64, _length: f64, multipliers: &mut [f64]) {
        for (row, multiplier) in multipliers.iter_mut().enumerate() {
            *multiplier = self.before.value(row, tau);
        }
    }

    fn resolution(&self) -> &Resolution {
        self.end.columns.resolution()
    }

    fn judge(&mut self, parts: &Parts) -> Verdict {
        if self.variant.starts_anew() {
            self.linearise_start(parts);
            self.refine_multipliers();
        }
        self.promise.judge(&self.end.system, parts, &self.solution)
    }
}

/// The levels of the outputs that the conditions at `T_{N+1}` and exchanged motion are made of.
fn levels_of(variant: Variant, layout: &Layout) -> &'static [Level] {
    match layout.exchanged.iter().any(|one| one.rates.is_some()) {
        true => variant.level().up_to(),
        false => variant.ends(),
    }
}

/// Largest absolute change of the unknowns of every variable.
fn largest_changes(unknowns: &Unknowns, change: &[f64], largest: &mut [f64]) {
    for (variable, largest) in largest.iter_mut().enumerate() {
        let own = change[unknowns.of(variable)].iter();
        *largest = own.fold(0.0, |most, change| most.max(change.abs()));
    }
}

impl Hermite {
    /// Linearises `g''` at the present macro point about the outputs there.
    fn linearise_start(&mut self, parts: &Parts) {
        let now = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let point = Point::ends(&self.held, self.arcs.attitudes());
        self.start.assemble(parts, now, point);
        self.start_is_known = true;
    }

    /// The multipliers with which `g'' = 0` at the present macro point: the end values of the step before are as good as the
    /// polynomial is, these as good as the motion. Where nothing determines them the end values stay.
    fn refine_multipliers(&mut self) {
        let (pattern, jacobian, change) = self.start.system.level_equation(Level::Acceleration);
        if self.start_solver.solve(pattern, jacobian, change).is_ok() {
            for (multiplier, change) in self.multipliers.iter_mut().zip(change) {
                *multiplier += *change;
            }
        }
    }

    fn read_starts(&mut self) {
        self.start_is_known = false;
        for (held, start) in self.held.iter_mut().zip(self.arcs.starts()) {
            *held = start;
        }
        for (multiplier, start) in self.multipliers.iter_mut().zip(self.arcs.starts()) {
            *multiplier = start;
        }
    }
}

/// Gives exchanged motion the rates that the outputs at the first macro point tell.
fn start_motion(arcs: &mut Arcs, parts: &Parts) {
    for exchanged in &parts.layout.exchanged {
        let Some(rates) = &exchanged.rates else {
            continue;
        };
        let outputs = parts.subsystems[exchanged.subsystem].coupling_values();
        let speed = rates.speed(outputs, &Default::default());
        let acceleration = rates.acceleration(outputs);
        for component in 0..exchanged.size() {
            let variable = exchanged.first + component;
            arcs.set_rates(variable, speed[component], acceleration[component]);
        }
    }
}
