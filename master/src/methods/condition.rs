//! How the levels of the coupling conditions are put together to one equation for the multipliers.

use crate::joint::Level;
use crate::reading::Formula;
use crate::system::System;
use crate::system::solve::{LinearSolver, SingularColumn};

/// The equation that the corrected multipliers solve, linearised about the prediction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition {
    /// `g + beta g' + gamma g'' = 0` (S1 eqs. 15, 68).
    Baumgarte {
        /// s
        beta: Formula,
        /// s^2
        gamma: Formula,
    },
    /// Weighted mean of the multipliers that solve `g = 0`, `g' = 0` and `g'' = 0` (S1 eqs. 23, 76).
    Weighted {
        /// Weight of the velocity level.
        a: f64,
        /// Weight of the acceleration level.
        b: f64,
    },
}

/// No unique solution for the coupling variable of this number, on this level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SingularRow {
    /// Row of the system.
    pub row: usize,
    /// Level of the conditions; the highest for a sum of levels.
    pub level: Level,
}

impl Condition {
    /// A solver for each linear system of the condition.
    pub fn solvers(&self, system: &System) -> Vec<LinearSolver> {
        let systems = match self {
            Self::Baumgarte { .. } => 1,
            Self::Weighted { .. } => system.level().up_to().len(),
        };
        let solver = |_| system.solver();
        (0..systems).map(solver).collect()
    }

    /// Solves the linearised condition at the end of a step of this length for the change of the multipliers from their prediction.
    pub fn solve(
        &self,
        length: f64,
        system: &mut System,
        solvers: &mut [LinearSolver],
        change: &mut [f64],
    ) -> Result<(), SingularRow> {
        let level = system.level();
        match *self {
            Self::Baumgarte { beta, gamma } => {
                system.combine([1.0, beta.at(length), gamma.at(length)]);
                let (pattern, jacobian, own) = system.combined_equation();
                solvers[0]
                    .solve(pattern, jacobian, own)
                    .map_err(|SingularColumn(row)| SingularRow { row, level })?;
                change.copy_from_slice(own);
            }
            Self::Weighted { a, b } => {
                change.fill(0.0);
                let levels = level.up_to().iter().zip(weights(a, b));
                for ((&level, share), solver) in levels.zip(solvers) {
                    let (pattern, jacobian, own) = system.level_equation(level);
                    solver
                        .solve(pattern, jacobian, own)
                        .map_err(|SingularColumn(row)| SingularRow { row, level })?;
                    add(share, own, change);
                }
            }
        }
        Ok(())
    }

    /// Solves again with the matrices of the last [`Condition::solve`], for other residuals in `system`.
    pub fn solve_again(
        &self,
        length: f64,
        system: &mut System,
        solvers: &mut [LinearSolver],
        change: &mut [f64],
    ) {
        match *self {
            Self::Baumgarte { beta, gamma } => {
                system.combine_residuals([1.0, beta.at(length), gamma.at(length)]);
                let own = system.combined_rhs();
                solvers[0].solve_again(own);
                change.copy_from_slice(own);
            }
            Self::Weighted { a, b } => {
                change.fill(0.0);
                let levels = system.level().up_to().iter().zip(weights(a, b));
                for ((&level, share), solver) in levels.zip(solvers) {
                    let own = system.level_rhs(level);
                    solver.solve_again(own);
                    add(share, own, change);
                }
            }
        }
    }
}

/// Shares of the three levels in the multipliers (S1 eq. 76).
fn weights(a: f64, b: f64) -> [f64; 3] {
    [1.0, a, b].map(|weight| weight / (1.0 + a + b))
}

fn add(share: f64, own: &[f64], change: &mut [f64]) {
    for (change, own) in change.iter_mut().zip(own) {
        *change += share * *own;
    }
}
