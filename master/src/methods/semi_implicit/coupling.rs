//! The semi-implicit predictor/corrector methods of Schweizer & Lu (S1 Sects. 2 and 3.3).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use crate::accuracy::{Attempts, CHORD_ORDER};
use crate::layout::{Exchanged, Layout};
use crate::methods::condition::{Condition, SingularRow};
use crate::methods::method::{Built, Corrected, CouplingMethod, LoadErrors, Reached};
use crate::methods::saved::{Saved, Unreadable};
use crate::signal::{Curve, Curves, ErrorShares, History, Lagrange, Nodes};
use crate::system::solve::LinearSolver;
use crate::system::unknowns::Unknowns;
use crate::system::{Outputs, Point, System};

/// Whose states are written; methods 1 and 2 remember the same.
const NAME: &str = "semi-implicit";

/// Multipliers and exchanged variables are Lagrange polynomials through past values: the prediction extrapolates them, the correction
/// has the value at the end of the step for one more node.
pub struct SemiImplicit {
    condition: Condition,
    rows: usize,
    solvers: Vec<LinearSolver>,
    state: State,
    /// Length of the step (s).
    length: f64,
    /// Values at its end.
    ends: Vec<f64>,
    /// Whether these are corrected: nodes of the polynomials.
    is_corrected: bool,
}

/// What is remembered at a macro point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    history: History,
    /// The history before the last step, its length (s) and the values at its end.
    before: History,
    last: f64,
    reached: Vec<f64>,
}

impl SemiImplicit {
    /// The method with coupling variables `history` up to the first macro point.
    pub fn build(condition: Condition, history: History, layout: &Layout) -> Built {
        let system = System::new(layout, Unknowns::ends(layout));
        let size = layout.variables();
        let method = Self {
            condition,
            rows: layout.rows.len(),
            solvers: condition.solvers(&system),
            state: State {
                before: history.clone(),
                history,
                last: 0.0,
                reached: vec![0.0; size],
            },
            length: 0.0,
            ends: vec![0.0; size],
            is_corrected: false,
        };
        Built {
            method: Box::new(method),
            end: Some((system, layout.level.up_to())),
            point: None,
        }
    }

    fn curves<'a>(&'a self, curve: Curve<'a>) -> Lagrange<'a> {
        Lagrange {
            history: &self.state.history,
            curve,
            length: self.length,
        }
    }

    /// Difference between the corrected end value of a variable and its extrapolation, and what it tells.
    fn miss(&self, variable: usize, change: f64, degree: Option<usize>) -> (f64, ErrorShares) {
        let history = &self.state.history;
        match degree {
            None => (change, history.error_shares(variable, self.length)),
            Some(degree) => {
                let end = self.ends[variable];
                history.miss_of_degree(variable, degree, end, self.length)
            }
        }
    }

    /// At the start, from the second attempt at the first step on.
    fn chord_error(&self, variable: usize, attempts: &Attempts) -> Option<f64> {
        let history = &self.state.history;
        let is_chord = history.is_chord(variable);
        let start = history.newest()[variable];
        is_chord
            .then(|| attempts.chord_error(variable, start))
            .flatten()
    }
}

impl CouplingMethod for SemiImplicit {
    /// S1 eq. (56).
    fn predict(&mut self, length: f64) {
        self.length = length;
        self.is_corrected = false;
        let history = &self.state.history;
        for (variable, end) in self.ends.iter_mut().enumerate() {
            *end = history.value(variable, Curve::Extrapolated, length, length);
        }
    }

