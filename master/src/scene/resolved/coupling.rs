//! The coupling of a resolved scene.

pub use crate::methods::{Index, Method, Order, Spring, Variant};
pub use crate::policies::iteration::{Iterations, Jacobian, Otherwise};
pub use crate::policies::step_size::StepControl;
pub use crate::signal::Degree;
pub use crate::system::Increment;

/// How the subsystems are coupled.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupling {
    /// The coupling method with its parameters.
    pub method: Method,
    /// Degree k of the Lagrange polynomials of the coupling variables, 0 to 3. Default 1, for the explicit method 0. With
    /// Hermite coupling that of the multipliers on a step, which the variant determines.
    pub degree: Degree,
    /// Degree of the polynomials of exchanged body variables and connected signals, 0 to 3. Default 2, or the degree of the
    /// multipliers if that is higher or automatic; for the explicit method 0. With Hermite coupling only that of connected
    /// signals, default 3.
    pub exchanged_degree: Degree,
    /// Who evaluates loads whose direction turns with the bodies. Default automatic.
    pub loads: Loads,
    /// What crosses the joints of subsystems with impacts. Default impulses.
    pub impacts: ImpactsAtJoints,
    /// Macro step H in s, greater than 0 and at most the simulated time; the first one if the steps vary.
    pub macro_step: f64,
    /// Present if the macro step varies with the error.
    pub step_control: Option<StepControl>,
    /// Increments of the finite differences. Default automatic.
    pub increment: Increment,
    /// How long columns of the coupling Jacobian are used. Default reuse.
    pub jacobian: Jacobian,
    /// Corrections until they change nothing of note; absent: one, as in S1.
    pub iterations: Option<Iterations>,
    /// By how much joints may be open at the start, relative to what is measured. Default 1e-9.
    pub start_tolerance: f64,
}

impl Coupling {
    /// Whether a degree follows the estimates.
    pub fn has_automatic_degree(&self) -> bool {
        [self.degree, self.exchanged_degree].contains(&Degree::Automatic)
    }
}

/// What crosses the joints of a subsystem with impacts at their instants.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImpactsAtJoints {
    /// Impulses: partners take part in the impact.
    Impulses,
    /// Forces alone: partners feel an impact by what it makes of the loads of the macro step.
    Forces,
}

/// Who evaluates a load whose direction turns with the bodies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loads {
    /// The worker if it can, otherwise the master.
    Automatic,
    /// The worker, at the pose that its marker has at every instant (S1 eqs. 42, 45, 51, 54).
    Worker,
    /// The master: workers get force and moment as polynomials.
    Master,
}
