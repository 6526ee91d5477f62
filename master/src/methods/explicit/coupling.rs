//! The explicit index-1 method of Gu & Asada (S1 ref. 16 and Sect. 4.1.3), for comparison.

use serde::{Deserialize, Serialize};

use crate::layout::Layout;
use crate::methods::condition::{Condition, SingularRow};
use crate::methods::method::{Built, CouplingMethod, Reached};
use crate::methods::saved::{Saved, Unreadable};
use crate::reading::Formula;
use crate::signal::{Curve, Curves, Held, History, Lagrange};
use crate::system::solve::LinearSolver;
use crate::system::unknowns::Unknowns;
use crate::system::{Outputs, System};

/// Whose states are written.
const NAME: &str = "explicit";

/// `(mu d/dt + 1)^2 g = g + 2 mu g' + mu^2 g'' = 0` at `T_N` gives the multipliers, which are held over the step to
/// `T_{N+1}`, as exchanged variables are. `g''` depends on the multipliers at once, so an evaluation at the macro point suffices
/// and no macro step is repeated.
pub struct ExplicitCoupling {
    mu: Formula,
    rows: usize,
    solvers: Vec<LinearSolver>,
    change: Vec<f64>,
    values: Vec<f64>,
    length: f64,
    state: State,
}

/// What is remembered at a macro point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    history: History,
    /// Multipliers of the last step that was taken.
    held: Vec<f64>,
}

impl ExplicitCoupling {
    /// The method with time constant `mu` (s), from trial values of the coupling variables.
    pub fn build(mu: Formula, history: History, layout: &Layout) -> Built {
        let system = System::new(layout, Unknowns::ends(layout));
        let rows = layout.rows.len();
        let method = Self {
            mu,
            rows,
            solvers: condition_of(mu.at(0.0)).solvers(&system),
            change: vec![0.0; layout.variables()],
            values: history.newest().to_vec(),
            length: 0.0,
            state: State {
                held: history.newest()[..rows].to_vec(),
                history,
            },
        };
        Built {
            method: Box::new(method),
            end: None,
            point: Some((system, layout.level.up_to())),
        }
    }
}

impl CouplingMethod for ExplicitCoupling {
    fn predict(&mut self, length: f64) {
        self.length = length;
    }

    /// All variables are held: their polynomials have degree 0.
    fn lend(&self, to: &mut dyn FnMut(&dyn Curves, &dyn Curves)) {
        let held = Lagrange {
            history: &self.state.history,
            curve: Curve::Extrapolated,
            length: self.length,
        };
        to(&held, &held);
    }

    fn ends(&self) -> &[f64] {
        self.state.history.newest()
    }

    fn reached(&mut self, reached: Reached<'_>) -> Result<(), SingularRow> {
        let Some(system) = reached.point else {
            return Ok(());
        };
        let condition = condition_of(self.mu.at(self.length));
        condition.solve(self.length, system, &mut self.solvers, &mut self.change)?;
        let newest = self.state.history.newest();
        self.state.held.copy_from_slice(&newest[..self.rows]);
        let trial = newest.iter().zip(&self.change);
        for (value, (trial, change)) in self.values.iter_mut().zip(trial) {
            *value = trial + change;
        }
        self.state.history.push(self.length, &self.values);
        Ok(())
    }

    fn multipliers(&self) -> &[f64] {
        &self.state.history.newest()[..self.rows]
    }

    /// They are held over the step.
    fn multipliers_at(
        &self,
        _tau: f64,
        _layout: &Layout,
        _outputs: &dyn Outputs,
        multipliers: &mut [f64],
    ) {
        multipliers.copy_from_slice(&self.state.held);
    }

    fn state(&self) -> Saved {
        Saved::new(NAME, &self.state)
    }

    fn resume(&mut self, state: &Saved) -> Result<(), Unreadable> {
        self.state = state.read(NAME)?;
        Ok(())
    }

    fn held(&self) -> Option<Held<'_>> {
        Some(Held {
            values: self.state.history.newest(),
            attitudes: self.state.history.attitudes(),
        })
    }
}

/// `(mu d/dt + 1)^2 g = 0`
fn condition_of(mu: f64) -> Condition {
    Condition::Baumgarte {
        beta: Formula::from(2.0 * mu),
        gamma: Formula::from(mu * mu),
    }
}
