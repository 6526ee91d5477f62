//! What a scene says of corrections and columns.

use serde::Serialize;

/// How long the columns of the coupling Jacobian, the workers' responses, are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Jacobian {
    /// Until a macro step shows that they have become wrong.
    Reuse,
    /// For one macro step (Schweizer & Lu, Sect. 3.3).
    EveryStep,
}

/// When the corrections of a macro step come to an end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Iterations {
    /// Most passes after the first correction; default 10.
    pub most: u32,
    /// Change of the coupling variables, relative to their size, that counts as none; default 1e-9.
    pub tolerance: f64,
    /// What happens to a step that has not converged; default warn.
    pub otherwise: Otherwise,
}

/// What happens to a macro step whose corrections have not converged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Otherwise {
    /// It is accepted and counted.
    Warn,
    /// The run stops.
    Fail,
    /// It is repeated with a shorter step, which only a variable macro step can; where steps are fixed the run stops.
    Reject,
}
