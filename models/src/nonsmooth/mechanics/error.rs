//! Why a step fails.

use crate::nonsmooth::contact::Unsolved;
use crate::nonsmooth::matrix::Singular;

/// Why a step fails.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The iteration of a stage does not converge.
    #[error(
        "the iteration of a step does not converge: after {iterations} iterations velocities still change by \
         {change:.1e} of their \
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
    /// The joints to other subsystems in an impact.
    #[error("the joints do not determine the impulses of an impact: {0}")]
    Joints(Singular),
    /// Forces of contacts were not found.
    #[error("{0}")]
    Contact(#[from] Unsolved),
    /// Velocities have grown without bound over the last steps.
    #[error(
        "the run is unstable: velocities have grown by a factor of {factor:.0e} within some hundred steps. An \
         explicit scheme (moreau, \
         hets) needs omega step < 2 for every frequency; take a smaller step, or an implicit scheme"
    )]
    Unstable {
        /// By what factor.
        factor: f64,
    },
    /// Overflow.
    #[error(
        "the state is not finite any more: the step is beyond the limit of stability of the scheme, or the system is \
         unstable"
    )]
    NotFinite,
}