    /// The extrapolation (S1 eq. 56), later the interpolation through the corrected end values (eq. 69); inputs are raised at these.
    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        let raised = self.curves(Curve::Interpolated(&self.ends));
        match self.is_corrected {
            true => to(&raised, &raised),
            false => to(&self.curves(Curve::Extrapolated), &raised),
        }
    }

    fn ends(&self) -> &[f64] {
        &self.ends
    }

    fn accept(&mut self) {
        let state = &mut self.state;
        state.before.copy_from(&state.history);
        state.history.push(self.length, &self.ends);
        state.last = self.length;
        state.reached.copy_from_slice(&self.ends);
    }

    fn reached(&mut self, _reached: Reached<'_>) -> Result<(), SingularRow> {
        Ok(())
    }

    fn multipliers(&self) -> &[f64] {
        &self.state.history.newest()[..self.rows]
    }

    fn multipliers_at(
        &self,
        tau: f64,
        _layout: &Layout,
        _outputs: &dyn Outputs,
        multipliers: &mut [f64],
    ) {
        let state = &self.state;
        let curve = Curve::Interpolated(&state.reached);
        for (row, multiplier) in multipliers.iter_mut().enumerate() {
            *multiplier = state.before.value(row, curve, state.last, tau);
        }
    }

    fn state(&self) -> Saved {
        Saved::new(NAME, &self.state)
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        self.state = state.read(NAME)?;
        Ok(())
    }

    fn corrected(&mut self) -> Option<&mut dyn Corrected> {
        Some(self)
    }
}

impl Corrected for SemiImplicit {
    fn point(&self) -> Point<'_> {
        Point::ends(&self.ends, self.state.history.attitudes())
    }

    fn nodes(&self) -> Nodes<'_> {
        Nodes {
            times: self.state.history.reached_times(),
            degrees: self.state.history.degrees(),
        }
    }

    /// S1 eqs. (66) to (68), (73) to (76).
    fn solve(
        &mut self,
        end: &mut System,
        _start: Option<&System>,
        _is_first: bool,
        solution: &mut [f64],
    ) -> Result<(), SingularRow> {
        self.condition
            .solve(self.length, end, &mut self.solvers, solution)
    }

    fn correct(&mut self, change: &[f64], _solution: &[f64], _end: &System) {
        self.is_corrected = true;
        for (end, change) in self.ends.iter_mut().zip(change) {
            *end += change;
        }
    }

    fn least_pivot(&self) -> f64 {
        let solvers = self.solvers.iter().map(LinearSolver::least_pivot);
        solvers.fold(1.0, f64::min)
    }

    fn load_errors(
        &self,
        _unknowns: &Unknowns,
        rows: usize,
        change: &[f64],
        degree: Option<usize>,
        errors: &mut [f64],
    ) -> LoadErrors {
        let mut found = LoadErrors::default();
        for row in 0..rows {
            let (miss, shares) = self.miss(row, change[row], degree);
            errors[row] = shares.position * miss;
            found.shares = shares;
            found.change = found.change.max(miss.abs());
        }
        found
    }

    fn exchanged_error(
        &self,
        _exchanged: &Exchanged,
        variable: usize,
        (_, change): (&Unknowns, &[f64]),
        degree: Option<usize>,
        attempts: &Attempts,
    ) -> (f64, usize) {
        match self.chord_error(variable, attempts) {
            Some(error) => (error, CHORD_ORDER),
            None => {
                let (miss, shares) = self.miss(variable, change[variable], degree);
                (shares.mean * miss, shares.order)
            }
        }
    }

    fn remaining(&mut self, end: &mut System, remaining: &mut [f64]) {
        let length = self.state.last;
        self.condition
            .solve_again(length, end, &mut self.solvers, remaining);
    }

    fn corrected_point(&self) -> Point<'_> {
        Point::ends(&self.state.reached, self.state.before.attitudes())
    }

    fn restart(&mut self) {
        self.state.history.restart(0..self.rows);
    }

    fn restart_exchanged(&mut self) {
        let variables = self.state.history.newest().len();
        self.state.history.restart(self.rows..variables);
    }

    fn set_degree(&mut self, variables: Range<usize>, degree: usize) {
        self.state.history.set_degree(variables, degree);
    }

    fn smooth_points(&self, variable: usize) -> usize {
        self.state.history.smooth_points(variable)
    }

    fn degree_of_last_step(&self, variable: usize) -> usize {
        self.state.before.interpolated_degree(variable)
    }
}
