//! The coupling of a resolved scene.

use std::fmt;

use serde::{Serialize, Serializer};

use crate::scene::formula::Formula;
use crate::signal::MAX_DEGREE;

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
}

/// What a run with variable macro steps keeps to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StepControl {
    /// Error of positions relative to their size.
    pub tolerance: f64,
    /// Error in m or rad that is allowed whatever the size; default 1e-3 of the tolerance.
    pub absolute_tolerance: f64,
    /// Shortest macro step in s; default 1e-9 of the simulated time.
    pub least_step: f64,
    /// Longest macro step in s; default a tenth of the simulated time.
    pub greatest_step: f64,
}

impl Coupling {
    /// Whether a degree follows the estimates.
    pub fn has_automatic_degree(&self) -> bool {
        [self.degree, self.exchanged_degree].contains(&Degree::Automatic)
    }
}

/// Degree of the Lagrange polynomials of coupling variables.
///
/// Serialises as the number, or as `"automatic"`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Degree {
    /// The same on all macro steps.
    Fixed(usize),
    /// On every macro step the one from 0 to [`MAX_DEGREE`] that the estimates favour, as far as the method is stable for it.
    Automatic,
}

impl Degree {
    /// The highest degree that a step may have.
    pub fn highest(self) -> usize {
        match self {
            Self::Fixed(degree) => degree,
            Self::Automatic => MAX_DEGREE,
        }
    }

    /// The degree, if it does not change.
    pub fn fixed(self) -> Option<usize> {
        match self {
            Self::Fixed(degree) => Some(degree),
            Self::Automatic => None,
        }
    }
}

impl Serialize for Degree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Fixed(degree) => serializer.serialize_u64(*degree as u64),
            Self::Automatic => serializer.serialize_str(AUTOMATIC_DEGREE),
        }
    }
}

impl fmt::Display for Degree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(degree) => degree.fmt(f),
            Self::Automatic => write!(f, "{AUTOMATIC_DEGREE:?}"),
        }
    }
}

/// A degree that follows the estimates, in a scene.
pub(in crate::scene) const AUTOMATIC_DEGREE: &str = "automatic";

/// What is demanded of the joints at the macro points, and how the multipliers follow from it.
///
/// Serialises with its name in a scene under `name`, and its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "name", rename_all = "kebab-case")]
pub enum Method {
    /// Schweizer & Lu, method 1: g + beta g' + gamma g'' = 0.
    Baumgarte {
        /// Follows from beta and gamma: see [`Index`].
        index: Index,
        /// Weight of the velocity in s; default 2 H.
        beta: Formula,
        /// Weight of the acceleration in s^2; default H^2.
        gamma: Formula,
    },
    /// Schweizer & Lu, method 2: weighted multipliers of position, velocity and acceleration.
    Weighted {
        /// Follows from a and b: see [`Index`].
        index: Index,
        /// Weight of the velocity; default 2.
        a: f64,
        /// Weight of the acceleration; default 2.6.
        b: f64,
    },
    /// Polynomials of their own on every macro step.
    Hermite {
        /// Which conditions fix them; default [`Variant::Apv`].
        variant: Variant,
    },
    /// The explicit index-1 method of Gu & Asada: (mu d/dt + 1)^2 g = 0.
    Explicit {
        /// Time constant in s, greater than 0.
        mu: Formula,
    },
    /// Force of a spring and damper in place of the multiplier, on both ends.
    Penalty {
        /// Which subsystems know what others have reached; default Jacobi.
        order: Order,
        /// For conditions that are lengths.
        lengths: Option<Spring>,
        /// For conditions that are angles.
        angles: Option<Spring>,
    },
}

impl Method {
    /// Whether the coupling variables at the end of every macro step are predicted and corrected.
    pub fn is_corrected(&self) -> bool {
        matches!(self, Self::Baumgarte { .. } | Self::Weighted { .. })
    }

    /// Whether columns of the coupling Jacobian may stay in use from step to step.
    pub fn keeps_columns(&self) -> bool {
        self.is_corrected() || matches!(self, Self::Hermite { .. })
    }
}

/// What the multipliers of Hermite coupling are on a macro step: their conditions at its start `T_N` and its end `T_{N+1}`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Variant {
    /// g'' = 0 at `T_N`; g = 0, g' = 0 at `T_{N+1}`: quadratic.
    Apv,
    /// Continuous at `T_N`; g = 0, g' = 0 at `T_{N+1}`: quadratic.
    C0pv,
}

/// In which order the subsystems step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Order {
    /// All at once, from extrapolated inputs.
    Jacobi,
    /// One after the other as the scene lists them; later ones know what earlier ones have reached.
    GaussSeidel,
}

/// A spring and a damper in place of one condition `g` of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spring {
    /// Load per unit of `g`, greater than 0: N/m, for angles N m.
    pub stiffness: f64,
    /// Load per unit of `g'`, 0 or greater; default 0: N s/m, for angles N m s.
    pub damping: f64,
}

/// Index of the coupled system: which derivatives of the constraint are demanded.
///
/// Serialises as its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(into = "u8")]
pub enum Index {
    /// Position, velocity and acceleration: both parameters are greater than 0.
    One,
    /// Position and velocity: the second parameter is 0.
    Two,
    /// Position only: both parameters are 0.
    Three,
}

impl From<Index> for u8 {
    fn from(index: Index) -> Self {
        index.number()
    }
}

impl Index {
    /// 1, 2 or 3.
    pub fn number(self) -> u8 {
        match self {
            Self::One => 1,
            Self::Two => 2,
            Self::Three => 3,
        }
    }
}

/// Increments of the finite differences that give the coupling Jacobian.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Increment {
    /// Chosen so that the response stands well above the tolerance that the worker reports.
    Automatic,
    /// None where a worker offers directional derivatives; otherwise as automatic.
    Derivatives,
    /// eps max(1, |u|) for the coupling variable u; eps greater than 0 (Schweizer & Lu, Sect. 3.3).
    Relative(f64),
}

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
