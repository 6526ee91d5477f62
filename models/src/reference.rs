//! Solutions of coupled problems that are found without coupling.
//!
//! * [`FreeOscillation`]: one mass on a spring and a damper, without a force, in closed form;
//! * [`LinkedOscillators`]: several of them, held together by rigid links, with the force in every link;
//! * [`DoublePendulum`], [`Chain`]: linked pendulums in minimal coordinates, with the force in every hinge, integrated
//!   to a tolerance of 1e-12;
//! * [`SliderCrank`]: the same for a mechanism with a slider, with the force in its contact;
//! * [`MotorDrivenSliderCrank`]: the same on the shaft of a motor with a speed controller;
//! * [`GuidedSliderCrank`]: the slider-crank of S2 without clearance, in its one coordinate;
//! * [`FourBar`]: a closed loop of bars on a frame that may be shaken, with the force in every hinge;
//! * [`SpatialChain`]: rigid bodies in space in joints of any kind, with the load in every joint; [`Gimbal`]: a spinning
//!   top as such a chain;
//! * [`RigidBody`]: momentum, angular momentum and energy of a body, whose sums stay where no load acts from outside.

mod chain;
mod double_pendulum;
mod error;
mod four_bar;
mod free;
mod gimbal;
mod guided_slider_crank;
mod linked;
mod links;
mod motor;
mod ranges;
mod rigid_body;
mod slider_crank;
mod spatial_chain;
mod spatial_examples;
mod spatial_joint;
mod tip_line;
mod trajectory;

pub use chain::Chain;
pub use double_pendulum::DoublePendulum;
pub use error::ReferenceError;
pub use four_bar::{Bar, FourBar, FourBarMotion, Shake, Side};
pub use free::{FreeOscillation, Motion};
pub use gimbal::Gimbal;
pub use guided_slider_crank::{GuidedMotion, GuidedSliderCrank};
pub use linked::{LinkError, LinkedOscillators};
pub use links::{GroundHinge, Link, LinkMotion};
pub use motor::{Motor, MotorDrivenMotion, MotorDrivenSliderCrank, SpeedController};
pub use rigid_body::{BodyMotion, RigidBody};
pub use slider_crank::{SliderCrank, SliderCrankMotion};
pub use spatial_chain::{JointReaction, JointedBody, SpatialChain, SpatialChainMotion};
pub use spatial_joint::{CompositeJoint, Freedom, SpatialJoint};
