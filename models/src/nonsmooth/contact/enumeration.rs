//! All contact states in turn, for few contacts in the plane: what exists is found, and what is not unique is seen.

use super::least_norm::{LeastNorm, is_regular};
use super::problem::{Law, Problem};
use crate::nonsmooth::matrix::dense_solve;

/// Combinations of states that are tried at most: 4 contacts with friction.
const MOST_STATES: usize = 4096;
/// What may miss an inequality, as a share of the scale.
const SLACK: f64 = 1e-9;
/// Two solutions are different if their velocities differ by more than this share of the scale.
const DIFFERENT: f64 = 1e-7;

/// How many solutions there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Count {
    /// None.
    None,
    /// All solutions have the same velocities.
    One,
    /// Solutions with different velocities.
    Several,
    /// Too many contact states, or friction in space: not tried.
    Unknown,
}

/// State of one row.
#[derive(Debug, Clone, Copy, PartialEq)]
enum State {
    /// `x = 0`.
    Open,
    /// `xi = 0`.
    Held,
    /// `x = factor x_normal`.
    Sliding { normal: usize, factor: f64 },
}

/// Room for the enumeration.
#[derive(Debug, Clone, Default)]
pub struct Enumeration {
    states: Vec<State>,
    matrix: Vec<f64>,
    trial: Vec<f64>,
    velocities: Vec<f64>,
    factors: Vec<f64>,
    pivots: Vec<usize>,
    least_norm: LeastNorm,
}

impl Enumeration {
    /// Takes memory for this many rows.
    pub fn reserve(&mut self, rows: usize) {
        self.states.reserve(rows);
        self.matrix.reserve(rows * rows);
        self.trial.reserve(rows);
        self.velocities.reserve(rows);
        self.least_norm.reserve(rows);
    }

    /// Looks for all solutions; the first one found goes to `x` if `x` is none itself.
    pub fn solve(&mut self, problem: &Problem, x: &mut [f64]) -> Count {
        let choices = |law: &Law| match law {
            Law::Equality | Law::Sliding { .. } => Some(1),
            Law::Normal => Some(2),
            Law::Friction { .. } => Some(4),
            Law::Disc { .. } | Law::Second => None,
        };
        let number = problem
            .laws
            .iter()
            .map(choices)
            .try_fold(1_usize, |all, own| {
                all.checked_mul(own?).filter(|&all| all <= MOST_STATES)
            });
        let Some(number) = number else {
            return Count::Unknown;
        };
        let mut count = Count::None;
        if problem.residual(x) <= SLACK * problem.scale(x) {
            count = Count::One;
            self.keep_velocities(problem, x);
        }
        for index in 0..number {
            if !self.choose(problem, index) || !self.try_states(problem) {
                continue;
            }
            if count == Count::None {
                count = Count::One;
                x.copy_from_slice(&self.trial);
                self.keep_velocities(problem, x);
            } else if self.is_different(problem) {
                return Count::Several;
            }
        }
        count
    }

    fn keep_velocities(&mut self, problem: &Problem, x: &[f64]) {
        self.velocities.clear();
        let velocities = (0..problem.len()).map(|row| problem.velocity(row, x));
        self.velocities.extend(velocities);
    }

    fn is_different(&self, problem: &Problem) -> bool {
        let allowed = DIFFERENT * problem.scale(&self.trial);
        (0..problem.len())
            .any(|row| (problem.velocity(row, &self.trial) - self.velocities[row]).abs() > allowed)
    }

    /// The states of this number; whether they fit together: an open contact has one tangential state.
    fn choose(&mut self, problem: &Problem, mut index: usize) -> bool {
        self.states.clear();
        let mut fits = true;
        for law in &problem.laws {
            let state = match *law {
                Law::Equality | Law::Disc { .. } | Law::Second => State::Held,
                Law::Sliding { normal, factor } => State::Sliding { normal, factor },
                Law::Normal => {
                    let state = [State::Open, State::Held][index % 2];
                    index /= 2;
                    state
                }
                Law::Friction {
                    normal,
                    coefficient,
                } => {
                    let choice = index % 4;
                    index /= 4;
                    let is_open = self.states.get(normal) == Some(&State::Open);
                    fits &= is_open == (choice == 0);
                    let sliding = |factor| State::Sliding { normal, factor };
                    match choice {
                        0 => State::Open,
                        1 => State::Held,
                        2 => sliding(coefficient),
                        _ => sliding(-coefficient),
                    }
                }
            };
            self.states.push(state);
        }
        fits
    }

    /// Forces in these states, to `trial`; whether they meet all laws.
    fn try_states(&mut self, problem: &Problem) -> bool {
        let n = problem.len();
        self.matrix.clear();
        self.matrix.resize(n * n, 0.0);
        self.trial.clear();
        self.trial.resize(n, 0.0);
        for row in 0..n {
            let own = &mut self.matrix[row * n..][..n];
            match self.states[row] {
                State::Open => own[row] = 1.0,
                State::Held => {
                    let weight = 1.0 / problem.diagonal(row);
                    for (own, g) in own.iter_mut().zip(problem.row(row)) {
                        *own = weight * g;
                    }
                    self.trial[row] = -weight * problem.free[row];
                }
                State::Sliding { normal, factor } => {
                    own[row] = 1.0;
                    own[normal] -= factor;
                }
            }
        }
        self.solve_linear(n);
        problem.residual(&self.trial) <= SLACK * problem.scale(&self.trial)
    }

    /// `matrix trial = trial`: by elimination, or of least norm where the rows of contacts depend on each other.
    fn solve_linear(&mut self, n: usize) {
        self.factors.clear();
        self.factors.extend_from_slice(&self.matrix);
        self.pivots.resize(n, 0);
        if is_regular(n, &mut self.factors, &mut self.pivots[..n]) {
            dense_solve(n, &self.factors, &self.pivots[..n], &mut self.trial);
        } else {
            self.least_norm.solve(n, &self.matrix, &mut self.trial);
        }
    }
}
