//! The semi-implicit predictor/corrector methods of Schweizer & Lu (S1 Sects. 2 and 3.3).

use super::columns::{Columns, Look};
use super::condition::{Condition, check_finite};
use super::corrector::{Again, Corrector};
use super::layout::Over;
use super::measure::{Change, Measure};
use super::promise::Promise;
use super::solve::LinearSolver;
use super::system::{Point, System};
use super::unknowns::Unknowns;
use crate::cosimulation::{Ahead, Parts};
use crate::error::RunError;
use crate::results::Verdict;
use crate::scene::Increment;
use crate::signal::{Curve, History, Lagrange};
use crate::time::MacroStep;

/// State of a semi-implicit method between two macro steps.
pub struct SemiImplicit {
    condition: Condition,
    history: History,
    /// The history before the last step.
    before: History,
    rows: usize,
    predicted: Vec<f64>,
    change: Vec<f64>,
    corrected: Vec<f64>,
    promise: Promise,
    memory: Vec<f64>,
    columns: Columns,
    system: System,
    solvers: Vec<LinearSolver>,
    /// What another correction would change.
    remaining: Vec<f64>,
    measure: Measure,
    /// Whether the look-ahead is the first one over its step.
    is_first: bool,
    /// To what the columns belong.
    shape: Shape,
}

impl SemiImplicit {
    /// The method with coupling variables `history` up to the first macro point.
    pub fn new(
        condition: Condition,
        increment: Increment,
        history: History,
        parts: &Parts,
    ) -> Self {
        let size = parts.layout.variables();
        let zeros = || vec![0.0; size];
        let unknowns = Unknowns::ends(&parts.layout);
        let columns = Columns::new(increment, Ahead::Step, &parts.layout, &unknowns);
        let system = System::new(&parts.layout, unknowns);
        Self {
            condition,
            before: history.clone(),
            history,
            rows: parts.layout.rows.len(),
            predicted: zeros(),
            change: zeros(),
            corrected: zeros(),
            promise: Promise::new(size),
            memory: zeros(),
            columns,
            solvers: condition.solvers(&system),
            remaining: zeros(),
            measure: Measure::new(&parts.layout),
            is_first: true,
            shape: Shape::default(),
            system,
        }
    }
}

/// The step and the nodes of the polynomials to which columns belong.
#[derive(Default)]
struct Shape {
    length: f64,
    nodes: Vec<f64>,
}

impl Shape {
    fn note(&mut self, history: &History, length: f64) {
        self.length = length;
        self.nodes.clear();
        self.nodes.extend_from_slice(history.times());
    }

    fn is(&self, history: &History, length: f64) -> bool {
        self.length == length && self.nodes == history.times()
    }
}

impl Corrector for SemiImplicit {
    fn multipliers(&self) -> &[f64] {
        &self.history.newest()[..self.rows]
    }

    /// S1 eqs. (62) to (68), (73) to (76): columns, Jacobian, corrected coupling variables at `T_{N+1}`.
    fn correct(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        self.columns.difference(parts);
        let point = Point::ends(&self.predicted, self.history.attitudes());
        let outputs = |subsystem: usize| parts.subsystems[subsystem].predicted();
        self.system
            .assemble(&parts.layout, outputs, self.columns.all(), point);
        self.condition
            .solve(&mut self.system, &mut self.solvers, &mut self.change)
            .map_err(|singular| singular.in_step(parts, step))?;
        let ends = self.predicted.iter().zip(&self.change);
        for (corrected, (predicted, change)) in self.corrected.iter_mut().zip(ends) {
            *corrected = predicted + change;
        }
        self.promise.take(&self.system);
        if self.is_first {
            self.measure.note(&self.change);
        }
        check_finite(&self.corrected, parts, step)
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
        if with_columns {
            self.shape.note(&self.history, length);
        }
        Ok(())
    }

    fn move_on(&mut self, step: MacroStep) {
        self.before.copy_from(&self.history);
        self.history.push(step.length, &self.corrected);
    }

    fn move_back(&mut self) {
        std::mem::swap(&mut self.history, &mut self.before);
    }

    fn judge(&mut self, parts: &Parts) -> Verdict {
        self.promise.judge(&self.system, parts, &self.change)
    }

    fn again(&mut self) -> Option<&mut dyn Again> {
        Some(self)
    }
}

impl Again for SemiImplicit {
    /// The interpolation through the corrected end values takes the place of the extrapolation.
    fn request_pass(&mut self, parts: &mut Parts, step: MacroStep, with_columns: bool) {
        self.promise.remember(&self.system, &self.change);
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
        if with_columns {
            self.shape.note(&self.history, step.length);
        }
    }

    fn last_change(&self) -> Change {
        self.measure.of(&self.change, &self.corrected)
    }

    fn has_columns(&self, step: MacroStep) -> bool {
        self.shape.is(&self.history, step.length)
    }

    /// The solution for the conditions at the corrected outputs, with the matrix of the correction.
    fn remainder(&mut self, parts: &Parts) -> f64 {
        let point = Point::ends(&self.corrected, self.before.attitudes());
        let outputs = |subsystem: usize| parts.subsystems[subsystem].coupling_values();
        let system = &mut self.system;
        system.assemble_residuals(&parts.layout, outputs, point);
        system.drop_rounding(&parts.layout, point);
        self.condition
            .solve_again(system, &mut self.solvers, &mut self.remaining);
        self.measure.of(&self.remaining, &self.corrected).of_usual
    }
}
