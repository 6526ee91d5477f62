//! The semi-implicit predictor/corrector methods of Schweizer & Lu (S1 Sects. 2 and 3.3).

mod errors;

use super::attempts::Attempts;
use super::automatic_degrees::AutomaticDegrees;
use super::columns::{Basis, Columns, Look, Measuring, Nodes, Resolution};
use super::condition::{Condition, check_finite};
use super::corrector::{Again, Corrector, Missed};
use super::degree_choice::Purpose;
use super::error_estimate::{ErrorScales, Estimate};
use super::measure::{Change, Measure};
use super::position_error::PositionErrors;
use super::promise::Promise;
use super::shortfall::Shortfall;
use crate::error::RunError;
use crate::layout::Over;
use crate::results::{StepDegrees, Verdict};
use crate::signal::{Curve, History, Lagrange};
use crate::system::solve::LinearSolver;
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};
use crate::time::MacroStep;
use crate::workers::{Ahead, Parts};

/// State of a semi-implicit method between two macro steps.
pub struct SemiImplicit {
    condition: Condition,
    basis: Basis,
    history: History,
    /// The history before the last step.
    before: History,
    rows: usize,
    predicted: Vec<f64>,
    /// What the linearised conditions ask for.
    solution: Vec<f64>,
    /// What is changed: the solution, and what it is foreseen to miss.
    change: Vec<f64>,
    shortfall: Shortfall,
    corrected: Vec<f64>,
    attempts: Attempts,
    promise: Promise,
    /// Errors of the multipliers as the positions feel them.
    load_errors: Vec<f64>,
    position_errors: PositionErrors,
    memory: Vec<f64>,
    columns: Columns,
    system: System,
    solvers: Vec<LinearSolver>,
    /// What another correction would change.
    remaining: Vec<f64>,
    measure: Measure,
    /// Whether the look-ahead is the first one over its step.
    is_first: bool,
    /// Whether the step has columns and shape of the one before.
    continues: bool,
    /// Length of the step that was corrected last.
    solved: f64,
    /// Present if degrees follow the estimates.
    automatic: Option<AutomaticDegrees>,
}

impl SemiImplicit {
    /// The method with coupling variables `history` up to the first macro point.
    pub fn new(
        condition: Condition,
        measuring: Measuring,
        mut history: History,
        mut automatic: Option<AutomaticDegrees>,
        parts: &Parts,
    ) -> Self {
        if let Some(automatic) = &mut automatic {
            automatic.begin(&mut history);
        }
        let size = parts.layout.variables();
        let zeros = || vec![0.0; size];
        let unknowns = Unknowns::ends(&parts.layout);
        let looks = (Ahead::Step, parts.layout.level.up_to());
        let columns = Columns::new(measuring, looks, &parts.layout, &unknowns);
        let system = System::new(&parts.layout, unknowns);
        Self {
            condition,
            basis: measuring.basis,
            before: history.clone(),
            history,
            rows: parts.layout.rows.len(),
            predicted: zeros(),
            solution: zeros(),
            change: zeros(),
            shortfall: Shortfall::new(size),
            corrected: zeros(),
            attempts: Attempts::default(),
            promise: Promise::new(size),
            load_errors: zeros(),
            position_errors: PositionErrors::new(size),
            memory: zeros(),
            columns,
            solvers: condition.solvers(&system),
            remaining: zeros(),
            measure: Measure::new(&parts.layout),
            is_first: true,
            continues: false,
            solved: 0.0,
            automatic,
            system,
        }
    }
}

/// Past nodes and degrees of the polynomials over the next step, as far as responses to raised inputs depend on them.
fn nodes_of(basis: Basis, history: &History) -> Nodes<'_> {
    match basis {
        Basis::Shapes => Nodes {
            times: history.reached_times(),
            degrees: history.degrees(),
        },
        Basis::Powers => Nodes::default(),
    }
}

impl Corrector for SemiImplicit {
    fn multipliers(&self) -> &[f64] {
        &self.history.newest()[..self.rows]
    }

    /// S1 eqs. (62) to (68), (73) to (76): columns, Jacobian, corrected coupling variables at `T_{N+1}`.
    fn correct(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        self.solved = step.length;
        self.columns.difference(parts);
        let point = Point::ends(&self.predicted, self.history.attitudes());
        let outputs = |subsystem: usize| parts.subsystems[subsystem].predicted();
        self.system
            .assemble(&parts.layout, outputs, self.columns.all(), point);
        self.condition
            .solve(
                step.length,
                &mut self.system,
                &mut self.solvers,
                &mut self.solution,
            )
            .map_err(|singular| singular.in_step(parts, step))?;
        self.change.copy_from_slice(&self.solution);
        if self.is_first {
            self.shortfall
                .complete_first(&mut self.change, self.continues);
        } else {
            self.shortfall.add_pass(&self.change);
        }
        let ends = self.predicted.iter().zip(&self.change);
        for (corrected, (predicted, change)) in self.corrected.iter_mut().zip(ends) {
            *corrected = predicted + change;
        }
        if self.is_first {
            self.attempts.correct(step.length, &self.corrected);
        }
        self.promise.take(&self.system);
        check_finite(&self.corrected, parts, step)
    }

    fn error_estimate(&mut self, parts: &Parts, step: MacroStep, scales: &ErrorScales) -> Estimate {
        self.estimate(parts, step, scales)
    }

