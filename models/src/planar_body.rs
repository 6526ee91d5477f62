//! The model `planar-body`: a free rigid link in the plane, with a load at each end.
//!
//! The equations are those of the centre of mass, `m r'' = sum f - m g e_y`, `J phi'' = sum (moment + r_i x f)`, in
//! which translation and rotation meet only through the loads. The markers `start` and `end` lie at `-length/2` and
//! `+length/2` from the centre on the body's axis.

mod description;
mod equation;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::solvers;
use equation::FreeLink;

/// A free rigid link in the plane (S1 Sect. 4.2, subsystem 2).
#[derive(Debug, Clone, Copy, Default)]
pub struct PlanarBody;

impl Model for PlanarBody {
    fn describe(&self) -> v1::Model {
        description::model()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let link = FreeLink::from_setup(setup)?;
        let position = [
            setup.parameter("x0")?,
            setup.parameter("y0")?,
            setup.parameter("angle0")?,
        ];
        let velocity = [
            setup.parameter("vx0")?,
            setup.parameter("vy0")?,
            setup.parameter("rate0")?,
        ];
        solvers::start(link, link.state_of_start(position, velocity), setup)
    }
}
