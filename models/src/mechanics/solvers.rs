//! The solvers that every model offers.

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Setup, Subsystem};

use super::adaptive::Adaptive;
use super::describe::{needed, optional};
use super::equation::EquationOfMotion;
use super::fixed::Fixed;
use super::joint_loads::JointLoads;
use super::run::Run;
use crate::integrators::radau::Tolerances;

/// Solver with step-size control: Radau IIA of order 5.
const RADAU5: &str = "radau5";
/// Solver with fixed steps: the classical Runge-Kutta method of order 4.
const RK4: &str = "rk4";

/// What a master is told about them; the first one is the default.
pub fn descriptions() -> Vec<v1::SolverKind> {
    vec![
        kind(
            RADAU5,
            "Radau IIA of order 5 with step-size control; perturbed steps repeat its internal steps",
            vec![
                optional("rtol", "", "relative error tolerance, greater than 0", 1e-8),
                optional(
                    "atol",
                    "",
                    "absolute error tolerance in the units of the states, greater than 0",
                    1e-8,
                ),
            ],
        ),
        kind(
            RK4,
            "classical Runge-Kutta method of order 4 with fixed steps",
            vec![needed(
                "step",
                "s",
                "longest internal step, greater than 0; a macro step is cut into equal parts",
            )],
        ),
    ]
}

/// One solver.
pub fn kind(name: &str, description: &str, options: Vec<v1::Parameter>) -> v1::SolverKind {
    v1::SolverKind {
        name: name.to_owned(),
        description: description.to_owned(),
        options,
        ..v1::SolverKind::default()
    }
}

/// The capabilities of a model with these solvers and planar or spatial markers, as far as they are the model's own.
pub fn capabilities() -> v1::Capabilities {
    v1::Capabilities {
        repeats_step_sequence: true,
        exportable_snapshot: true,
        joint_loads: true,
        output_integrals: true,
        impulses: true,
        ..v1::Capabilities::default()
    }
}

/// A solver with its options.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice {
    /// `radau5`.
    Adaptive(Tolerances),
    /// `rk4` with its longest internal step (s).
    Fixed(f64),
}

/// The solver of `setup`.
///
/// # Errors
/// [`SetupError`] if an option is out of its range or the solver is none of [`descriptions`].
pub fn choose(setup: &Setup) -> Result<Choice, SetupError> {
    match setup.solver() {
        RADAU5 => Ok(Choice::Adaptive(Tolerances {
            relative: setup.positive_option("rtol")?,
            absolute: setup.positive_option("atol")?,
        })),
        RK4 => setup.positive_option("step").map(Choice::Fixed),
        other => Err(SetupError::UnknownSolver {
            kind: other.to_owned(),
            known: [RADAU5, RK4].join(", "),
        }),
    }
}

/// The subsystem that moves by `equation` from `start`, advanced by the solver of `setup`.
///
/// # Errors
/// As [`choose`].
pub fn start<E: EquationOfMotion + 'static>(
    equation: E,
    start: E::State,
    setup: &Setup,
) -> Result<Box<dyn Subsystem>, SetupError>
where
    E::State: 'static,
{
    let dimension = E::STATE_NAMES.len();
    let joint_loads = JointLoads::of(setup);
    Ok(match choose(setup)? {
        Choice::Adaptive(tolerances) => {
            let adaptive = Adaptive::new(dimension, tolerances);
            Box::new(Run::new(equation, joint_loads, start, adaptive))
        }
        Choice::Fixed(step) => {
            let fixed = Fixed::new(dimension, step);
            Box::new(Run::new(equation, joint_loads, start, fixed))
        }
    })
}
