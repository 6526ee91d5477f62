//! What was done.

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
