//! The model `oscillator`: one mass on a spring and a damper,
//! `m v' = -c x - d v + f + k_p (x_p - x) + d_p (v_p - v)`, `x' = v`.
//!
//! `f` is an applied force; `x_p`, `v_p` are the motion of a partner behind a spring `k_p` and a damper `d_p`, for
//! force/displacement coupling. From a time on, a constant load may act on the mass as well.

mod averages;
mod description;
mod equation;
mod exact;
mod parameters;
mod propagator;

use linchpin_proto::v1;
use linchpin_worker::setup::SetupError;
use linchpin_worker::{Model, Setup, Subsystem};

use crate::mechanics::joint_loads::JointLoads;
use crate::mechanics::run::Run;
use crate::mechanics::solvers;
use equation::Equation;
use exact::Exact;

pub use parameters::{LoadStep, OscillatorParameters, PartnerSpring};

/// One mass on a spring and a damper (S1 Sect. 2).
#[derive(Debug, Clone, Copy, Default)]
pub struct Oscillator;

impl Model for Oscillator {
    fn describe(&self) -> v1::Model {
        description::model()
    }

    fn initialize(&self, setup: &Setup) -> Result<Box<dyn Subsystem>, SetupError> {
        let own = OscillatorParameters::from_setup(setup)?;
        let partner = PartnerSpring::from_setup(setup)?;
        let equation = Equation::new(own, partner, LoadStep::from_setup(setup)?);
        let start = [own.x0, own.v0];
        match setup.solver() {
            description::EXACT => {
                let run = Run::new(equation, JointLoads::default(), start, Exact::default());
                Ok(Box::new(run))
            }
            _ => solvers::start(equation, start, setup),
        }
    }
}
