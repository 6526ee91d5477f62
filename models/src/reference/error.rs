//! Why a reference cannot be computed.

use crate::integrators::Cause;

/// Why a reference cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// A parameter out of its range.
    #[error("{field} = {value}; it must be {allowed}")]
    OutOfRange {
        /// Name of the parameter.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// No link at all.
    #[error("there is no link; at least one is needed")]
    NoLink,
    /// Angles and rates differ in number.
    #[error("{angles} angles but {rates} rates at the start; every link needs one of each")]
    UnequalStart {
        /// Number of angles.
        angles: usize,
        /// Number of rates.
        rates: usize,
    },
    /// A time that is not finite or lies before the one in front of it.
    #[error("time {place} is {time} s; times must be finite and ascend from {reached} s")]
    Time {
        /// Place in the list, from 0.
        place: usize,
        /// The time (s).
        time: f64,
        /// The time before it (s), 0 for the first.
        reached: f64,
    },
    /// The integration failed.
    #[error("{cause} at t = {t} s")]
    Integration {
        /// Where it stopped.
        t: f64,
        /// Why.
        cause: Cause,
    },
}
