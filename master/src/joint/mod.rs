//! Joints: rows of scalar conditions between two markers; the rest of the master sees rows only.
//!
//! * [`Level`], [`Condition`], [`Joint`]: what all joints are;
//! * [`rigid_link`], [`atpoint`], [`inplane`], [`perpendicular`]: one fundamental joint each;
//! * [`composite`]: what users name in a scene;
//! * [`motion`]: what the conditions are evaluated on;
//! * the loads: [`linchpin_proto::joint_load`], shared with the workers.

pub mod atpoint;
pub mod composite;
mod condition;
pub mod inplane;
mod level;
pub mod motion;
pub mod perpendicular;
pub mod rigid_link;
mod rows;

pub use atpoint::AtPoint;
pub use composite::Kind;
pub use condition::{Condition, ROUNDING, product};
pub use inplane::InPlane;
pub use level::Level;
pub use linchpin_proto::joint_load::End;
pub use motion::{Jet, MarkerGradient, MarkerMotion, Motion};
pub use perpendicular::Perpendicular;
pub use rigid_link::RigidLink;
pub use rows::Joint;

#[cfg(test)]
mod tests;
