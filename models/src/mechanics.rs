//! What all models share that are an ordinary differential equation `y' = f(y, u)`.
//!
//! * [`equation`]: what a model gives;
//! * [`joint_loads`]: loads of joints at the markers of the model;
//! * [`run`]: an equation and a solver as a subsystem: state, outputs, snapshots, checks;
//! * [`adaptive`], [`fixed`], [`solvers`]: the solvers, and how a setup chooses one;
//! * [`describe`], [`markers`]: parts of a description;
//! * [`planar`], [`spatial`]: kinematics of rigid bodies.

pub mod adaptive;
pub mod describe;
pub mod equation;
pub mod fixed;
pub mod integrals;
pub mod joint_loads;
pub mod markers;
pub mod planar;
pub mod run;
pub mod solvers;
pub mod spatial;
