//! The model `pi-controller`: a proportional-integral controller.
//!
//! With the error `e` between the setpoint and the measured value, the proportional gain `K_p` and the integral gain
//! `K_i`: `e = setpoint - measured`, `v' = K_i e`, `control = K_p e + v`.
//!
//! `control` depends on both inputs at once (direct feedthrough) unless `K_p = 0`. The state is the integral part `v`
//! of the control, so that a start value of it means the same for all gains. The control is not limited.

mod description;
mod equation;

use std::collections::BTreeMap;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::solvers;
use equation::Controller;

/// A proportional-integral controller.
#[derive(Debug, Clone, Copy, Default)]
pub struct PiController;

impl Model for PiController {
    fn describe(&self) -> v1::Model {
        description::model(0.0)
    }

    fn describe_with(
        &self,
        parameters: &BTreeMap<String, v1::Value>,
    ) -> Result<v1::Model, SetupError> {
        description::configured(parameters)
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let start = [setup.parameter("integral0")?];
        solvers::start(Controller::from_setup(setup)?, start, setup)
    }
}
