//! Nonsmooth mechanics: impacts and Coulomb friction, rigid and flexible, by mixed timestepping on velocity level.
//!
//! Source: S2, that is Rezaei & Schindler, "Mixed timestepping schemes for nonsmooth mechanics with high frequency
//! damping".
//!
//! * [`mixed`]: the algorithm, one step from top to bottom (Fig. 4);
//! * [`schemes`]: what advances a step without impacts, a file each; [`stages`]: their implicit equations;
//! * [`activity`], [`impact`], [`start`]: which contacts take part, the impulsive correction, accelerations at an
//!   instant; [`partners`]: what other subsystems do in an impact;
//! * [`contact`]: the contact problem and its solvers; [`contact_log`]: what contacts did;
//! * [`system`]: what a scheme knows of a mechanical system; [`mechanics`]: a system in rows, with settings and
//!   counters;
//! * [`systems`]: mechanical systems; `subsystem`: any of them behind the worker protocol;
//! * [`state`]: plain values between steps; [`matrix`]: matrices with a border and a band;
//! * [`spectrum`]: stability, damping and period errors of the schemes.

pub mod activity;
pub mod contact;
pub mod contact_log;
pub mod impact;
pub mod matrix;
pub mod mechanics;
pub mod mixed;
pub mod partners;
pub mod schemes;
pub mod spectrum;
pub mod stages;
pub mod start;
pub mod state;
mod subsystem;
pub mod system;
pub mod systems;

pub use subsystem::block::BLOCK;
pub use subsystem::bouncing_ball::BOUNCING_BALL;
pub use subsystem::masses::MASS_CHAIN;
pub use subsystem::model::NonsmoothModel;
pub use subsystem::rod_slider::ROD_SLIDER;
pub use subsystem::slider_crank::SLIDER_CRANK;
pub use subsystem::woodpecker::WOODPECKER;
