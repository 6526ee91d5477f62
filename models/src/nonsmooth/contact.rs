//! The contact problem of one step or one impact: linear in the unknown forces, nonsmooth in its laws.
//!
//! Unknown are the forces `x` of the rows that take part (N, or N s for an impact); the relative velocities are
//! `xi = F + G x` (m/s) with the Delassus matrix `G` (S2 eqs. 30, 31). Each row has a [`Law`].
//!
//! * [`problem`]: the problem, its laws as projections, its residual;
//! * [`solve`]: the order in which solvers are tried, and what is told about it;
//! * [`gauss_newton`]: nonsmooth Gauss-Newton iteration (S2 eq. 43), with [`least_norm`] where contacts depend on each
//!   other;
//! * [`gauss_seidel`]: projections contact by contact, for dependent contacts where the iteration fails;
//! * [`uniqueness`]: whether a problem has one solution for sure;
//! * [`enumeration`]: all contact states in turn, which tells whether there is no solution or more than one.

pub mod enumeration;
pub mod gauss_newton;
pub mod gauss_seidel;
pub mod least_norm;
pub mod problem;
pub mod solve;
pub mod uniqueness;

pub use problem::{Law, Problem};
pub use solve::{
    ContactSettings, ContactSolver, DEFAULT, Jacobian, Judgement, Solved, SolverKind, Unsolved,
    Weights,
};
