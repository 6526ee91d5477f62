//! Mechanical systems.
//!
//! * [`masses`]: masses in a row between springs, with a wall: the model problem of S2 Sect. 2.8;
//! * [`rigid_slider_crank`]: the slider-crank mechanism with a clearance between slider and notch;
//! * [`flexible_slider_crank`]: the same with a flexible rod; [`rod`]: that rod.

pub mod flexible_slider_crank;
pub mod masses;
pub mod notch;
pub mod rigid_slider_crank;
pub mod rod;
