//! A mechanical system with what every step needs of it: rows of contacts, contact problems, counters.

use super::contact::{ContactSettings, ContactSolver, Law, Problem, Solved, SolverKind, Unsolved};
use super::matrix::{BorderedBand, Factors, Shape, Singular, dot};
use super::stages::MOST_STAGES;
use super::state::Drive;
use super::system::{Contact, Instant, MechanicalSystem, Side, rows};

/// On which level closed contacts are held during the non-impulsive part of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// `g' = 0` at the end of the step: what S2 develops. Gaps drift by what one step leaves.
    Velocity,
    /// `g'' = 0` at the end of the step: for comparison (S2 Figs. 17, 18). Velocities drift.
    Acceleration,
}

/// How steps are taken, whatever the scheme.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Level of the contacts.
    pub level: Level,
    /// Whether the accelerations at the start agree with closed contacts. Otherwise they are those without contacts, as
    /// printed in S2 eqs. (25), (62), (83); then a constraint drifts and its force oscillates.
    pub has_consistent_start: bool,
    /// Whether accelerations are found anew behind an impact. Otherwise those before it go on, as in S2; then the
    /// schemes that carry accelerations lose their order.
    pub restarts_after_impacts: bool,
    /// Whether a contact that presses stays closed even if its gap drifted above 0. Otherwise it opens then, as S2 eq.
    /// (41) has it, and closes again with an impact; that happens where directions of contacts turn, as in rolling and
    /// rocking. Moreau's rule always looks at the gap alone.
    pub holds_pressed_contacts: bool,
    /// The iteration of a step ends when velocities change by less than this share of their size.
    pub tolerance: f64,
    /// Iterations of a step at most.
    pub most_iterations: usize,
    /// How contact problems are solved.
    pub contact: ContactSettings,
}

/// The defaults of [`Settings`].
pub const DEFAULT: Settings = Settings {
    level: Level::Velocity,
    has_consistent_start: true,
    restarts_after_impacts: true,
    holds_pressed_contacts: true,
    tolerance: 1e-12,
    most_iterations: 50,
    contact: super::contact::DEFAULT,
};

impl Default for Settings {
    fn default() -> Self {
        DEFAULT
    }
}

/// What was done since the start of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Counters {
    /// Steps.
    pub steps: u64,
    /// Iterations of stages.
    pub iterations: u64,
    /// Evaluations of mass matrix and forces.
    pub evaluations: u64,
    /// Factorisations of matrices of the size of the system; those of two coupled stages count as one.
    pub factorisations: u64,
    /// Contact problems that were not empty, by the solver that solved them: Gauss-Newton, the same restarted,
    /// Gauss-Seidel, enumeration.
    pub contact_problems: [u64; 4],
    /// Iterations of their solvers.
    pub contact_iterations: u64,
    /// Contact problems with several solutions (Painleve).
    pub ambiguous: u64,
    /// Contact problems in which a pressed contact jams: its force is that of an impact without collision (Painleve).
    pub jams: u64,
    /// Largest residual of a contact problem (m/s).
    pub largest_residual: f64,
    /// Largest change of the velocities in the last iteration of a step, as a share of their size.
    pub largest_change: f64,
}

/// Why a step fails.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The iteration of a stage does not converge.
    #[error(
        "the iteration of a step does not converge: after {iterations} iterations velocities still change by {change:.1e} of their \
         size; a smaller step helps"
    )]
    NotConverged {
        /// Iterations.
        iterations: usize,
        /// Last change, relative.
        change: f64,
    },
    /// The matrix of a step has no inverse.
    #[error("the effective mass matrix of a step is singular: {0}")]
    Singular(#[from] Singular),
    /// Forces of contacts were not found.
    #[error("{0}")]
    Contact(#[from] Unsolved),
    /// Velocities have grown without bound over the last steps.
    #[error(
        "the run is unstable: velocities have grown by a factor of {factor:.0e} within some hundred steps. An explicit scheme (moreau, \
         hets) needs omega step < 2 for every frequency; take a smaller step, or an implicit scheme"
    )]
    Unstable {
        /// By what factor.
        factor: f64,
    },
    /// Overflow.
    #[error(
        "the state is not finite any more: the step is beyond the limit of stability of the scheme, or the system is unstable"
    )]
    NotFinite,
}

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
