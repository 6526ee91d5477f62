//! Mechanical systems as subsystems behind the worker protocol.
//!
//! * [`face`]: what a master sees of a system; [`observed`]: the outputs that a system has of its own;
//! * [`options`]: schemes as solvers of a scene;
//! * [`run`]: a system in motion: steps, outputs, snapshots, statistics; [`collided`]: what collides in them;
//! * [`keys`], [`model`]: parameters and descriptions;
//! * [`slider_crank`], [`rod_slider`], [`masses`], [`bouncing_ball`], [`block`], [`woodpecker`]: the models.

pub mod block;
pub mod bouncing_ball;
pub mod collided;
pub mod face;
pub mod keys;
pub mod masses;
pub mod model;
pub mod observed;
pub mod options;
pub mod rod_slider;
pub mod run;
pub mod slider_crank;
pub mod woodpecker;
