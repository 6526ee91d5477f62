//! The nonsmooth Gauss-Newton iteration of S2 eqs. (42) to (45) and (51) to (54).

use super::least_norm::{LeastNorm, is_regular};
use super::problem::{Law, Problem};
use super::solve::{Jacobian, Weights};
use crate::nonsmooth::matrix::{dense_solve, dot};

/// Iterations after which it is given up: the pattern of active contacts cycles. Where it converges, it takes 1 to 5.
const MOST_ITERATIONS: usize = 25;

/// Shortest step of a line search.
const SHORTEST: f64 = 0.02;
/// Share of the predicted fall of the residual that a step must bring.
const DESCENT: f64 = 0.05;

/// Whether steps are shortened where they make the residual grow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Damping {
    /// Full steps: they find the pattern of contacts at once, or cycle between patterns.
    None,
    /// Halved until the residual falls.
    LineSearch,
}

/// How the iteration is done.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Method {
    /// Its gradient.
    pub jacobian: Jacobian,
    /// Its parameter.
    pub weights: Weights,
    /// Largest residual at its end, as a share of the scale of the problem.
    pub tolerance: f64,
    /// Length of its steps.
    pub damping: Damping,
}

/// Room for the iteration.
#[derive(Debug, Clone, Default)]
pub struct GaussNewton {
    gradient: Vec<f64>,
    kept: Vec<f64>,
    pivots: Vec<usize>,
    step: Vec<f64>,
    least_norm: LeastNorm,
}

impl GaussNewton {
    /// Takes memory for this many rows.
    pub fn reserve(&mut self, rows: usize) {
        self.gradient.reserve(rows * rows);
        self.kept.reserve(rows * rows);
        self.pivots.reserve(rows);
        self.step.reserve(rows);
        self.least_norm.reserve(rows);
    }

    /// Improves `x` until the residual (m/s) is at most `tolerance` times the scale of the problem; the iterations that
    /// it took, or `None` if it does not get there.
    pub fn solve(&mut self, problem: &Problem, method: Method, x: &mut [f64]) -> Option<usize> {
        for iteration in 0..=MOST_ITERATIONS {
            let residual = problem.residual(x);
            if residual <= method.tolerance * problem.scale(x) {
                return Some(iteration);
            }
            self.assemble(problem, method, x);
            if !self.newton_step(x) {
                return None;
            }
            for (x, step) in x.iter_mut().zip(&self.step) {
                *x -= step;
            }
            if method.damping == Damping::LineSearch {
                self.shorten(problem, residual, x);
            }
        }
        None
    }

    /// Takes back parts of the last step until the residual falls below `before`, or little of it is left.
    fn shorten(&mut self, problem: &Problem, before: f64, x: &mut [f64]) {
        let mut share = 1.0;
        while share > SHORTEST && problem.residual(x) > (1.0 - DESCENT * share) * before {
            share *= 0.5;
            for (x, step) in x.iter_mut().zip(&self.step) {
                *x += share * step;
            }
        }
    }

    /// Forces for which all relative velocities are 0, of least norm where they are not determined.
    pub fn hold_all(&mut self, problem: &Problem, x: &mut Vec<f64>) {
        let n = problem.len();
        self.gradient.clear();
        self.step.clear();
        for row in 0..n {
            let weight = 1.0 / problem.diagonal(row);
            let entries = problem.row(row).iter().map(|g| weight * g);
            self.gradient.extend(entries);
            self.step.push(-weight * problem.free[row]);
        }
        x.clear();
        x.resize(n, 0.0);
        if self.newton_step(x) {
            x.copy_from_slice(&self.step);
        }
    }

    /// `f` to `step`, its gradient to `gradient`.
    fn assemble(&mut self, problem: &Problem, method: Method, x: &[f64]) {
        let n = problem.len();
        self.gradient.clear();
        self.gradient.resize(n * n, 0.0);
        self.step.clear();
        self.step.resize(n, 0.0);
        for row in 0..n {
            let weight = method.weights.of(problem.diagonal(row));
            let [first, second] = problem.defect(row, weight, x);
            self.step[row] += first;
            if let Law::Disc { .. } = problem.laws[row] {
                self.step[row + 1] += second;
            }
            self.linearise(problem, method.jacobian, weight, row, x);
        }
    }

    /// Rows of the gradient: `df/dx` of one law.
    fn linearise(
        &mut self,
        problem: &Problem,
        jacobian: Jacobian,
        weight: f64,
        row: usize,
        x: &[f64],
    ) {
        let n = problem.len();
        let own = &mut self.gradient[row * n..];
        let target = |row: usize| x[row] - weight * problem.velocity(row, x);
        let closed = |own: &mut [f64], row: usize| {
            for (own, g) in own.iter_mut().zip(problem.row(row)) {
                *own = weight * g;
            }
        };
        match problem.laws[row] {
            Law::Equality => closed(own, row),
            Law::Normal if target(row) >= 0.0 => closed(own, row),
            Law::Normal => own[row] = 1.0,
            Law::Friction {
                normal,
                coefficient,
            } => {
                let target = target(row);
                if target.abs() <= coefficient * x[normal].abs() {
                    closed(own, row);
                } else {
                    own[row] = 1.0;
                    if jacobian == Jacobian::Full {
                        own[normal] -= target.signum() * coefficient * sign(x[normal]);
                    }
                }
            }
            Law::Disc {
                normal,
                coefficient,
            } => {
                let target = [target(row), target(row + 1)];
                let size = target[0].hypot(target[1]);
                let radius = coefficient * x[normal].abs();
                if size <= radius {
                    closed(own, row);
                    closed(&mut own[n..], row + 1);
                    return;
                }
                let direction = target.map(|component| component / size);
                for i in 0..2 {
                    let own = &mut own[i * n..][..n];
                    own[row + i] = 1.0;
                    if jacobian == Jacobian::Full {
                        own[normal] -= direction[i] * coefficient * sign(x[normal]);
                    }
                    // The projection turns with its target.
                    for j in 0..2 {
                        let turn = f64::from(u8::from(i == j)) - direction[i] * direction[j];
                        let share = radius / size * turn;
                        own[row + j] -= share;
                        for (own, g) in own.iter_mut().zip(problem.row(row + j)) {
                            *own += share * weight * g;
                        }
                    }
                }
            }
            Law::Second => {}
            Law::Sliding { normal, factor } => {
                own[row] = 1.0;
                own[normal] -= factor * sign(x[normal]);
            }
        }
    }

    /// `step` becomes the step from `x` to a zero of the linearised problem; whether it is finite. Where rows depend on
    /// each other it goes to the zero of least norm, whatever stress between contacts `x` has: that would make
    /// friction.
    fn newton_step(&mut self, x: &[f64]) -> bool {
        let n = x.len();
        self.kept.clear();
        self.kept.extend_from_slice(&self.gradient);
        self.pivots.resize(n, 0);
        if is_regular(n, &mut self.kept, &mut self.pivots[..n]) {
            dense_solve(n, &self.kept, &self.pivots[..n], &mut self.step);
        } else {
            for (step, row) in self.step.iter_mut().zip(self.gradient.chunks_exact(n)) {
                *step = dot(row, x) - *step;
            }
            self.least_norm.solve(n, &self.gradient, &mut self.step);
            for (step, x) in self.step.iter_mut().zip(x) {
                *step = x - *step;
            }
        }
        self.step.iter().all(|step| step.is_finite())
    }
}

/// The derivative of `|x|` that is right for forces that come from above: 1 at 0.
fn sign(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}
