//! What partners at the joints of a system do in its impacts.
//!
//! The multipliers of the joints have impulses `P` in an impact. With the generalised directions `J_r = f(d_r) - f(0)` of their loads and
//! the mobility `Y` of the partners the velocities behind an impact obey
//!
//! ```text
//! M (v^+ - v^-) = W Lambda + J^T P,   J (v^+ - v^-) = -Y P
//! P = -K^-1 C Lambda,   K = Y + J M^-1 J^T,   C = J M^-1 W
//! ```
//!
//! so that the contacts see the Delassus matrix `W^T M^-1 W - C^T K^-1 C`. Joints that do not move relative to the system (`Y = 0`) are
//! constraints of it; without partners (`Y` without bound) `P = 0`.

use linchpin_worker::Interface;

use super::matrix::{add_scaled, dense_factor, dense_solve, dot};
use super::mechanics::{Mechanics, StepError};

/// Partners, and room to work.
#[derive(Debug, Clone, Default)]
pub struct Partners {
    interface: Interface,
    /// `J`, row by row.
    directions: Vec<f64>,
    /// `M^-1 J^T`, column by column.
    responses: Vec<f64>,
    /// `K` and its factors.
    matrix: Vec<f64>,
    pivots: Vec<usize>,
    /// `C` and `K^-1 C`, a column for each row of the contact problem.
    coupling: Vec<f64>,
    solved: Vec<f64>,
    /// `P`.
    impulses: Vec<f64>,
}

impl Partners {
    /// Partners with this interface; none without a row.
    pub fn new(interface: Interface) -> Option<Self> {
        let rows = interface.directions.len();
        (rows > 0).then(|| Self {
            pivots: vec![0; rows],
            impulses: vec![0.0; rows],
            interface,
            ..Self::default()
        })
    }

    /// The loads of the impulses `P` of the last impact, one for each input.
    pub fn loads(&self) -> Vec<f64> {
        let inputs = self.interface.directions.first().map_or(0, Vec::len);
        let mut loads = vec![0.0; inputs];
        for (direction, impulse) in self.interface.directions.iter().zip(&self.impulses) {
            add_scaled(*impulse, direction, &mut loads);
        }
        loads
    }

    /// `P` of the last impact.
    pub fn impulses(&self) -> &[f64] {
        &self.impulses
    }

    fn rows(&self) -> usize {
        self.interface.directions.len()
    }

    /// Takes the partners' part into the Delassus matrix of the problem, with the mass matrix that was factored last.
    ///
    /// # Errors
    /// [`StepError::Joints`].
    pub fn take_part(
        &mut self,
        mechanics: &mut Mechanics,
        [q, v]: [&[f64]; 2],
    ) -> Result<(), StepError> {
        let (n, rows) = (mechanics.order(), self.rows());
        self.directions.clear();
        self.directions.resize(rows * n, 0.0);
        let loads = self.interface.directions.iter();
        for (load, direction) in loads.zip(self.directions.chunks_exact_mut(n)) {
            mechanics.load_direction([q, v], load, direction);
        }
        self.responses.clear();
        self.responses.extend_from_slice(&self.directions);
        for response in self.responses.chunks_exact_mut(n) {
            mechanics.factors.solve(response);
        }
        self.matrix.clear();
        self.matrix.extend_from_slice(&self.interface.mobility);
        let entries = self.matrix.chunks_exact_mut(rows);
        for (row, direction) in entries.zip(self.directions.chunks_exact(n)) {
            for (entry, response) in row.iter_mut().zip(self.responses.chunks_exact(n)) {
                *entry += dot(direction, response);
            }
        }
        dense_factor(rows, &mut self.matrix, &mut self.pivots).map_err(StepError::Joints)?;
        self.coupling.clear();
        let contacts = mechanics.problem.len();
        for contact in 0..contacts {
            let direction = mechanics.direction(contact);
            let responses = self.responses.chunks_exact(n);
            self.coupling
                .extend(responses.map(|response| dot(response, direction)));
        }
        self.solved.clear();
        self.solved.extend_from_slice(&self.coupling);
        for column in self.solved.chunks_exact_mut(rows) {
            dense_solve(rows, &self.matrix, &self.pivots, column);
        }
        for (i, coupling) in self.coupling.chunks_exact(rows).enumerate() {
            for (j, solved) in self.solved.chunks_exact(rows).enumerate() {
                mechanics.problem.delassus[i * contacts + j] -= dot(coupling, solved);
            }
        }
        Ok(())
    }

    /// Finds the impulses `P` that answer those of the contacts, `x`.
    pub fn answer(&mut self, x: &[f64]) {
        self.impulses.fill(0.0);
        let rows = self.rows();
        for (solved, x) in self.solved.chunks_exact(rows).zip(x) {
            add_scaled(-x, solved, &mut self.impulses);
        }
    }

    /// `P^T J v` (J).
    pub fn power(&self, v: &[f64]) -> f64 {
        let rows = self.directions.chunks_exact(v.len()).zip(&self.impulses);
        rows.map(|(direction, impulse)| impulse * dot(direction, v))
            .sum()
    }

    /// Adds what the impulses `P` make of the velocities.
    pub fn respond(&self, v: &mut [f64]) {
        let n = v.len();
        for (response, impulse) in self.responses.chunks_exact(n).zip(&self.impulses) {
            add_scaled(*impulse, response, v);
        }
    }
}
