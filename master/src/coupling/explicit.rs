//! The explicit index-1 method of Gu & Asada (S1 ref. 16 and Sect. 4.1.3), for comparison.

use std::time::{Duration, Instant};

use super::columns::{Basis, Columns, Look, Measuring};
use super::condition::{Condition, check_finite};
use super::uncorrected::Uncorrected;
use crate::error::RunError;
use crate::layout::Over;
use crate::scene::{Formula, Increment};
use crate::signal::{Curve, History, Lagrange};
use crate::system::solve::LinearSolver;
use crate::system::unknowns::Unknowns;
use crate::system::{Point, System};
use crate::time::MacroStep;
use crate::workers::{Ahead, Parts, exchange};

/// `(mu d/dt + 1)^2 g = g + 2 mu g' + mu^2 g'' = 0` at `T_N` gives the multipliers, which are held over the step to
/// `T_{N+1}`, as exchanged variables are. `g''` depends on the multipliers at once, so a look-ahead of zero length suffices
/// and no macro step is repeated.
pub struct Explicit {
    mu: Formula,
    history: History,
    rows: usize,
    change: Vec<f64>,
    values: Vec<f64>,
    /// Multipliers of the last step that was taken.
    held: Vec<f64>,
    memory: Vec<f64>,
    columns: Columns,
    system: System,
    solvers: Vec<LinearSolver>,
}

impl Explicit {
    /// The method with time constant `mu` (s), from trial values of the coupling variables.
    pub fn new(mu: Formula, increment: Increment, history: History, parts: &Parts) -> Self {
        let size = parts.layout.variables();
        let unknowns = Unknowns::ends(&parts.layout);
        let looks = (Ahead::Step, parts.layout.level.up_to());
        let measuring = Measuring {
            increment,
            basis: Basis::Shapes,
            stay: false,
        };
        let columns = Columns::new(measuring, looks, &parts.layout, &unknowns);
        let system = System::new(&parts.layout, unknowns);
        Self {
            mu,
            rows: parts.layout.rows.len(),
            change: vec![0.0; size],
            values: history.newest().to_vec(),
            held: vec![0.0; parts.layout.rows.len()],
            history,
            memory: vec![0.0; size],
            columns,
            solvers: condition_of(mu.at(0.0)).solvers(&system),
            system,
        }
    }

    /// Evaluates the first macro point and solves for its multipliers.
    pub fn begin(&mut self, parts: &mut Parts, first: MacroStep) -> Result<(), RunError> {
        self.request_evaluation(parts, first.start);
        exchange(&mut parts.subsystems, first)?;
        self.solve(parts, first)?;
        self.take(0.0);
        Ok(())
    }

    /// Goes on with the solution.
    fn take(&mut self, length: f64) {
        self.columns.settle();
        self.history.push(length, &self.values);
    }

    fn request_evaluation(&mut self, parts: &mut Parts, t: f64) {
        parts.prepare_prediction(t, 0.0);
        let trial = self.history.newest();
        let over = |curve| Lagrange {
            history: &self.history,
            curve,
            length: 0.0,
        };
        let look = Look {
            predicted: &over(Curve::Extrapolated),
            raised: &over(Curve::Interpolated(trial)),
            ends: trial,
            with_columns: true,
        };
        self.columns.request(parts, look, &mut self.memory);
    }

    fn solve(&mut self, parts: &Parts, step: MacroStep) -> Result<(), RunError> {
        self.columns.difference(parts);
        let point = Point::ends(self.history.newest(), self.history.attitudes());
        let outputs = |subsystem: usize| parts.subsystems[subsystem].predicted();
        self.system
            .assemble(&parts.layout, outputs, self.columns.all(), point);
        condition_of(self.mu.at(step.length))
            .solve(
                step.length,
                &mut self.system,
                &mut self.solvers,
                &mut self.change,
            )
            .map_err(|singular| singular.in_step(parts, step))?;
        let trial = self.history.newest().iter().zip(&self.change);
        for (value, (trial, change)) in self.values.iter_mut().zip(trial) {
            *value = trial + change;
        }
        check_finite(&self.values, parts, step)
    }
}

impl Uncorrected for Explicit {
    fn multipliers(&self) -> &[f64] {
        &self.history.newest()[..self.rows]
    }

    /// Advances with the multipliers of the start, evaluates the end, solves there.
    fn advance(&mut self, parts: &mut Parts, step: MacroStep) -> Result<Duration, RunError> {
        parts.prepare_advance(step);
        // All variables are held: their polynomials have degree 0.
        let mut over = Over {
            curves: &Lagrange {
                history: &self.history,
                curve: Curve::Extrapolated,
                length: step.length,
            },
            memory: &mut self.memory,
        };
        for input in &parts.layout.inputs {
            let subsystem = &mut parts.subsystems[input.subsystem];
            input.signal(&mut over, subsystem.advance_signal(input.place));
        }
        self.request_evaluation(parts, step.end);
        exchange(&mut parts.subsystems, step)?;
        let started = Instant::now();
        self.solve(parts, step)?;
        Ok(started.elapsed())
    }

    fn move_on(&mut self, step: MacroStep) {
        self.held
            .copy_from_slice(&self.history.newest()[..self.rows]);
        self.take(step.length);
    }

    /// They are held over the step.
    fn multipliers_at(&self, _parts: &Parts, _sample: usize, multipliers: &mut [f64]) {
        multipliers.copy_from_slice(&self.held);
    }
}

/// `(mu d/dt + 1)^2 g = 0`
fn condition_of(mu: f64) -> Condition {
    Condition::Baumgarte {
        beta: Formula::from(2.0 * mu),
        gamma: Formula::from(mu * mu),
    }
}
