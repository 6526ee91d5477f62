//! What the workers have answered, as values of the coupling outputs.

use crate::signal::SharePolynomial;

/// The coupling outputs of all subsystems at one instant.
pub trait Outputs {
    /// Those of one subsystem.
    fn of(&self, subsystem: usize) -> &[f64];

    /// What it told of the inside of the step that led there, look by look.
    fn inside(&self, _subsystem: usize) -> &[f64] {
        &[]
    }
}

/// The outputs at the end of a look-ahead, and its responses to perturbed inputs.
pub trait LookAhead: Outputs {
    /// The outputs of a subsystem with which those of its perturbed inputs are compared.
    fn unperturbed(&self, subsystem: usize) -> &[f64];

    /// The outputs of a subsystem under perturbed input number `number` that it was asked for.
    fn perturbed(&self, subsystem: usize, number: usize) -> &[f64];

    /// Directional derivatives of the outputs of a subsystem, number `number` that it was asked for.
    fn derivatives(&self, subsystem: usize, number: usize) -> &[f64];
}

/// A perturbed input that a look-ahead asks for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perturbation {
    /// Number of the driven input in the layout.
    pub input: usize,
    /// Place among those of its subsystem.
    pub place: usize,
    /// In which curve the input is raised.
    pub shape: SharePolynomial,
    /// How much of it; absent where the subsystem gives the directional derivative.
    pub increment: Option<f64>,
}

/// How the responses of a subsystem are had.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Differentiation {
    /// Size of the errors in a step and in a perturbed one that do not cancel in their difference, if it is more than rounding.
    pub noise: Option<f64>,
    /// Whether it gives directional derivatives.
    pub has_derivatives: bool,
}
