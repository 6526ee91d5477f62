//! The implicit stages of a step: equations of motion and contact laws at one or two instants, solved together.
//!
//! All schemes here write coordinates and accelerations of a stage as known parts plus multiples of the unknown
//! velocities of the stages, `q_r = q^_r + sum_c Q_rc v_c` and `a_r = a^_r + sum_c A_rc v_c`. The stages must meet
//! `M(q_r) a_r = f(t_r, q_r, v_r) + W(q_r) lambda_r` and the laws of contact for `W^T(q_r) v_r`.
//!
//! Each iteration solves that with the effective matrix of blocks `A_rc M_r + delta_rc C_r + Q_rc K_r`. Since the
//! residual has all terms, this is the fixed-point iteration of S2 eqs. (55), (75), (76), (85) where `K` and `C` are
//! the linear parts of the forces, and Newton's method where they are all of their derivatives.

use super::matrix::{BorderedBand, Factors, add_scaled, dot};
use super::mechanics::{Level, Mechanics, StepError};
use super::state::Step;

/// Stages at most.
pub const MOST_STAGES: usize = 2;

/// Below this share of their size, changes that do not fall any more are rounding.
const ROUNDING: f64 = 1e-9;

/// How coordinates and accelerations of the stages follow from their velocities.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coefficients {
    /// `Q_rc` (s).
    pub q: [[f64; MOST_STAGES]; MOST_STAGES],
    /// `A_rc` (1/s).
    pub a: [[f64; MOST_STAGES]; MOST_STAGES],
}

impl Coefficients {
    /// Those of a single stage.
    pub fn single(q: f64, a: f64) -> Self {
        let mut coefficients = Self::default();
        coefficients.q[0][0] = q;
        coefficients.a[0][0] = a;
        coefficients
    }
}

/// One stage: its known parts before, its motion after the solution.
#[derive(Debug, Clone, Default)]
pub struct Stage {
    /// Its instant, seconds since the start of the inputs.
    pub tau: f64,
    /// `q^`.
    pub known_q: Vec<f64>,
    /// `a^`.
    pub known_a: Vec<f64>,
    /// Velocities; before the solution the first guess.
    pub v: Vec<f64>,
    /// Coordinates.
    pub q: Vec<f64>,
    /// Accelerations.
    pub a: Vec<f64>,
    directions: Vec<f64>,
    rates: Vec<f64>,
}

/// The stages of a scheme and room for their solution.
#[derive(Debug, Clone)]
pub struct Stages {
    /// The stages.
    pub stages: Vec<Stage>,
    mass: BorderedBand,
    stiffness: BorderedBand,
    damping: BorderedBand,
    effective: BorderedBand,
    factors: Factors,
    force: Vec<f64>,
    /// What is left, then the free velocities: stages side by side.
    staged: Vec<f64>,
    responses: Vec<f64>,
    /// Largest velocity so far in this solution, without contact forces included: what changes are compared with. A
    /// solution near 0 would be compared with its own rounding.
    size: f64,
}

impl Stages {
    /// Room for `count` stages.
    pub fn new(mechanics: &Mechanics, count: usize) -> Self {
        let (n, shape) = (mechanics.order(), mechanics.shape());
        let row = || vec![0.0; n];
        let stage = || Stage {
            tau: 0.0,
            known_q: row(),
            known_a: row(),
            v: row(),
            q: row(),
            a: row(),
            directions: vec![0.0; n * mechanics.rows()],
            rates: vec![0.0; mechanics.rows()],
        };
        Self {
            stages: (0..count).map(|_| stage()).collect(),
            mass: BorderedBand::zeros(shape),
            stiffness: BorderedBand::zeros(shape),
            damping: BorderedBand::zeros(shape),
            effective: BorderedBand::zeros(shape.staged(count)),
            factors: Factors::new(shape.staged(count)),
            force: row(),
            staged: vec![0.0; count * n],
            responses: Vec::with_capacity(count * mechanics.rows() * count * n),
            size: 0.0,
        }
    }

    /// Solves the stages; `forces` has the rows of all contacts for every stage, from the last solution to this one.
    pub fn solve(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        coefficients: &Coefficients,
        forces: &mut [f64],
    ) -> Result<(), StepError> {
        let settings = mechanics.settings;
        let mut previous = f64::INFINITY;
        self.size = 0.0;
        for iteration in 1..=settings.most_iterations {
            mechanics.counters.iterations += 1;
            self.linearise(mechanics, step, coefficients)?;
            self.solve_contacts(mechanics, step, coefficients, forces)?;
            let change = self.accept_velocities();
            self.place(coefficients);
            if !change.is_finite() {
                return Err(StepError::NotFinite);
            }
            let is_rounding = iteration > 3 && change >= 0.5 * previous && change <= ROUNDING;
            if change <= settings.tolerance || is_rounding {
                let largest = &mut mechanics.counters.largest_change;
                *largest = largest.max(change);
                mechanics.judge_problem();
                return Ok(());
            }
            previous = change;
        }
        Err(StepError::NotConverged {
            iterations: settings.most_iterations,
            change: previous,
        })
    }

