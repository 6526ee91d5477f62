//! The model `pendulum`: a rigid link in the plane on a hinge in the ground, with a torsional spring and damper.
//!
//! One minimal coordinate, the angle `phi` from the x axis; with the centre of mass at the distance `s` from the hinge
//! and the tip at `l`, `e = (cos phi, sin phi)`:
//! `(J + m s^2) phi'' = -m g s cos phi - c (phi - phi_rest) - d phi' + moment + l e x f`.
//!
//! The load acts at the tip, which is the marker `tip`.

mod description;
mod equation;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::solvers;
use equation::HingedLink;

/// A link on a hinge in the ground (S1 Sect. 4.2, subsystem 1).
#[derive(Debug, Clone, Copy, Default)]
pub struct Pendulum;

impl Model for Pendulum {
    fn describe(&self) -> v1::Model {
        description::model()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let link = HingedLink::from_setup(setup)?;
        let start = [setup.parameter("angle0")?, setup.parameter("rate0")?];
        solvers::start(link, start, setup)
    }
}
