//! The model `dc-motor`: a direct-current motor with a constant field, whose rotor is a crank on a hinge in the ground.
//!
//! The armature is a resistance `R`, an inductance `L` and the voltage `k_e w` that the rotor's rate `w` induces; the
//! rotor, with everything that is fixed to it and balanced about the shaft, has the moment of inertia `J` and viscous
//! friction `b`:
//! `L i' = u - R i - k_e w`, `phi' = w`, `J w' = k_t i - b w + M`.
//!
//! `u` is the input `voltage`. The moment `M` about the shaft is that of the loads at two markers: `shaft` in the axis of
//! the rotor, whose force the bearing takes, and `pin` at the distance `crank` from it in the direction
//! `(cos phi, sin phi)`.

mod description;
mod equation;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::solvers;
use equation::Motor;

/// A direct-current motor.
#[derive(Debug, Clone, Copy, Default)]
pub struct DcMotor;

impl Model for DcMotor {
    fn describe(&self) -> v1::Model {
        description::model()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let motor = Motor::from_setup(setup)?;
        let start = [
            setup.parameter("angle0")?,
            setup.parameter("rate0")?,
            setup.parameter("current0")?,
        ];
        solvers::start(motor, start, setup)
    }
}
