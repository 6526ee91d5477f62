//! Why a scene has no macro-step map.

use linchpin_proto::readable::number;

use crate::error::RunError;

/// Why the macro-step map of a scene could not be had.
#[derive(Debug, thiserror::Error)]
pub enum ProbeError {
    /// The method remembers more than multipliers.
    #[error(
        "\"{name}\" exchanges motions or signals, which the method remembers besides the multipliers: there is no macro-step \
         map of the states and multipliers alone; use a map by simulation"
    )]
    Exchanges {
        /// The joint or connection.
        name: String,
    },
    /// The number of multipliers that are remembered changes.
    #[error(
        "coupling.degree = \"automatic\" changes from step to step how many multipliers are remembered; the macro-step map can be \
         had for whole numbers only, so use a map by simulation"
    )]
    ChangesDegree,
    /// The co-simulation could not start or failed within its first steps.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A subsystem does not say what its state is.
    #[error(
        "the model \"{model}\" of subsystem \"{subsystem}\" does not describe its states, so there is no macro-step map; \
         judge the stability by simulation"
    )]
    HiddenState {
        /// Name in the scene.
        subsystem: String,
        /// Its model.
        model: String,
    },
    /// A subsystem's solver makes errors of the size of its tolerance.
    #[error(
        "the solver of subsystem \"{subsystem}\" works to a tolerance of {tolerance}, so its steps are not linear in the \
         state; use an exact solver or one with fixed steps",
        tolerance = number(*tolerance)
    )]
    Inexact {
        /// Name in the scene.
        subsystem: String,
        /// What the worker reports.
        tolerance: f64,
    },
    /// The method remembers outputs that the probe cannot set.
    #[error(
        "penalty coupling of order gauss-seidel extrapolates outputs with degree {degree}, so it remembers earlier ones, which \
         cannot be set; its macro-step map can be had for coupling.exchanged_degree = 0 or coupling.order = \"jacobi\""
    )]
    RemembersOutputs {
        /// Degree of the polynomials.
        degree: usize,
    },
    /// An output that a model calls a state did not come back.
    #[error(
        "{column} is a state of its model but was not answered; the worker does not keep to the contract linchpin.v1"
    )]
    NotRecorded {
        /// Result column.
        column: String,
    },
    /// The scene does not stay at rest.
    #[error(
        "the scene is driven: from a state of zeros {column} becomes {value} in one macro step; only scenes without loads \
         from outside have a macro-step map",
        value = number(*value)
    )]
    Driven {
        /// Result column.
        column: String,
        /// Its value.
        value: f64,
    },
    /// Two macro steps are not twice the map.
    #[error(
        "the scene is not linear, or a subsystem has states that it does not describe: two macro steps bring {column} to \
         {found} instead of {expected}",
        found = number(*found), expected = number(*expected)
    )]
    NotLinear {
        /// Result column.
        column: String,
        /// What the co-simulation found.
        found: f64,
        /// What the map says.
        expected: f64,
    },
    /// The iteration for the eigenvalues failed.
    #[error(
        "the eigenvalues of the macro-step map ({size} x {size}) cannot be computed: the iteration does not converge"
    )]
    NoConvergence {
        /// Number of rows.
        size: usize,
    },
}
