//! A mechanical system with what every step needs of it: rows of contacts, contact problems, counters.

mod counters;
mod error;
mod settings;

use super::contact::{ContactSolver, Law, Problem, Solved, SolverKind, Unsolved};
use super::matrix::{BorderedBand, Factors, Shape, Singular, dot};
use super::stages::MOST_STAGES;
use super::state::Drive;
use super::system::{Contact, Instant, MechanicalSystem, Side, rows};

pub use counters::Counters;
pub use error::StepError;
pub use settings::{DEFAULT, Level, Settings};

/// A system, its contacts in rows, and room to work.
pub struct Mechanics {
    /// The system.
    pub system: Box<dyn MechanicalSystem>,
    /// How steps are taken.
    pub settings: Settings,
    /// What was done.
    pub counters: Counters,
    contacts: Vec<Contact>,
    /// Row at which each contact starts.
    starts: Vec<usize>,
    shape: Shape,
    rows: usize,
    /// Input values at an instant.
    inputs: Vec<f64>,
    solver: ContactSolver,
    /// The contact problem that is being put together.
    pub problem: Problem,
    /// Numbers of its rows among all rows of all stages.
    pub active_rows: Vec<usize>,
    /// Its unknowns.
    unknowns: Vec<f64>,
    /// Mass matrix and its factors.
    pub mass: BorderedBand,
    /// Factors of the mass matrix.
    pub factors: Factors,
    /// `W^T`, all rows.
    pub directions: Vec<f64>,
    /// `(dW^T/dt) v`, all rows.
    pub rates: Vec<f64>,
    /// `M^-1 W`, for the rows that take part.
    responses: Vec<f64>,
}

impl Mechanics {
    /// A system with `inputs` inputs.
    pub fn new(system: Box<dyn MechanicalSystem>, inputs: usize, settings: Settings) -> Self {
        let contacts = system.contacts().to_vec();
        let shape = system.shape();
        let rows = rows(&contacts);
        let starts = contacts.iter().scan(0, |next, contact| {
            let start = *next;
            *next += contact.rows();
            Some(start)
        });
        // Schemes have two stages at most.
        let most = MOST_STAGES * rows;
        let (mut problem, mut solver) = (Problem::default(), ContactSolver::default());
        problem.reserve(most);
        solver.reserve(most);
        Self {
            starts: starts.collect(),
            shape,
            rows,
            inputs: vec![0.0; inputs],
            settings,
            counters: Counters::default(),
            solver,
            problem,
            active_rows: Vec::with_capacity(most),
            unknowns: Vec::with_capacity(most),
            mass: BorderedBand::zeros(shape),
            factors: Factors::new(shape),
            directions: vec![0.0; rows * shape.order()],
            responses: Vec::with_capacity(rows * shape.order()),
            rates: vec![0.0; rows],
            contacts,
            system,
        }
    }

    /// Coordinates.
    pub fn order(&self) -> usize {
        self.shape.order()
    }

    /// Structure of the matrices.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Rows of all contacts.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Contacts.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Row at which a contact starts.
    pub fn first_row(&self, contact: usize) -> usize {
        self.starts[contact]
    }

    /// Writes the forces at `tau` seconds after the start of the inputs.
    pub fn force(&mut self, drive: Drive<'_>, tau: f64, [q, v]: [&[f64]; 2], force: &mut [f64]) {
        drive.inputs.values_at(tau, &mut self.inputs);
        let at = Instant {
            t: drive.start + tau,
            q,
            v,
            inputs: &self.inputs,
        };
        self.counters.evaluations += 1;
        self.system.force(at, force);
    }

    /// Writes the generalised direction of a load, a value for each input: what it adds to the forces.
    pub fn load_direction(&self, [q, v]: [&[f64]; 2], load: &[f64], direction: &mut [f64]) {
        let forces = |inputs: &[f64]| {
            let mut forces = vec![0.0; q.len()];
            let at = Instant {
                t: 0.0,
                q,
                v,
                inputs,
            };
            self.system.force(at, &mut forces);
            forces
        };
        let (with, without) = (forces(load), forces(&vec![0.0; load.len()]));
        for (direction, (with, without)) in direction.iter_mut().zip(with.iter().zip(without)) {
            *direction = with - without;
        }
    }

    /// Adds `K` and `C`; whether there are any.
    pub fn tangents(
        &mut self,
        drive: Drive<'_>,
        tau: f64,
        [q, v]: [&[f64]; 2],
        [stiffness, damping]: [&mut BorderedBand; 2],
    ) -> bool {
        drive.inputs.values_at(tau, &mut self.inputs);
        let at = Instant {
            t: drive.start + tau,
            q,
            v,
            inputs: &self.inputs,
        };
        self.system.tangents(at, stiffness, damping)
    }

    /// Evaluates and factors `M(q)`.
    pub fn factor_mass(&mut self, q: &[f64]) -> Result<(), Singular> {
        self.mass.clear();
        self.system.mass(q, &mut self.mass);
        self.counters.factorisations += 1;
        self.factors.factor(&self.mass)
    }