    fn choose_degrees(
        &mut self,
        parts: &Parts,
        step: MacroStep,
        scales: &ErrorScales,
        estimate: &Estimate,
        purpose: Purpose,
    ) -> Estimate {
        self.choose(parts, step, scales, estimate, purpose)
    }

    fn degrees(&self) -> StepDegrees {
        match &self.automatic {
            Some(automatic) => automatic.of_last_step(&self.before),
            None => StepDegrees::default(),
        }
    }

    fn restart(&mut self) {
        self.history.restart(self.rows);
        if let Some(automatic) = &mut self.automatic {
            automatic.restart(&mut self.history);
        }
    }

    /// S1 eq. (69): the interpolation through the corrected end value.
    fn request_advance(&mut self, parts: &mut Parts, step: MacroStep) {
        let mut over = Over {
            curves: &Lagrange {
                history: &self.history,
                curve: Curve::Interpolated(&self.corrected),
                length: step.length,
            },
            memory: &mut self.memory,
        };
        for input in &parts.layout.inputs {
            let subsystem = &mut parts.subsystems[input.subsystem];
            input.signal(&mut over, subsystem.advance_signal(input.place));
        }
    }

    /// S1 eqs. (56), (59): the extrapolation, and for every input the interpolation through its raised end value.
    fn request_prediction(
        &mut self,
        parts: &mut Parts,
        step: MacroStep,
        with_columns: bool,
    ) -> Result<(), RunError> {
        let length = step.length;
        self.attempts.repeat();
        for (variable, predicted) in self.predicted.iter_mut().enumerate() {
            let curve = Curve::Extrapolated;
            *predicted = self.history.value(variable, curve, length, length);
        }
        check_finite(&self.predicted, parts, step)?;
        parts.prepare_prediction(step.start, length);
        let over = |curve| Lagrange {
            history: &self.history,
            curve,
            length,
        };
        let look = Look {
            predicted: &over(Curve::Extrapolated),
            raised: &over(Curve::Interpolated(&self.predicted)),
            ends: &self.predicted,
            with_columns,
        };
        self.columns.request(parts, look, &mut self.memory);
        self.is_first = true;
        self.promise.forget();
        let nodes = nodes_of(self.basis, &self.history);
        self.continues = self.columns.begin(length, nodes) && !with_columns;
        Ok(())
    }

    fn move_on(&mut self, step: MacroStep) {
        self.attempts.move_on();
        self.before.copy_from(&self.history);
        self.history.push(step.length, &self.corrected);
        if let Some(automatic) = &mut self.automatic {
            automatic.move_on(&mut self.history);
        }
        self.columns.settle();
        self.measure.move_on();
        if !self.continues {
            self.shortfall.forget();
        }
    }

    fn multipliers_at(&self, tau: f64, length: f64, multipliers: &mut [f64]) {
        let curve = Curve::Interpolated(&self.corrected);
        for (row, multiplier) in multipliers.iter_mut().enumerate() {
            *multiplier = self.before.value(row, curve, length, tau);
        }
    }

    fn resolution(&self) -> &Resolution {
        self.columns.resolution()
    }

    fn judge(&mut self, parts: &Parts) -> Verdict {
        self.promise.judge(&self.system, parts, &self.solution)
    }
}

impl Again for SemiImplicit {
    /// The interpolation through the corrected end values takes the place of the extrapolation.
    fn request_pass(&mut self, parts: &mut Parts, step: MacroStep, with_columns: bool) {
        self.promise.remember(&self.system, &self.solution);
        self.predicted.copy_from_slice(&self.corrected);
        self.is_first = false;
        parts.prepare_pass(step);
        let curves = Lagrange {
            history: &self.history,
            curve: Curve::Interpolated(&self.predicted),
            length: step.length,
        };
        let look = Look {
            predicted: &curves,
            raised: &curves,
            ends: &self.predicted,
            with_columns,
        };
        self.columns.request(parts, look, &mut self.memory);
        self.continues &= !with_columns;
    }

    fn accept(&mut self) -> bool {
        self.measure.note(&self.change);
        self.continues
    }

    /// At the start the corrections are S1's.
    fn is_blind(&self) -> bool {
        false
    }

    fn last_change(&self) -> Change {
        self.measure.of(&self.change, &self.corrected)
    }

    fn prepare_columns(&mut self, parts: &Parts, step: MacroStep) -> Option<f64> {
        let curves = Lagrange {
            history: &self.history,
            curve: Curve::Extrapolated,
            length: step.length,
        };
        let step = (step.length, nodes_of(self.basis, &self.history));
        self.columns.prepare(&parts.layout, step, &curves)
    }

    /// The solution for the conditions at the corrected outputs, with the matrix of the correction.
    fn learn(&mut self, parts: &Parts, with_new_columns: bool) -> Missed {
        let point = Point::ends(&self.corrected, self.before.attitudes());
        let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let system = &mut self.system;
        system.assemble_residuals(&parts.layout, outputs, point);
        self.condition
            .solve_again(self.solved, system, &mut self.solvers, &mut self.remaining);
        if with_new_columns {
            self.measure.note_left(&self.remaining);
        }
        let (measure, values) = (&self.measure, &self.corrected);
        let size = |change: &[f64]| measure.of(change, values).of_usual;
        Missed {
            by_last: size(&self.remaining),
            by_first: self.shortfall.learn(&self.remaining, size),
        }
    }
}
