//! Mechanical systems.
//!
//! * [`masses`]: masses in a row between springs, with a wall: the model problem of S2 Sect. 2.8;
//! * [`point_mass`]: a bouncing ball, a mass that slides in space;
//! * [`body_on_planes`]: a rigid body in the plane whose corners touch planes: blocks, rods;
//! * [`woodpecker`]: the woodpecker toy;
//! * [`rigid_slider_crank`]: the slider-crank mechanism with a clearance between slider and notch;
//! * [`flexible_slider_crank`]: the same with a flexible rod; [`rod`]: that rod;
//! * [`rod_slider`]: rod and slider alone, for a crank elsewhere; [`notch`], [`guiding`]: what the slider touches.

pub mod body_on_planes;
pub mod flexible_slider_crank;
pub mod guiding;
pub mod masses;
pub mod notch;
pub mod point_mass;
pub mod rigid_slider_crank;
pub mod rod;
pub mod rod_slider;
pub mod woodpecker;
