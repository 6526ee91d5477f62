//! Base integration schemes on velocity level: one step from `t_i` to `t_{i+1}` without impacts (S2 Sect. 2.3).
//!
//! A file each, with the same parts: what the scheme is, its parameters, `advance`.
//!
//! | file | scheme | source | order | stages |
//! |---|---|---|---|---|
//! | [`generalized_alpha`] | generalised-alpha, HHT, Newmark | S2 Sect. 2.4 | 2 | 1 implicit |
//! | [`bathe`] | trapezoidal rule, then backward differences | S2 Sect. 2.6 | 2 | 2 implicit, one after the other |
//! | [`ed_alpha`] | energy decaying, time-discontinuous | S2 Sect. 2.7 | 2 | 2 implicit, coupled |
//! | [`moreau`] | Moreau's midpoint rule | S2 refs. 30, 25 | 1 | explicit, with impacts |
//! | [`hets`] | half-explicit timestepping | S2 refs. 40, 41 | 2 | explicit |

pub mod bathe;
pub mod ed_alpha;
pub mod generalized_alpha;
pub mod hets;
pub mod moreau;

use super::mechanics::{Level, Mechanics, StepError};
use super::state::{State, Step};

pub use bathe::Bathe;
pub use ed_alpha::EdAlpha;
pub use generalized_alpha::GeneralizedAlpha;
pub use hets::Hets;
pub use moreau::Moreau;

/// A base integration scheme with its room to work.
pub trait Scheme: Send {
    /// Advances `from` over `step` to `to`: `q`, `v^-`, `a`, `A` and forces at its end. Everything of `to` but its time
    /// and its impulses is written, and nothing else is changed.
    fn advance(
        &mut self,
        mechanics: &mut Mechanics,
        step: Step<'_>,
        from: &State,
        to: &mut State,
    ) -> Result<Outcome, StepError>;
}

/// What a scheme leaves to the impulsive correction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The step has no impacts yet: contacts that closed in it are corrected behind it.
    Smooth,
    /// Contacts followed the law of impact within the step.
    Impulsive {
        /// Whether a contact closed in it; then the scheme has written the impulses.
        has_impact: bool,
    },
}

/// A scheme with its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SchemeKind {
    /// Generalised-alpha with the parameters that are optimal for a spectral radius at infinity (S2 eq. 26).
    GeneralizedAlpha {
        /// Spectral radius for infinite frequency, 0 to 1.
        rho_inf: f64,
    },
    /// Generalised-alpha with any two parameters; Newmark's trapezoidal rule is (0, 0), HHT is (0, alpha).
    NewmarkAlpha {
        /// Share of the old acceleration `A`, at most `alpha_f`.
        alpha_m: f64,
        /// Share of the old equation of motion, at most 1/2.
        alpha_f: f64,
    },
    /// Bathe's method.
    Bathe,
    /// ED-alpha.
    EdAlpha {
        /// Spectral radius for infinite frequency, 0 to 1.
        rho_inf: f64,
        /// Place of the cut-off, greater than 0; 1/6 gives order 3 for linear systems.
        alpha_ar: f64,
    },
    /// Moreau's midpoint rule.
    Moreau,
    /// Half-explicit timestepping.
    Hets,
}

/// Parameters that a scheme does not have.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SchemeError {
    /// Spectral radius.
    #[error("rho_inf = {0} is out of range: it must be 0 to 1")]
    RhoInf(f64),
    /// Parameters of generalised-alpha (S2 eq. 100).
    #[error(
        "alpha_m = {alpha_m}, alpha_f = {alpha_f}: alpha_m <= alpha_f <= 1/2 is needed, or high frequencies grow"
    )]
    Alpha {
        /// As given.
        alpha_m: f64,
        /// As given.
        alpha_f: f64,
    },
    /// Cut-off of ED-alpha.
    #[error("alpha_ar = {0} is out of range: it must be greater than 0")]
    AlphaAr(f64),
    /// Contacts on acceleration level.
    #[error("only generalised-alpha holds contacts on acceleration level; take the velocity level")]
    AccelerationLevel,
    /// ED-alpha without damping cannot hold contacts.
    #[error(
        "ed-alpha with rho_inf = 1 cannot hold contacts or constraints: their forces would oscillate without bound \
         and pull; \
         take rho_inf < 1, or another scheme"
    )]
    UndampedContacts,
}

impl SchemeError {
    /// The option of a solver that is to be changed.
    pub fn option(&self) -> &'static str {
        match self {
            Self::RhoInf(_) | Self::UndampedContacts => "rho_inf",
            Self::Alpha { .. } => "alpha_m",
            Self::AlphaAr(_) => "alpha_ar",
            Self::AccelerationLevel => "acceleration_level",
        }
    }
}

impl SchemeKind {
    /// The scheme for a system.
    ///
    /// # Errors
    /// [`SchemeError`].
    pub fn build(self, mechanics: &Mechanics) -> Result<Box<dyn Scheme>, SchemeError> {
        let has_levels = matches!(
            self,
            Self::GeneralizedAlpha { .. } | Self::NewmarkAlpha { .. }
        );
        if mechanics.settings.level == Level::Acceleration && !has_levels {
            return Err(SchemeError::AccelerationLevel);
        }
        Ok(match self {
            Self::GeneralizedAlpha { rho_inf } => {
                Box::new(GeneralizedAlpha::optimal(rho_inf, mechanics)?)
            }
            Self::NewmarkAlpha { alpha_m, alpha_f } => {
                Box::new(GeneralizedAlpha::new(alpha_m, alpha_f, mechanics)?)
            }
            Self::Bathe => Box::new(Bathe::new(mechanics)),
            Self::EdAlpha { rho_inf, alpha_ar } => {
                Box::new(EdAlpha::new(rho_inf, alpha_ar, mechanics)?)
            }
            Self::Moreau => Box::new(Moreau::new(mechanics)),
            Self::Hets => Box::new(Hets::new(mechanics)),
        })
    }
}
