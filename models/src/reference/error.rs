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
    /// A parameter of one of several bodies out of its range.
    #[error("body {body} (from 0) has {field} = {value}; it must be {allowed}")]
    BodyOutOfRange {
        /// Number of the body, from 0.
        body: usize,
        /// Name of the parameter.
        field: &'static str,
        /// The value given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// No body at all.
    #[error("there is no body; at least one is needed")]
    NoBody,
    /// Coordinates or rates that are not one for each freedom of the joints.
    #[error(
        "{given} {field} at the start, but the joints have {freedoms} freedoms; each needs one"
    )]
    NotOnePerFreedom {
        /// `coordinates` or `rates`.
        field: &'static str,
        /// How many are given.
        given: usize,
        /// How many freedoms there are.
        freedoms: usize,
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
    /// A loop of bars that cannot be closed at the start.
    #[error(
        "the loop cannot be closed at the start: the tip of the crank is {distance} m from the hinge of the rocker; \
         coupler and rocker reach distances between {least} m and {most} m, both not included"
    )]
    OpenLoop {
        /// From the tip of the crank to the rocker's hinge in the frame (m).
        distance: f64,
        /// Difference of the lengths of coupler and rocker (m).
        least: f64,
        /// Their sum (m).
        most: f64,
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

impl ReferenceError {
    /// The same mistake in body number `body` (from 0).
    pub(super) fn in_body(self, body: usize) -> Self {
        match self {
            Self::OutOfRange {
                field,
                value,
                allowed,
            } => Self::BodyOutOfRange {
                body,
                field,
                value,
                allowed,
            },
            other => other,
        }
    }
}
