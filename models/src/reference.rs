//! Closed forms that coupled runs are compared with.
//!
//! * [`FreeOscillation`]: one mass on a spring and a damper, without a force;
//! * [`LinkedOscillators`]: several of them, held together by rigid links, with the force in every link.

mod free;
mod linked;

pub use free::{FreeOscillation, Motion};
pub use linked::{LinkError, LinkedOscillators};
