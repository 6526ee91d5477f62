//! The equation of the state and the outputs.

use linchpin_worker::Setup;
use linchpin_worker::setup::SetupError;
use nalgebra::DMatrix;

use super::description::{CONTROL, ERROR, INTEGRAL};
use crate::mechanics::equation::EquationOfMotion;

/// Integral part of the control.
type State = [f64; 1];

/// Setpoint and measured value.
type Inputs = [f64; 2];

/// A proportional-integral controller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Controller {
    proportional: f64,
    integral: f64,
}

impl Controller {
    /// # Errors
    /// [`SetupError`] if a parameter is missing or not a finite number.
    pub fn from_setup(setup: &Setup) -> Result<Self, SetupError> {
        Ok(Self {
            proportional: setup.parameter("proportional")?,
            integral: setup.parameter("integral")?,
        })
    }
}

impl EquationOfMotion for Controller {
    type State = State;
    type Inputs = Inputs;

    const STATE_NAMES: &'static [&'static str] = &["integral"];
    const IS_LINEAR: bool = true;

    fn rate(&self, _: &State, &[setpoint, measured]: &Inputs) -> State {
        [self.integral * (setpoint - measured)]
    }

    fn jacobian(&self, _: &State, _: &Inputs, jacobian: &mut DMatrix<f64>) {
        jacobian.fill(0.0);
    }

    fn output(
        &self,
        &[integral]: &State,
        &[setpoint, measured]: &Inputs,
        output: usize,
    ) -> Option<f64> {
        let error = setpoint - measured;
        Some(match output {
            CONTROL => self.proportional * error + integral,
            ERROR => error,
            INTEGRAL => integral,
            _ => return None,
        })
    }
}
