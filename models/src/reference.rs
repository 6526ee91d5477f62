//! Solutions of coupled problems that are found without coupling.
//!
//! * [`FreeOscillation`]: one mass on a spring and a damper, without a force, in closed form;
//! * [`LinkedOscillators`]: several of them, held together by rigid links, with the force in every link;
//! * [`DoublePendulum`], [`Chain`]: linked pendulums in minimal coordinates, with the force in every hinge, integrated
//!   to a tolerance of 1e-12;
//! * [`SliderCrank`]: the same for a mechanism with a slider, with the force in its contact;
//! * [`MotorDrivenSliderCrank`]: the same on the shaft of a motor with a speed controller.

mod chain;
mod double_pendulum;
mod error;
mod free;
mod linked;
mod links;
mod motor;
mod ranges;
mod slider_crank;
mod tip_line;
mod trajectory;

pub use chain::Chain;
pub use double_pendulum::DoublePendulum;
pub use error::ReferenceError;
pub use free::{FreeOscillation, Motion};
pub use linked::{LinkError, LinkedOscillators};
pub use links::{GroundHinge, Link, LinkMotion};
pub use motor::{Motor, MotorDrivenMotion, MotorDrivenSliderCrank, SpeedController};
pub use slider_crank::{SliderCrank, SliderCrankMotion};
