//! The order in which solvers are tried: what is fast first, what is robust behind it.

use super::enumeration::{Count, Enumeration};
use super::gauss_newton::{Damping, GaussNewton, Method};
use super::gauss_seidel;
use super::problem::Problem;
use super::uniqueness::Uniqueness;

/// What the gradient of the Gauss-Newton iteration has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Jacobian {
    /// All terms, so that it converges in as many steps as patterns of active contacts are tried.
    Full,
    /// As printed in S2 eqs. (43) and (52): without the derivative of the friction radius, so it converges linearly.
    AsPrinted,
}

/// The auxiliary parameter `r` of the projections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Weights {
    /// `r_k = 1/G_kk`: free of units.
    Automatic,
    /// The same number for all rows, as S2 has it (0.1 for forces, 0.1 dt for impulses).
    Fixed(f64),
}

impl Weights {
    /// `r` of a row with this `G_kk`.
    pub fn of(self, diagonal: f64) -> f64 {
        match self {
            Self::Automatic => 1.0 / diagonal,
            Self::Fixed(weight) => weight,
        }
    }
}

/// How contact problems are solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactSettings {
    /// Gradient of the Gauss-Newton iteration.
    pub jacobian: Jacobian,
    /// Parameter of the projections.
    pub weights: Weights,
    /// Largest residual that is a solution, as a share of the velocities that balance each other. Larger: forces of a
    /// step are less accurate than its motion; smaller than 1e-14: rounding does not allow it.
    pub tolerance: f64,
}

/// The defaults of [`ContactSettings`].
pub const DEFAULT: ContactSettings = ContactSettings {
    jacobian: Jacobian::Full,
    weights: Weights::Automatic,
    tolerance: 1e-13,
};

impl Default for ContactSettings {
    fn default() -> Self {
        DEFAULT
    }
}

/// A residual that is taken from a robust solver, as a share of the scale: projections converge linearly.
const ROBUST_TOLERANCE: f64 = 1e-11;

/// Which solver gave the forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolverKind {
    /// Nonsmooth Gauss-Newton from the forces of the last problem.
    GaussNewton,
    /// The same from zero forces, or from those that hold all contacts, or with shorter steps.
    GaussNewtonRestarted,
    /// Projections contact by contact.
    GaussSeidel,
    /// All contact states in turn.
    Enumeration,
}

/// Forces from which the Gauss-Newton iteration starts.
#[derive(Debug, Clone, Copy)]
enum Start {
    Last,
    Zero,
    /// Those that hold all contacts, pulling where they must: sticking contacts of coupled stages are found from there.
    Held,
}

/// Attempts in the order in which they are made.
const ATTEMPTS: [(Start, Damping); 6] = [
    (Start::Last, Damping::None),
    (Start::Zero, Damping::None),
    (Start::Held, Damping::None),
    (Start::Last, Damping::LineSearch),
    (Start::Zero, Damping::LineSearch),
    (Start::Held, Damping::LineSearch),
];

/// What is told of a problem that was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved {
    /// The solver that did it.
    pub solver: SolverKind,
    /// Its iterations or sweeps.
    pub iterations: usize,
    /// Residual in m/s, [`Problem::residual`].
    pub residual: f64,
    /// Whether other solutions with other velocities were found (Painleve).
    pub is_ambiguous: bool,
    /// Whether a pressed contact jams (Painleve), see [`Problem::jams`].
    pub jams: bool,
}

/// What else is known of a problem that was solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Judgement {
    /// Whether other solutions with other velocities were found (Painleve).
    pub is_ambiguous: bool,
    /// Whether a pressed contact jams (Painleve), see [`Problem::jams`].
    pub jams: bool,
}

/// Why there are no forces.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unsolved {
    /// No contact state meets all laws.
    #[error(
        "the contact problem has no solution: friction is so high that a contact jams (Painleve); an impact without \
         collision, \
         which is not modelled, would be the way on"
    )]
    NoSolution,
    /// No solver found one.
    #[error(
        "no solver of the contact problem got below a residual of {residual:.1e} m/s in {rows} rows"
    )]
    NotFound {
        /// The smallest residual that was reached.
        residual: f64,
        /// Size of the problem.
        rows: usize,
    },
    /// A row is not a number.
    #[error("the contact problem has values that are not finite")]
    NotFinite,
}

