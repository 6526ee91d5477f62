//! Parameters of the oscillator.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;

/// A mass with its own spring and damper, and where it starts: `m x'' + d x' + c x = f`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OscillatorParameters {
    /// Mass (kg), positive.
    pub m: f64,
    /// Stiffness of the spring to ground (N/m), not negative.
    pub c: f64,
    /// Damping to ground (N s/m), not negative.
    pub d: f64,
    /// Position at the start (m); the spring is relaxed at 0.
    pub x0: f64,
    /// Velocity at the start (m/s).
    pub v0: f64,
}

impl OscillatorParameters {
    /// The parameters `m`, `c`, `d`, `x0`, `v0` of a setup.
    ///
    /// # Errors
    /// [`SetupError`] if one is missing or out of its range.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        Ok(Self {
            m: setup.positive_parameter("m")?,
            c: setup.non_negative_parameter("c")?,
            d: setup.non_negative_parameter("d")?,
            x0: setup.parameter("x0")?,
            v0: setup.parameter("v0")?,
        })
    }
}

/// A constant force on the mass that is there from a time on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadStep {
    /// Force (N).
    pub force: f64,
    /// Time from which it acts (s).
    pub from: f64,
}

impl LoadStep {
    /// The parameters `load`, `load_from` of a setup.
    ///
    /// # Errors
    /// [`SetupError`] if one is no finite number.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        Ok(Self {
            force: setup.parameter("load")?,
            from: setup.parameter("load_from")?,
        })
    }
}

/// The spring and damper between the mass and a partner whose motion is an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartnerSpring {
    /// Stiffness k_p (N/m), not negative.
    pub stiffness: f64,
    /// Damping d_p (N s/m), not negative.
    pub damping: f64,
}

impl PartnerSpring {
    /// The parameters `partner_stiffness`, `partner_damping` of a setup.
    ///
    /// # Errors
    /// [`SetupError`] if one is missing or out of its range.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        Ok(Self {
            stiffness: setup.non_negative_parameter("partner_stiffness")?,
            damping: setup.non_negative_parameter("partner_damping")?,
        })
    }
}
