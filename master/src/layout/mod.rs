//! Which outputs of which subsystem the joints read, which are exchanged, and which inputs are driven.
//!
//! * `coupled`: what a layout is made of;
//! * `bound`: the layout itself;
//! * `bind`, `loads`, `named_load`, `frames`: how it is made;
//! * `inside`, `interior`: what is read inside a step;
//! * `border`: redundant conditions;
//! * `size`: what lengths are measured by;
//! * [`marker`]: the motion of a marker in its subsystem's outputs;
//! * [`exchanged`]: outputs that are inputs of other subsystems;
//! * [`input`]: driven inputs and how they follow from the coupling variables.

mod bind;
mod border;
mod bound;
mod coupled;
pub mod exchanged;
mod frames;
pub mod input;
mod inside;
mod interior;
mod loads;
pub mod marker;
mod named_load;
mod size;

pub use border::Border;
pub use bound::{BoundJoint, Frame, Layout, Row, column_name};
pub use coupled::{Coupled, Lack, LoadForm, MarkedConnection, MarkedJoint, MarkerLacks};
pub use exchanged::{Exchanged, What};
pub use input::{DrivenInput, Over, Source};
pub use inside::{Inside, MomentsFrom};
pub use marker::{BoundEnd, Position};
