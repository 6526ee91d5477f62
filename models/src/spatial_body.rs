//! The model `spatial-body`: a free rigid body in space, with a load at each of two points.
//!
//! Newton's law for the centre of mass in space, Euler's equations `J omega' + omega x J omega = M` in the principal
//! axes, and a unit quaternion for the attitude: unlike three angles it has no attitude at which its rate becomes
//! infinite. The integrator keeps its length to its own error; it is brought back to 1 at every macro point.
//!
//! The model lists no states: no output is the rotation vector that sets the attitude at the start.

mod description;
mod equation;
mod parameters;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::solvers;
use equation::FreeBody;

/// A free rigid body in space.
#[derive(Debug, Clone, Copy, Default)]
pub struct SpatialBody;

impl Model for SpatialBody {
    fn describe(&self) -> v1::Model {
        description::model()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let body = FreeBody::new(parameters::body(setup)?);
        solvers::start(body, equation::state(&parameters::start(setup)?), setup)
    }
}