    /// Evaluates `W^T(q)` if a contact takes part.
    pub fn direct(&mut self, q: &[f64], active: &[bool]) {
        if active.contains(&true) {
            self.system.directions(q, &mut self.directions);
        }
    }

    /// Begins a contact problem.
    pub fn begin_problem(&mut self) {
        self.problem.clear();
        self.active_rows.clear();
    }

    /// Adds the laws of the contacts that take part, on velocity level; `offset` is the number of rows of earlier
    /// stages.
    pub fn add_laws(&mut self, active: &[bool], offset: usize) {
        for (index, contact) in self.contacts.iter().enumerate() {
            if !active[index] {
                continue;
            }
            let normal = self.problem.laws.len();
            let coefficient = contact.friction;
            self.problem.laws.push(match contact.side {
                Side::Unilateral => Law::Normal,
                Side::Bilateral => Law::Equality,
            });
            match contact.tangents {
                0 => {}
                1 => self.problem.laws.push(Law::Friction {
                    normal,
                    coefficient,
                }),
                _ => self.problem.laws.extend([
                    Law::Disc {
                        normal,
                        coefficient,
                    },
                    Law::Second,
                ]),
            }
            let start = self.starts[index];
            self.active_rows
                .extend((start..start + contact.rows()).map(|row| offset + row));
        }
    }

    /// The row of `W^T` of a row of the problem that belongs to the only stage.
    pub fn direction(&self, row: usize) -> &[f64] {
        &self.directions[self.active_rows[row] * self.order()..][..self.order()]
    }

    /// Fills in `G = factor L M^-1 W` with the mass matrix that was factored last, and keeps `M^-1 W`. The rows of `L`
    /// are those that the laws are for: `W^T`, or other `laws`.
    pub fn add_delassus(&mut self, factor: f64, laws: Option<&[f64]>) {
        let n = self.order();
        self.responses.clear();
        for &row in &self.active_rows {
            let start = self.responses.len();
            let direction = &self.directions[row * n..][..n];
            self.responses.extend_from_slice(direction);
            self.factors.solve(&mut self.responses[start..]);
        }
        let laws = laws.unwrap_or(&self.directions);
        for &row in &self.active_rows {
            for response in self.responses.chunks_exact(n) {
                let entry = factor * dot(&laws[row * n..][..n], response);
                self.problem.delassus.push(entry);
            }
        }
    }

    /// `v += factor M^-1 W lambda` with the forces for which the laws hold for `L v` behind it, see
    /// [`Mechanics::add_delassus`]. Mass matrix and directions are those evaluated last.
    pub fn hold(
        &mut self,
        active: &[bool],
        factor: f64,
        laws: Option<&[f64]>,
        v: &mut [f64],
        forces: &mut [f64],
    ) -> Result<(), Unsolved> {
        let n = self.order();
        self.begin_problem();
        self.add_laws(active, 0);
        for &row in &self.active_rows {
            let laws = laws.unwrap_or(&self.directions);
            self.problem.free.push(dot(&laws[row * n..][..n], v));
        }
        self.add_delassus(factor, laws);
        self.solve_problem(forces)?;
        self.judge_problem();
        self.respond(factor, v);
        Ok(())
    }

    /// Solves the problem from the forces of the last one, which are replaced: 0 in all rows that do not take part.
    pub fn solve_problem(&mut self, forces: &mut [f64]) -> Result<(), Unsolved> {
        self.unknowns.clear();
        self.unknowns
            .extend(self.active_rows.iter().map(|&row| forces[row]));
        forces.fill(0.0);
        if self.problem.is_empty() {
            return Ok(());
        }
        let settings = self.settings.contact;
        let solved = self
            .solver
            .find(&self.problem, &settings, &mut self.unknowns)?;
        self.count(solved);
        for (&row, &force) in self.active_rows.iter().zip(&self.unknowns) {
            forces[row] = force;
        }
        Ok(())
    }

    /// Counts whether the problem that was solved last has other solutions: the last one of an iteration.
    pub fn judge_problem(&mut self) {
        let judgement = self.solver.judge(&self.problem, &self.unknowns);
        self.counters.ambiguous += u64::from(judgement.is_ambiguous);
        self.counters.jams += u64::from(judgement.jams);
    }

    /// `v += factor M^-1 W x` with the forces of the problem that was solved last.
    pub fn respond(&self, factor: f64, v: &mut [f64]) {
        let responses = self.responses.chunks_exact(self.order());
        for (response, &x) in responses.zip(&self.unknowns) {
            super::matrix::add_scaled(factor * x, response, v);
        }
    }

    /// Forces of the problem that was solved last.
    pub fn unknowns(&self) -> &[f64] {
        &self.unknowns
    }

    fn count(&mut self, solved: Solved) {
        let place = match solved.solver {
            SolverKind::GaussNewton => 0,
            SolverKind::GaussNewtonRestarted => 1,
            SolverKind::GaussSeidel => 2,
            SolverKind::Enumeration => 3,
        };
        let counters = &mut self.counters;
        counters.contact_problems[place] += 1;
        counters.contact_iterations += solved.iterations as u64;
        counters.largest_residual = counters.largest_residual.max(solved.residual);
    }
}