/// Solvers with their memory.
#[derive(Debug, Clone, Default)]
pub struct ContactSolver {
    gauss_newton: GaussNewton,
    enumeration: Enumeration,
    uniqueness: Uniqueness,
    trial: Vec<f64>,
}

impl ContactSolver {
    /// Takes memory for problems of this many rows, so that a first contact takes none.
    pub fn reserve(&mut self, rows: usize) {
        self.gauss_newton.reserve(rows);
        self.enumeration.reserve(rows);
        self.uniqueness.reserve(rows);
        self.trial.reserve(rows);
    }

    /// Forces `x` of a problem, from those that `x` has at the call (warm start), judged.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn solve(
        &mut self,
        problem: &Problem,
        settings: &ContactSettings,
        x: &mut [f64],
    ) -> Result<Solved, Unsolved> {
        let solved = self.find(problem, settings, x)?;
        let Judgement { is_ambiguous, jams } = self.judge(problem, x);
        Ok(Solved {
            is_ambiguous,
            jams,
            ..solved
        })
    }

    /// Whether other forces than `x` solve a problem as well. It costs about as much as the solution, so that of the
    /// problems of an iteration only the last one is judged.
    pub fn judge(&mut self, problem: &Problem, x: &[f64]) -> Judgement {
        if problem.is_empty() || self.uniqueness.is_certain(problem) {
            return Judgement::default();
        }
        self.trial.clear();
        self.trial.extend_from_slice(x);
        let count = self.enumeration.solve(problem, &mut self.trial);
        Judgement {
            is_ambiguous: count == Count::Several,
            jams: problem.jams(x),
        }
    }

    /// As [`ContactSolver::solve`], not judged.
    ///
    /// # Errors
    /// [`Unsolved`].
    pub fn find(
        &mut self,
        problem: &Problem,
        settings: &ContactSettings,
        x: &mut [f64],
    ) -> Result<Solved, Unsolved> {
        if problem.is_empty() {
            return Ok(Solved {
                solver: SolverKind::GaussNewton,
                iterations: 0,
                residual: 0.0,
                is_ambiguous: false,
                jams: false,
            });
        }
        let mut numbers = problem.delassus.iter().chain(&problem.free);
        if !numbers.all(|number| number.is_finite()) {
            return Err(Unsolved::NotFinite);
        }
        self.attempt(problem, settings, x)
    }

    fn attempt(
        &mut self,
        problem: &Problem,
        settings: &ContactSettings,
        x: &mut [f64],
    ) -> Result<Solved, Unsolved> {
        let solved = |solver, iterations, x: &[f64]| Solved {
            solver,
            iterations,
            residual: problem.residual(x),
            is_ambiguous: false,
            jams: false,
        };
        let &ContactSettings {
            jacobian,
            weights,
            tolerance,
        } = settings;
        for (attempt, (start, damping)) in ATTEMPTS.into_iter().enumerate() {
            self.trial.clear();
            let newton = &mut self.gauss_newton;
            match start {
                Start::Last => self.trial.extend_from_slice(x),
                Start::Zero => self.trial.resize(x.len(), 0.0),
                Start::Held => newton.hold_all(problem, &mut self.trial),
            }
            let method = Method {
                jacobian,
                weights,
                tolerance,
                damping,
            };
            if let Some(iterations) = newton.solve(problem, method, &mut self.trial) {
                x.copy_from_slice(&self.trial);
                let solver = match attempt {
                    0 => SolverKind::GaussNewton,
                    _ => SolverKind::GaussNewtonRestarted,
                };
                return Ok(solved(solver, iterations, x));
            }
        }
        self.trial.clear();
        self.trial.resize(x.len(), 0.0);
        if let Some(sweeps) = gauss_seidel::solve(problem, ROBUST_TOLERANCE, &mut self.trial) {
            x.copy_from_slice(&self.trial);
            return Ok(solved(SolverKind::GaussSeidel, sweeps, x));
        }
        let residual = problem.residual(&self.trial);
        self.trial.fill(f64::NAN);
        match self.enumeration.solve(problem, &mut self.trial) {
            Count::None => Err(Unsolved::NoSolution),
            Count::Unknown => Err(Unsolved::NotFound {
                residual,
                rows: problem.len(),
            }),
            Count::One | Count::Several => {
                x.copy_from_slice(&self.trial);
                Ok(solved(SolverKind::Enumeration, 1, x))
            }
        }
    }
}