    /// Coordinates and accelerations of all stages from their velocities.
    fn place(&mut self, coefficients: &Coefficients) {
        for r in 0..self.stages.len() {
            let (mut q, mut a) = (
                std::mem::take(&mut self.stages[r].q),
                std::mem::take(&mut self.stages[r].a),
            );
            q.copy_from_slice(&self.stages[r].known_q);
            a.copy_from_slice(&self.stages[r].known_a);
            for (c, stage) in self.stages.iter().enumerate() {
                add_scaled(coefficients.q[r][c], &stage.v, &mut q);
                add_scaled(coefficients.a[r][c], &stage.v, &mut a);
            }
            self.stages[r].q = q;
            self.stages[r].a = a;
        }
    }

    /// Effective matrix and residual of the equations of motion; free velocities to `staged`.
    fn linearise(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        coefficients: &Coefficients,
    ) -> Result<(), StepError> {
        self.place(coefficients);
        self.effective.clear();
        let count = self.stages.len();
        for (r, stage) in self.stages.iter_mut().enumerate() {
            self.mass.clear();
            mechanics.system.mass(&stage.q, &mut self.mass);
            mechanics.force(step.drive, stage.tau, [&stage.q, &stage.v], &mut self.force);
            self.mass.multiply_add(-1.0, &stage.a, &mut self.force);
            for (i, &force) in self.force.iter().enumerate() {
                self.staged[count * i + r] = force;
            }
            self.stiffness.clear();
            self.damping.clear();
            let tangents = [&mut self.stiffness, &mut self.damping];
            let has_tangents =
                mechanics.tangents(step.drive, stage.tau, [&stage.q, &stage.v], tangents);
            for c in 0..count {
                let effective = &mut self.effective;
                effective.add_stage(count, [r, c], coefficients.a[r][c], &self.mass);
                if has_tangents {
                    effective.add_stage(count, [r, c], coefficients.q[r][c], &self.stiffness);
                }
            }
            if has_tangents {
                self.effective.add_stage(count, [r, r], 1.0, &self.damping);
            }
            if step.active.contains(&true) {
                mechanics.system.directions(&stage.q, &mut stage.directions);
                if mechanics.settings.level == Level::Acceleration {
                    let (q, v) = (&stage.q, &stage.v);
                    mechanics.system.direction_rates(q, v, &mut stage.rates);
                }
            }
        }
        mechanics.counters.factorisations += 1;
        self.factors.factor(&self.effective)?;
        self.factors.solve(&mut self.staged);
        for (r, stage) in self.stages.iter().enumerate() {
            for (i, &v) in stage.v.iter().enumerate() {
                self.staged[count * i + r] += v;
            }
        }
        self.size = self
            .staged
            .iter()
            .fold(self.size, |size, v| v.abs().max(size));
        Ok(())
    }

    /// Contact forces, and with them the velocities of the stages to `staged`.
    fn solve_contacts(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        coefficients: &Coefficients,
        forces: &mut [f64],
    ) -> Result<(), StepError> {
        let (n, rows, count) = (mechanics.order(), mechanics.rows(), self.stages.len());
        mechanics.begin_problem();
        if !step.active.contains(&true) {
            forces.fill(0.0);
            return Ok(());
        }
        for r in 0..count {
            mechanics.add_laws(step.active, r * rows);
        }
        self.responses.clear();
        self.responses
            .resize(mechanics.problem.len() * count * n, 0.0);
        let places = mechanics
            .active_rows
            .iter()
            .map(|&row| (row / rows, row % rows));
        for (response, (r, row)) in self.responses.chunks_exact_mut(count * n).zip(places) {
            let direction = &self.stages[r].directions[row * n..][..n];
            for (i, &value) in direction.iter().enumerate() {
                response[count * i + r] = value;
            }
            self.factors.solve(response);
        }
        for k in 0..mechanics.active_rows.len() {
            let (r, row) = (
                mechanics.active_rows[k] / rows,
                mechanics.active_rows[k] % rows,
            );
            let stage = &self.stages[r];
            let direction = &stage.directions[row * n..][..n];
            let along = |staged: &[f64]| match count {
                1 => dot(direction, staged),
                _ => {
                    let own = staged.iter().skip(r).step_by(count);
                    direction.iter().zip(own).map(|(d, v)| d * v).sum()
                }
            };
            let (shift, factor) = match mechanics.settings.level {
                Level::Velocity => (0.0, 1.0),
                Level::Acceleration => (
                    dot(direction, &stage.known_a) + stage.rates[row],
                    coefficients.a[0][0],
                ),
            };
            mechanics
                .problem
                .free
                .push(shift + factor * along(&self.staged));
            for response in self.responses.chunks_exact(count * n) {
                mechanics.problem.delassus.push(factor * along(response));
            }
        }
        mechanics.solve_problem(forces)?;
        let responses = self.responses.chunks_exact(count * n);
        for (response, &x) in responses.zip(mechanics.unknowns()) {
            add_scaled(x, response, &mut self.staged);
        }
        Ok(())
    }

    /// Takes the velocities in `staged`; their largest change as a share of their size.
    fn accept_velocities(&mut self) -> f64 {
        let count = self.stages.len();
        let (mut change, mut size) = (0.0_f64, self.size);
        let mut is_finite = true;
        for (r, stage) in self.stages.iter_mut().enumerate() {
            for (i, v) in stage.v.iter_mut().enumerate() {
                let new = self.staged[count * i + r];
                is_finite &= new.is_finite();
                change = change.max((new - *v).abs());
                size = size.max(new.abs()).max(v.abs());
                *v = new;
            }
        }
        self.size = size;
        match (is_finite, change == 0.0) {
            (false, _) => f64::NAN,
            (true, true) => 0.0,
            (true, false) => change / size,
        }
    }
}
