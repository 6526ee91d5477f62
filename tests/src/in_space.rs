//! Rigid bodies in space: references as scenes, and how far a run is from its reference.
//!
//! * [`joints`]: joints of a reference as joints of a scene, the outer body at end a, the inner one at end b;
//! * [`text`]: the parts of a scene file;
//! * [`pair`]: two bodies that float, in any joint;
//! * [`tumbling`]: motions of a reference through any attitude;
//! * [`compare`]: poses, loads, momenta and energies of a run.

pub mod compare;
pub mod joints;
pub mod pair;
pub mod text;
pub mod tumbling;
